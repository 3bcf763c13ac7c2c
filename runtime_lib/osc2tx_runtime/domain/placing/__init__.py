"""Where actors are put, by modifiers or by settings, before step 0.

`initializer` goes through the cast in the order of `start_order`, and `start_room` keeps who is
where: the `map_solver` chooses roads, the `placer` asks `default_starts` and `point_placement`;
`initial_state` and `pose_resolution` are about speeds, headings and poses.
"""
