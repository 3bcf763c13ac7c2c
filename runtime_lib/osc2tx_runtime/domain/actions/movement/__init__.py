"""Actions that move an actor.

Each module has the classes of one topic: `drive` (drive, walk, move with their modifiers), `speed`,
`acceleration`, `lane`, `gaps_and_headways`, `path_following`, `change_position`, `assign_pose`,
`trailers`. Bases: `modifiable`, `profiled_change`. `modifier_checks` rejects combinations of
modifiers that contradict each other.
"""
