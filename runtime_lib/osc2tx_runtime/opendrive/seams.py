"""Seams: joints at which a lane continues with a gap or a kink.

The joints of each lane for vehicles or persons are tested: between the pieces of its road, and to
its successors.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from osc2tx_shared.classes import dataclass, replace

from .geometry import wrap
from .model import DRIVING, Lane, Pose, Road
from .polynomials import between
from .poses import lane_pose

SMALLEST_GAP = 0.01
"""Largest gap (m) that counts as rounding in the map."""
SMALLEST_TURN = math.radians(1.0)
"""Largest change of heading (rad), likewise."""

_USED = DRIVING | {"biking", "shoulder", "sidewalk", "walking"}
_BEFORE = 1e-6  # m before the end of a piece


@dataclass(frozen=True, slots=True)
class Seam:
    """A gap or kink between a lane and its continuation.

    Attributes:
        road: Road id.
        lane: Lane id.
        s: Road coordinate of the joint (m).
        onto: Road and lane that follow; for a joint inside a lane, that lane itself.
        gap: Distance (m) of both ends of the centre line.
        turn: Change of heading there (rad), without sign.
        jump: World x, y (m) and heading (rad) that it adds, in direction of travel.
        begin: World x, y (m) of the start of the following lane.
        beyond: Successors of the following lane.
    """

    road: str
    lane: int
    s: float
    onto: tuple[str, int]
    gap: float
    turn: float
    jump: tuple[float, float, float]
    begin: tuple[float, float]
    beyond: tuple[tuple[str, int], ...] = ()

    def __str__(self) -> str:
        """Position and size, for messages."""
        road, lane = self.onto
        beyond = "" if self.onto == (self.road, self.lane) else f" to lane {lane} of road {road}"
        return (
            f"lane {self.lane} of road {self.road} at s = {self.s:.2f} m{beyond}:"
            f" {self.gap:.3f} m, {math.degrees(self.turn):.1f}°"
        )


def seams(roads: Iterable[Road]) -> tuple[Seam, ...]:
    """All seams above the rounding of maps, in the order of roads, sections and lanes."""
    return tuple(
        seam
        for road in roads
        for section in road.sections
        for lane in section.lanes.values()
        if lane.type in _USED and section.end > section.begin
        for seam in (*_within(lane), *_onward(lane))
    )


def _within(lane: Lane) -> Iterator[Seam]:
    """Seams at joints of the pieces of road and lane."""
    begin, end, road = lane.section.begin, lane.section.end, lane.road
    if not lane.section.ready:
        lane.section.prepare()
    joints: set[float] = set()
    for each in (road.reference, lane.centre, road.elevation, road.superelevation):
        if each is not None:
            joints.update(between(each.starts, max(begin + _BEFORE, each.starts[0]), end))
    for s in sorted(joints):
        before, after = lane_pose(lane, s - _BEFORE, 0.0), lane_pose(lane, s, 0.0)
        ends = (before, after) if lane.direction > 0 else (after, before)
        yield from _seam(lane, s, (road.id, lane.id), *ends)


def _onward(lane: Lane) -> Iterator[Seam]:
    """Seams to the lanes that follow in direction of travel."""
    s, before = _end(lane, at_exit=True)
    for onward in lane.successors:
        if onward.section.end > onward.section.begin:
            _, after = _end(onward, at_exit=False)
            for seam in _seam(lane, s, (onward.road.id, onward.id), before, after):
                beyond = tuple((each.road.id, each.id) for each in onward.successors)
                yield replace(seam, beyond=beyond)


def _end(lane: Lane, *, at_exit: bool) -> tuple[float, Pose]:
    """The s of one end of a lane, just inside, and the pose there."""
    section = lane.section
    if not section.ready:
        section.prepare()
    inset = min(_BEFORE, 0.5 * (section.end - section.begin))
    upper = at_exit == (lane.direction > 0)
    s = section.end - inset if upper else section.begin
    return s, lane_pose(lane, s, 0.0)


def _seam(lane: Lane, s: float, onto: tuple[str, int], before: Pose, after: Pose) -> Iterator[Seam]:
    gap = math.dist(before[:3], after[:3])
    turn = wrap(after.h - before.h)
    if gap > SMALLEST_GAP or abs(turn) > SMALLEST_TURN:
        jump = after.x - before.x, after.y - before.y, turn
        yield Seam(lane.road.id, lane.id, round(s, 3), onto, gap, abs(turn), jump, after[:2])
