"""A position that moves along a lane; lane, table and pieces are looked up once, not in each query.

Each step of each actor calls this code, so it consists of two functions. They compute the same as
`advance` and `lane_pose`, in the same order, so the results are identical to the last digit;
positions beyond the lane, and roads with a cross-section surface, are left to those.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable
from typing import NamedTuple

from .arc_length import SLOWEST_RATE, LaneLine
from .geometry import Segment, wrap
from .lane_line import lane_line
from .model import Lane, LanePosition, Pose, new_tuple
from .poses import lane_pose

_SHORT = 1e-3  # m: distance of the end of a stretch from a joint, for seams beside it


class Stretch(NamedTuple):
    """A piece of a lane that is straight or an arc, level, and of constant width.

    Attributes:
        begin: First s (m).
        end: End of the range of s (m).
        node: An s from which the arc length is linear.
        length: The arc length there (m).
        rate: Lane metres per metre of s.
        t: Of its centre (m).
        direction: Of travel: 1 along s, -1 against it.
        segment: The piece of the reference line.
        start: The s at which that starts.
        curvature: Of the reference line (1/m).
    """

    begin: float
    end: float
    node: float
    length: float
    rate: float
    t: float
    direction: int
    segment: Segment
    start: float
    curvature: float


class LaneCursor:
    """Position of one actor on its lane.

    Args:
        find: Returns the lane at a position, and its s limited to the road.
    """

    __slots__ = (
        "_begin",
        "_centre",
        "_centre_end",
        "_centre_start",
        "_cos",
        "_end",
        "_find",
        "_h",
        "_heading",
        "_is_flat",
        "_lane",
        "_line",
        "_place",
        "_row",
        "_segment",
        "_segment_end",
        "_segment_start",
        "_sin",
    )

    def __init__(self, find: Callable[[str, int, float], tuple[Lane, float]]) -> None:
        self._find = find
        self._place: LanePosition | None = None
        self._lane: Lane
        self._line: LaneLine
        self._begin = self._end = 0.0  # s at which the lane begins and ends
        self._row = 0  # of the table
        self._is_flat = False
        self._centre = (0.0, 0.0, 0.0, 0.0)  # the piece of the centre line, with its s
        self._centre_start = self._centre_end = 0.0
        self._segment: Segment  # the piece of the reference line, with its s
        self._segment_start = self._segment_end = 0.0
        self._h, self._sin, self._cos = math.nan, 0.0, 1.0  # of the reference line there (rad)
        self._heading = 0.0  # of a lane along it, in direction of travel

    def _go_to(self, place: LanePosition) -> bool:
        """Looks up a position; returns whether it exists on the road."""
        self._place = None
        lane, s = self._find(place.road, place.lane, place.s)
        if s != place.s:
            return False
        road, line = lane.road, lane_line(lane)
        self._lane, self._line = lane, line
        self._begin, self._end = lane.section.begin, lane.section.end
        self._row = max(bisect_right(line.nodes, s) - 1, 0)
        self._is_flat = road.is_flat and lane.heights is None
        self._centre_start = self._centre_end = 0.0
        self._segment_start = self._segment_end = 0.0
        self._h = math.nan
        self._place = place
        return True

    def moved(self, p: LanePosition, distance: float, offset: float) -> LanePosition | None:
        """Position at a distance (m, finite) along the lane, at another offset.

        None beyond the lane.

        Args:
            p: The start, with the offset of the motion.
            distance: Metres, negative backwards.
            offset: Of the result (m).
        """
        s = p.s
        if (p is not self._place or not self._begin <= s < self._end) and not self._go_to(p):
            return None
        lane, line, row = self._lane, self._line, self._row
        direction = lane.direction
        aside = p.offset * direction
        if not line.offset_min <= aside <= line.offset_max:
            return None
        nodes, rows, last = line.nodes, line.rows, len(line.nodes) - 1
        if (row and s < nodes[row]) or (row < last and s >= nodes[row + 1]):
            row = max(bisect_right(nodes, s) - 1, 0)
        # The arc length here.
        a, b, c, d = rows[row]
        u = s - nodes[row]
        there = a + u * (b + u * (c + u * d))
        if aside:
            pa, pb, pc, pd = line.psi[row]
            there -= aside * (pa + u * (pb + u * (pc + u * pd)))
        # The s of the length there, usually in the same row of the table.
        there += distance * direction
        if not 0.0 <= there < line.length - aside * line.turn:
            return None
        psi = line.psi
        if (row and rows[row][0] - aside * psi[row][0] > there) or (
            row < last and rows[row + 1][0] - aside * psi[row + 1][0] <= there
        ):
            row = line.row_of(there, aside)
            s = line.s_in(row, there, aside)
        elif aside or c or d or b <= SLOWEST_RATE:
            s = line.s_in(row, there, aside)
        else:  # a straight line or an arc of constant width, as in `s_in`
            start, end = nodes[row], nodes[row + 1] if row < last else line.end
            u, most = (there - a) / b, end - start
            s = start + (0.0 if u < 0.0 else most if u > most else u)
        self._row = row
        place = self._place = new_tuple(LanePosition, (p.road, p.lane, s, offset))
        return place

    def pose(self, p: LanePosition) -> Pose:
        """Pose at a position, heading in direction of travel including the slope of the lane."""
        s = p.s
        if (p is not self._place or not self._begin <= s < self._end) and not self._go_to(p):
            lane, s = self._find(p.road, p.lane, p.s)
            return lane_pose(lane, s, p.offset)
        lane = self._lane
        if not self._is_flat:
            return lane_pose(lane, s, p.offset)
        if not self._centre_start <= s < self._centre_end:
            self._find_centre(lane, s)
        if not self._segment_start <= s < self._segment_end:
            self._find_segment(lane, s)
        a, b, c, d = self._centre
        u = s - self._centre_start
        t, slope = a + u * (b + u * (c + u * d)), b + u * (2.0 * c + u * 3.0 * d)
        t += p.offset * lane.direction
        x, y, h, k = self._segment.at(s - self._segment_start)
        if h != self._h:
            self._h, self._sin, self._cos = h, math.sin(h), math.cos(h)
            self._heading = wrap(h if lane.direction > 0 else h + math.pi)
        heading = self._heading
        if slope:
            heading = h + math.atan2(slope, 1.0 - k * t)
            heading = wrap(heading if lane.direction > 0 else heading + math.pi)
        return new_tuple(Pose, (x - t * self._sin, y + t * self._cos, 0.0, heading, 0.0, 0.0))

    def stretch(self, p: LanePosition) -> Stretch | None:
        """The stretch of the lane around a position in its middle; None without one."""
        s = p.s
        if (p is not self._place or not self._begin <= s < self._end) and not self._go_to(p):
            return None
        lane, line = self._lane, self._line
        row = max(bisect_right(line.nodes, s) - 1, 0)
        node, (length, rate, c, d) = line.nodes[row], line.rows[row]
        if not self._is_flat or p.offset or c or d or rate <= SLOWEST_RATE:
            return None
        self._find_centre(lane, s)
        self._find_segment(lane, s)
        t, *changes = self._centre
        curvature = self._segment.constant_curvature()
        begin = max(self._begin, self._centre_start, self._segment_start, node) + _SHORT
        end = min(self._end, self._centre_end, self._segment_end)
        end = min([end, *line.nodes[row + 1 : row + 2]]) - _SHORT
        if curvature is None or any(changes) or not begin <= s < end:
            return None
        return Stretch(
            begin,
            end,
            node,
            length,
            rate,
            t,
            lane.direction,
            self._segment,
            self._segment_start,
            curvature,
        )

    def _find_centre(self, lane: Lane, s: float) -> None:
        starts = lane.centre.starts
        i = lane.centre.index(s)
        self._centre, self._centre_start = lane.centre.rows[i], starts[i]
        self._centre_end = starts[i + 1] if i + 1 < len(starts) else math.inf

    def _find_segment(self, lane: Lane, s: float) -> None:
        starts = lane.road.reference.starts
        self._segment_start, self._segment = lane.road.reference.segment_at(s)
        i = bisect_right(starts, s)
        self._segment_end = starts[i] if i < len(starts) else math.inf
