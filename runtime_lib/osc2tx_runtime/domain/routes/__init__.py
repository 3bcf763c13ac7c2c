"""The map as scenarios speak of it (DSL 8.12): roads, lanes, crossings, routes; what it offers.

What a scenario declares: `roads_and_lanes` and `crossings` on `route_elements` and `map_objects`.
What the map offers: `map_segments` in a `lane_graph` and, with `junction_passages` and
`crossing_lines`, in a `road_graph`. Coordinates: `lane_coordinates`, `route_coordinates`,
`place_on_route`, `route_axes`, `geodetic_points`. Ways: `road_paths`, `composed_routes`,
`network_paths`.
"""
