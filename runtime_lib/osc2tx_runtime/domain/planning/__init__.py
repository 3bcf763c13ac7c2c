"""Plans: from the modifiers of an action to the commands of the world.

`motion_action` has the bases of actions as the planning sees them;
`start_conditions` holds or jumps to what is to be at the start. Along the road:
`longitudinal_planning`, `position_planning`, `goals`, `arrival_time`. Across it: `lateral_planning`
with `lane_planning`, `lateral_speed_planning`, `orientation_planning`, `lateral_targets`. Off the
lanes: `path_commands`. `feasibility` refuses what an actor cannot do; `enclosing_phase` finds the
duration of what an open-ended action belongs to.
"""
