"""The domain model at run time: what scenarios declare, read and call (DSL chapter 8).

From above: `scenario` is the base of generated scenarios; `actions` carry out what actors are told,
as worked out in `planning`; `placing` puts actors on the map; `actors` have the actions as typed
`methods`; `modifiers` say how; `objects` have live fields from `measuring`; `signals` are traffic
lights; `routes` are what the map offers; `paths`, `points_and_poses` and `shapes` are values.
`capabilities` tells the compiler about them.
"""
