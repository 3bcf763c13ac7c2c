"""Traffic lights in scenarios (DSL 8.15).

`traffic_lights` has lights, groups, phases and cycles; `lamp_states` their states,
`traffic_light_cycles` the times; `control_file` reads cycles from a file; `stop_lines` has their
stop lines.
"""
