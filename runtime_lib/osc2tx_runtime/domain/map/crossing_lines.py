"""Centre lines of crossings, from lane to lane (DSL 8.5.8)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise, permutations
from typing import TYPE_CHECKING, NamedTuple

from osc2tx_runtime.domain.map.lane_types import LANE_TYPES
from osc2tx_runtime.domain.map.segments import CrossingLine, MapSegment
from osc2tx_runtime.opendrive import Crosswalk, LanePosition, Pose
from osc2tx_shared.classes import replace

if TYPE_CHECKING:
    from osc2tx_runtime.domain.map.lane_graph import LaneGraph

_BEYOND = 4.0  # m behind the ends of a crosswalk where a sidewalk may have its centre line
_SAMPLE = 0.25  # m along a crosswalk between samples of the lane under it
_COARSE = 4.0  # m along a lane between samples of the side on which a crossing is
_EXACT = 1e-9  # m
_ALIGNED = math.radians(10.0)  # between a crossing and its crosswalk


class _Meeting(NamedTuple):
    """Where a straight line meets the centre line of a lane.

    Attributes:
        lane: The lane.
        along: Metres along the straight line.
        s: Road coordinate (m).
    """

    lane: MapSegment
    along: float
    s: float


def on_crosswalk(graph: LaneGraph, crosswalk: Crosswalk) -> Iterator[MapSegment]:
    """Crossings on a crosswalk in either direction, those from end to end first.

    They join any two of the lanes that the crosswalk crosses or touches.
    """
    line = Pose(crosswalk.x, crosswalk.y, 0.0, crosswalk.heading)
    half = 0.5 * crosswalk.length
    meetings = [
        found
        for lane in _lanes_under(graph, crosswalk, half + _BEYOND)
        for found in _meetings(graph, lane, line)
        if abs(found.along) <= half + _BEYOND
    ]

    def off_ends(pair: tuple[_Meeting, _Meeting]) -> tuple[float, bool]:
        first, last = pair
        low, high = sorted((first.along, last.along))
        return abs(low + half) + abs(high - half), first.along > last.along

    for first, last in sorted(permutations(meetings, 2), key=off_ends):
        if first.lane != last.lane:
            found = _crossing(graph, first, last)
            assert found.line is not None
            yield replace(
                found,
                line=replace(found.line, crosswalk=crosswalk.id, width=crosswalk.width),
            )


def laid(
    graph: LaneGraph, start: MapSegment, end: MapSegment, start_s: float, angle: float
) -> MapSegment | None:
    """A crossing that begins on a lane; None if it does not reach the end lane.

    Args:
        graph: The map.
        start: Lane on whose centre line it begins.
        end: Lane on whose centre line it ends.
        start_s: Metres along the first lane.
        angle: Between the direction of the first lane and the crossing (rad), towards the side of
            the other lane.
    """
    s = graph.s_at(start, start_s)
    if s is None:
        return None
    at = _centre(graph, start, s)
    found = [
        meeting
        for side in (1.0, -1.0)
        for meeting in _meetings(graph, end, Pose(at.x, at.y, at.z, at.h + side * angle))
        if meeting.along > _COARSE * _EXACT
    ]
    if not found or start == end:
        return None
    segment = _crossing(
        graph, _Meeting(start, 0.0, s), min(found, key=lambda meeting: meeting.along)
    )
    return _as_crosswalk(graph, segment)


def _as_crosswalk(graph: LaneGraph, segment: MapSegment) -> MapSegment:
    """Sets the crosswalk of the map on which a crossing lies, if any."""
    line = segment.line
    assert line is not None
    for crosswalk in graph.map.crosswalks():
        along, across = line.place_of(crosswalk.x, crosswalk.y)
        turn = abs(math.remainder(crosswalk.heading - line.heading, math.pi))
        if abs(across) <= 0.5 * crosswalk.width and 0.0 < along < line.length and turn < _ALIGNED:
            line = replace(line, crosswalk=crosswalk.id, width=crosswalk.width)
            return replace(segment, line=line)
    return segment


def _lanes_under(graph: LaneGraph, crosswalk: Crosswalk, reach: float) -> list[MapSegment]:
    """Lanes of all kinds that a crosswalk crosses or touches."""
    c, n = math.cos(crosswalk.heading), math.sin(crosswalk.heading)
    steps = math.ceil(2.0 * reach / _SAMPLE)
    found: dict[MapSegment, None] = {}
    for i in range(steps + 1):
        along = 2.0 * reach * i / steps - reach
        x, y = crosswalk.x + along * c, crosswalk.y + along * n
        on = graph.map.locate(x, y, lane_types=LANE_TYPES, max_distance=1e-3)
        if on is not None:
            found[graph.segment_of(graph.map.lane_key(on))] = None
    return list(found)


def _meetings(graph: LaneGraph, lane: MapSegment, line: Pose) -> list[_Meeting]:
    """Where a straight line meets the centre line of a lane, in order of s."""
    section = graph.lane(lane).section
    steps = max(1, math.ceil((section.end - section.begin) / _COARSE))
    places = [section.begin + (section.end - section.begin) * i / steps for i in range(steps + 1)]
    aside = [_aside(_centre(graph, lane, s), line) for s in places]
    found = []
    for (low, high), (a, b) in zip(pairwise(places), pairwise(aside), strict=True):
        if a == 0.0 or a * b < 0.0:
            s = low if a == 0.0 else _bisect(graph, lane, line, low, high)
            at = _centre(graph, lane, s)
            dx, dy = at.x - line.x, at.y - line.y
            found.append(_Meeting(lane, dx * math.cos(line.h) + dy * math.sin(line.h), s))
    return found


def _bisect(graph: LaneGraph, lane: MapSegment, line: Pose, low: float, high: float) -> float:
    """Road coordinate between two others at which a lane centre is on a straight line."""
    left = _aside(_centre(graph, lane, low), line) > 0.0
    while high - low > _EXACT:
        middle = 0.5 * (low + high)
        if (_aside(_centre(graph, lane, middle), line) > 0.0) == left:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


def _aside(at: Pose, line: Pose) -> float:
    """How far (m) a point is to the left of a straight line."""
    return (at.y - line.y) * math.cos(line.h) - (at.x - line.x) * math.sin(line.h)


def _centre(graph: LaneGraph, lane: MapSegment, s: float) -> Pose:
    """Centre of a lane of one section; its end still belongs to it."""
    section = graph.lane(lane).section
    assert lane.lane is not None
    s = min(s, math.nextafter(section.end, section.begin))
    return graph.map.pose(LanePosition(lane.road, lane.lane, s))


def _crossing(graph: LaneGraph, first: _Meeting, last: _Meeting) -> MapSegment:
    begin, end = _centre(graph, first.lane, first.s), _centre(graph, last.lane, last.s)
    line = CrossingLine(
        x=begin.x,
        y=begin.y,
        z=begin.z,
        heading=math.atan2(end.y - begin.y, end.x - begin.x),
        length=math.hypot(end.x - begin.x, end.y - begin.y),
        climb=end.z - begin.z,
        start_s=graph.along(first.lane, first.s),
        end_s=graph.along(last.lane, last.s),
    )
    return MapSegment(
        "crossing", first.lane.road, first.lane.section, parts=(first.lane, last.lane), line=line
    )
