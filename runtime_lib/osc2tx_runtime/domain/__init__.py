"""The domain model at run time: the items that scenarios declare, read and call (DSL chapter 8).

From above: `scenario` is the base of generated scenarios; `actions` are executed with the commands
computed in `planning`; `placing` puts actors on the map; `actors` have the actions as typed
`methods`; `modifiers` constrain the actions; `objects` have live fields from `measuring`;
`signals` are traffic lights; `routes` are elements of the map; `paths`, `points_and_poses` and
`shapes` are values. `capabilities` lists all this for the compiler.
"""
