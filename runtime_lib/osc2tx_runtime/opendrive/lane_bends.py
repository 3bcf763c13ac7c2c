"""Bends of lanes. Curvature is taken over short stretches, so that small kinks do not count."""

from __future__ import annotations

import math
from itertools import pairwise

from .arc_length import LaneLine
from .geometry import wrap
from .lane_advance import lane_heading
from .lane_line import lane_line
from .model import Lane, LaneBends

_STRETCH = 2.0  # m of a lane over which its curvature is taken
_SHORTEST = 0.5  # m: lanes shorter than this have no bends
_STRAIGHT = 5e-4  # 1/m: a lower curvature limits no speed
_AT_THE_END = 1e-6  # m before it


def lane_bends(lane: Lane) -> LaneBends:
    """The bends of a lane, found on first use."""
    bends = lane.bends
    if bends is None:
        bends = lane.bends = _find(lane, lane_line(lane))
    return bends


def _find(lane: Lane, line: LaneLine) -> LaneBends:
    count = max(1, math.ceil(line.length / _STRETCH))
    step = line.length / count
    if step < _SHORTEST or (count > 2 and len(line.nodes) == 1 and not line.turn):
        return LaneBends(0.0, ())  # too short, or one straight piece
    ways = [min(i * step, line.length - _AT_THE_END) for i in range(count + 1)]
    if lane.direction < 0:
        ways = [line.length - way for way in ways]
    headings = [lane_heading(lane, line.s_at(way)) for way in ways]
    turns = [abs(wrap(other - one)) for one, other in pairwise(headings)]
    found = [
        (i * step, (i + 1) * step, turn / step)
        for i, turn in enumerate(turns)
        if turn / step > _STRAIGHT
    ]
    return LaneBends(max((each[2] for each in found), default=0.0), tuple(found))
