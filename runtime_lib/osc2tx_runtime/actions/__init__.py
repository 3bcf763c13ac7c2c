"""The actions of the domain model; importing this package registers them.

Each module holds the classes of one subject: `movement` (drive, walk, move with their
modifiers: `checks`, `speeds`, `sides`), `speed`, `rates` (acceleration), `lane`, `gap`, `paths`,
`position`, `place`, `trailers`, `lights`, `environment`. An action reads the snapshot
when it starts, hands one command per slot to the world, and ends when the world reports the goal.
"""

from __future__ import annotations

from . import (
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
    trailers,
)

__all__ = [
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
    "trailers",
]
