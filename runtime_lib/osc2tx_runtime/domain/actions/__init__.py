"""The actions of the domain model; importing this package registers them.

Each module holds the classes of one subject: `movement` (drive, walk, move with their modifiers),
`speed`, `acceleration`, `lane`, `gaps_and_headways`, `path_following`, `change_position`,
`assign_pose`, `trailers`, `lights`, `environment_actions`, `traffic_light_control` and
`play_cycles` (with `light_switching`). `combinations` and `modifier_checks` say which modifiers go
together. An action reads the snapshot when it starts, hands one command per slot to the world (what
modifiers ask for is worked out in `planning`), and ends when the world reports the goal.
"""

from __future__ import annotations

from . import (
    acceleration,
    assign_pose,
    change_position,
    environment_actions,
    gaps_and_headways,
    lane,
    lights,
    movement,
    path_following,
    play_cycles,
    speed,
    traffic_light_control,
    trailers,
)

__all__ = [
    "acceleration",
    "assign_pose",
    "change_position",
    "environment_actions",
    "gaps_and_headways",
    "lane",
    "lights",
    "movement",
    "path_following",
    "play_cycles",
    "speed",
    "traffic_light_control",
    "trailers",
]
