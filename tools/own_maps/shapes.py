"""Where reference lines run."""

from __future__ import annotations

import math
from collections.abc import Sequence

from osc2tx_runtime.opendrive.geometry import make_spiral
from own_maps.specs import Bend, Place, RoadSpec


def step(place: Place, bend: Bend, distance: float | None = None) -> Place:
    """Place at the end of a bend (or at a distance along it)."""
    segment = make_spiral(*place, bend.length, bend.start, bend.end)
    x, y, h, _ = segment.at(bend.length if distance is None else distance)
    return x, y, h


def ending_at(end: Place, bends: Sequence[Bend]) -> Place:
    """Start place from which the bends lead to `end`."""
    x, y, h = 0.0, 0.0, 0.0
    for bend in bends:
        x, y, h = step((x, y, h), bend)
    turn = end[2] - h
    c, s = math.cos(turn), math.sin(turn)
    return end[0] - x * c + y * s, end[1] - x * s - y * c, turn


def corners(spec: RoadSpec) -> list[tuple[float, float]]:
    """Points around a road, for the box in the header."""
    points: list[tuple[float, float]] = []
    place = spec.start
    for bend in spec.bends:
        for i in range(21):
            x, y, _ = step(place, bend, bend.length * i / 20)
            points.extend(((x - 20.0, y - 20.0), (x + 20.0, y + 20.0)))
        place = step(place, bend)
    return points
