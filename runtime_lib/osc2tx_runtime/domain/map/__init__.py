"""Roads, lanes, junctions and crossings of the map as scenarios declare them (DSL 8.12).

Declared by scenarios: `roads_and_lanes` and `crossings` on `route_elements` and `objects`. Elements
of the map: `segments` in a `lane_graph` and, with `crossing_lines`, in a `road_graph`. `route_axes`
are the axes that `s` runs along, `geodetic_points` projects points of the globe, `search` finds the
map file.
"""
