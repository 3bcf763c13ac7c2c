"""Start positions of actors, by modifiers or by settings, before step 0.

`initializer` visits the cast in the order of `start_order`, and `start_room` records the occupied
positions: the `map_solver` chooses roads, the `placer` uses `default_starts` and
`point_placement`; `initial_state` and `pose_resolution` compute speeds, headings and poses.
"""
