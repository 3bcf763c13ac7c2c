"""Planning: from the modifiers of an action to the commands for the world.

`motion_action` has the bases of actions; `start_conditions` holds or sets the state at the start.
Longitudinal: `longitudinal_planning`, `position_planning`, `goals`, `arrival_time`. Lateral:
`lateral_planning` with `lane_planning`, `lateral_speed_planning`, `orientation_planning`,
`lateral_targets`. Off the lanes: `path_commands`. `feasibility` rejects motion beyond the limits of
an actor; `enclosing_phase` finds the duration of the composition around an open-ended action.
"""
