"""The actions of the domain model; importing this package registers them.

Each module holds the classes of one subject: `movement` (drive, walk, move with their modifiers),
`speed`, `acceleration`, `lane`, `gaps_and_headways`, `path_following`, `change_position`,
`assign_pose`, `trailers`, `lights`, `environment_actions`, `traffic_light_control` and
`play_cycles` (with `light_switching`). `modifier_checks` refuses modifiers that do not go
together. An action reads the snapshot when it starts, hands one command per slot to the world (what
modifiers ask for is worked out in `planning`), and ends when the world reports the goal.
"""

from __future__ import annotations

from importlib import import_module
from pkgutil import iter_modules

for _module in iter_modules(__path__):  # they register their actions
    import_module(f"{__name__}.{_module.name}")
