"""Traffic lights as scenarios speak of them (DSL 8.15).

`traffic_lights` are boxes, groups, phases and cycles; `lamp_states` is what they show,
`traffic_light_cycles` when; `control_file` reads cycles from a file; `stop_lines` are for them.
"""
