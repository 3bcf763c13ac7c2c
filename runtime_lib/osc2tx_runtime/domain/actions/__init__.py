"""The actions of the domain model; importing this package registers them.

Each module holds the classes of one subject: `movement` (drive, walk, move with their modifiers:
`combinations` and `checks`; along the road `speeds`, `position_courses`; across it `sides`,
`across`, `lateral_speeds`; `turning`), `speed`, `rates` (acceleration), `lane`, `gap`, `paths`,
`position`, `place`, `trailers`, `lights`, `environment`, `traffic_lights` and `cycles` (with
`switching`). An action reads the snapshot when it starts, hands one command per slot to the world,
and ends when the world reports the goal.
"""

from __future__ import annotations

from . import (
    cycles,
    environment,
    gap,
    lane,
    lights,
    movement,
    paths,
    place,
    position,
    rates,
    speed,
    traffic_lights,
    trailers,
)

__all__ = [
    "cycles",
    "environment",
    "gap",
    "lane",
    "lights",
    "movement",
    "paths",
    "place",
    "position",
    "rates",
    "speed",
    "traffic_lights",
    "trailers",
]
