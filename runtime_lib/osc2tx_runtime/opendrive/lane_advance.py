"""Moving along lanes: arc length steps over section and road ends."""

from __future__ import annotations

import math

from osc2tx_runtime.errors import PlacementError

from .geometry import wrap
from .lane_distances import Route
from .lane_line import lane_line
from .model import Advance, Lane, LanePosition
from .network import lane_order

_PROBE = 50.0  # m into a branch at which its direction is compared
_IDLE_HOPS = 1000  # successive lanes without length: a loop of them would be infinite


def lane_heading(lane: Lane, s: float) -> float:
    """Heading in direction of travel (rad, not wrapped), including the slope of the lane."""
    x_heading = lane.road.reference.at(s)
    t, slope = lane.centre.value_slope(s)
    heading = x_heading[2] + math.atan2(slope, 1.0 - x_heading[3] * t)
    return heading if lane.direction > 0 else heading + math.pi


class _Motion:
    """State of a step. `offset` is in direction of travel."""

    __slots__ = ("lane", "left", "offset", "s")

    def __init__(self, lane: Lane, s: float, offset: float, left: float) -> None:
        self.lane, self.s, self.offset, self.left = lane, s, offset, left


class Forks:
    """Chooses the successor of a lane; choices without a route are cached."""

    __slots__ = ("_cache",)

    def __init__(self) -> None:
        self._cache: dict[tuple[Lane, bool], Lane] = {}

    def onward(self, lane: Lane, forwards: bool, route: Route | None) -> Lane | None:
        """Lane after the exit (or before the entry) of `lane`; None at a dead end."""
        options = lane.successors if forwards else lane.predecessors
        if len(options) < 2:
            return options[0] if options else None
        if route is not None and forwards:
            costs = [route.cost(option) for option in options]
            best = min(costs)
            if best < math.inf:
                options = tuple(o for o, c in zip(options, costs, strict=True) if c == best)
                return options[0] if len(options) == 1 else self._straightest(lane, options, True)
        key = (lane, forwards)
        if key not in self._cache:
            self._cache[key] = self._straightest(lane, options, forwards)
        return self._cache[key]

    @staticmethod
    def _straightest(lane: Lane, options: tuple[Lane, ...], forwards: bool) -> Lane:
        """Smallest heading change; ties (within 1 mrad) go to the lowest road id."""
        here = _probe(lane, 0.0, from_exit=forwards)

        def change(option: Lane) -> tuple[float, tuple[tuple[int, int, str], int, int]]:
            there = _probe(option, _PROBE, from_exit=not forwards)
            return round(abs(wrap(there - here)), 3), lane_order(option)

        return min(options, key=change)


def _probe(lane: Lane, distance: float, *, from_exit: bool) -> float:
    """Heading at a distance (m) from one end of a lane, at most at its other end."""
    line = lane_line(lane)
    distance = min(distance, line.length)
    at_end = from_exit == (lane.direction > 0)
    s = line.s_at(line.length - distance if at_end else distance)
    # Just inside: the end itself may belong to the next section or piece.
    inset = min(1e-6, 0.5 * (line.end - line.begin))
    return lane_heading(lane, min(max(s, line.begin + inset), line.end - inset))


def advance(
    lane: Lane, p: LanePosition, distance: float, route: Route | None, forks: Forks
) -> Advance:
    """Moves by `distance` (m, negative backwards) along lanes at the offset of `p`.

    Raises:
        PlacementError: The distance is not finite; on a ring road such a move would be infinite.
    """
    if not math.isfinite(distance):
        raise PlacementError(f"no place is {distance:g} m away; give a finite distance")
    forwards = distance >= 0.0
    # Nearly all steps of an actor stay in its lane, so that case comes first.
    line, offset = lane.line or lane_line(lane), p.offset * lane.direction
    if line.offset_min <= offset <= line.offset_max:
        there = line.length_at(p.s, offset) + distance * lane.direction
        if 0.0 <= there < line.length - offset * line.turn:
            s = line.s_at(there, offset)
            return Advance(LanePosition(p.road, p.lane, s, p.offset), distance)
    motion = _Motion(lane, p.s, p.offset, abs(distance))
    idle = 0
    while idle < _IDLE_HOPS:
        before = motion.left
        if _within(motion, forwards):
            break
        onward = forks.onward(motion.lane, forwards, route)
        if onward is None:
            break
        idle = idle + 1 if motion.left == before else 0
        motion.lane = onward
        at_begin = (onward.direction > 0) == forwards
        motion.s = onward.section.begin if at_begin else onward.section.end
    travelled = abs(distance) - motion.left
    position = LanePosition(motion.lane.road.id, motion.lane.id, _inside(motion), p.offset)
    return Advance(position, travelled if forwards else -travelled)


def _within(motion: _Motion, forwards: bool) -> bool:
    """Moves inside the current lane; False if it ends before the distance is covered."""
    lane = motion.lane
    line = lane_line(lane)
    offset = line.clamp(motion.offset * lane.direction) if motion.offset else 0.0
    here = line.length_at(motion.s, offset)
    if (lane.direction > 0) == forwards:
        # The upper end belongs to the next section, hence the strict comparison.
        remaining = line.length_at(line.end, offset) - here
        if motion.left < remaining:
            motion.s = line.s_at(here + motion.left, offset)
            motion.left = 0.0
            return True
        motion.s = line.end
    else:
        remaining = here
        if motion.left <= remaining:
            motion.s = line.s_at(here - motion.left, offset)
            motion.left = 0.0
            return True
        motion.s = line.begin
    motion.left -= max(remaining, 0.0)
    return False


def _inside(motion: _Motion) -> float:
    """The s of the result, below the start of the next section of the same road."""
    section = motion.lane.section
    if motion.s >= section.end and section.end < motion.lane.road.length:
        return math.nextafter(section.end, section.begin)
    return motion.s
