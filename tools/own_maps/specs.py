"""The elements of a map, in the terms of OpenDRIVE."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

LANE = 3.5  # m, width of a driving lane

Cubic = tuple[float, float, float, float, float]
"""s, a, b, c, d."""
Place = tuple[float, float, float]
"""x (m), y (m), heading (rad)."""


@dataclass(frozen=True)
class Bend:
    """A piece of reference line whose curvature (1/m) changes linearly."""

    length: float
    start: float = 0.0
    end: float = 0.0


@dataclass(frozen=True)
class LaneSpec:
    """A lane: id, type, width records (sOffset first) and links."""

    id: int
    type: str = "driving"
    width: float | tuple[Cubic, ...] = LANE
    mark: str = "broken"
    before: int | None = None
    after: int | None = None


@dataclass(frozen=True)
class SignalSpec:
    """A signal at (s, t)."""

    id: str
    name: str
    s: float
    t: float
    orientation: str
    type: str
    dynamic: bool = False
    value: str = ""
    unit: str = ""


@dataclass(frozen=True)
class RoadSpec:
    """A road. Links are (kind, id, contact point)."""

    id: str
    name: str
    start: Place
    bends: tuple[Bend, ...]
    sections: tuple[tuple[float, tuple[LaneSpec, ...]], ...]
    speed: int = 50
    type: str = "town"
    junction: str = "-1"
    rule: str = "RHT"
    predecessor: tuple[str, str, str] | None = None
    successor: tuple[str, str, str] | None = None
    elevation: tuple[Cubic, ...] = ((0.0, 0.0, 0.0, 0.0, 0.0),)
    superelevation: tuple[Cubic, ...] = ()
    signals: tuple[SignalSpec, ...] = ()
    crosswalk: tuple[float, float] | None = None


@dataclass(frozen=True)
class JunctionSpec:
    """A junction. Connections are (incoming, connecting, lane links)."""

    id: str
    name: str
    connections: tuple[tuple[str, str, tuple[tuple[int, int], ...]], ...]
    controllers: tuple[str, ...] = ()


@dataclass(frozen=True)
class MapSpec:
    """A whole map."""

    name: str
    roads: tuple[RoadSpec, ...]
    junctions: tuple[JunctionSpec, ...] = ()
    controllers: tuple[tuple[str, str, tuple[str, ...]], ...] = field(default=())


def cross_section(
    right: Sequence[tuple[str, float]], left: Sequence[tuple[str, float]]
) -> tuple[LaneSpec, ...]:
    """Lanes from the centre outwards, given as (type, width); marks follow from the types."""
    lanes: list[LaneSpec] = []
    for sign, side in ((-1, right), (1, left)):
        for i, (kind, width) in enumerate(side, 1):
            inner = i < len(side) and kind == "driving" and side[i][0] == "driving"
            mark = "broken" if inner else "solid" if kind == "driving" else "none"
            lanes.append(LaneSpec(sign * i, kind, width, mark))
    return tuple(lanes)


def hermite(knots: Sequence[tuple[float, float]]) -> tuple[Cubic, ...]:
    """Smooth steps between (s, value) knots, level at each knot."""
    records: list[Cubic] = []
    for (s0, v0), (s1, v1) in pairwise(knots):
        span, rise = s1 - s0, v1 - v0
        records.append((s0, v0, 0.0, 3.0 * rise / span**2, -2.0 * rise / span**3))
    records.append((knots[-1][0], knots[-1][1], 0.0, 0.0, 0.0))
    return tuple(records)


DRIVING = ("driving", LANE)
SHOULDER = ("shoulder", 3.0)
SIDEWALK = ("sidewalk", 2.5)
