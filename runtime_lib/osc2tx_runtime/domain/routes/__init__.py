"""Routes, paths along them, and positions in their coordinates (DSL 8.5, 8.12).

`composed_routes` joins roads, lanes, crossings and points to routes; `road_paths` and
`network_paths` are the paths along them. `lane_coordinates` and `route_coordinates` convert
positions, `place_on_route` measures along a route.
"""
