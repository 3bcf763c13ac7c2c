"""Bends ahead, and the speed at which a driver approaches them.

A driver takes a bend at a comfortable lateral acceleration and brakes for it comfortably: v^2 <=
a_y / |k| + 2 b d for each curvature k at a distance d.
"""

from __future__ import annotations

import math
from itertools import pairwise

from osc2tx_runtime.opendrive import DRIVING, LanePosition, RoadMap, Route
from osc2tx_runtime.opendrive.arc_length import LaneLine
from osc2tx_runtime.opendrive.geometry import wrap
from osc2tx_runtime.opendrive.lane_advance import lane_heading
from osc2tx_runtime.opendrive.lane_line import lane_line
from osc2tx_runtime.opendrive.model import Lane, LaneBends
from osc2tx_runtime.world.actor_dimensions import COMFORT, Limits
from osc2tx_runtime.world.state import ActorState

_STRETCH = 2.0  # m of a lane over which its curvature is taken
_SHORTEST = 0.5  # m: lanes shorter than this have no bends
_STRAIGHT = 5e-4  # 1/m: a lower curvature limits no speed
_AT_THE_END = 1e-6  # m before the end


def lane_bends(lane: Lane) -> LaneBends:
    """The bends of a lane, computed on first use."""
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


_STEP_OVER = 1e-6  # m beyond the end of a lane, on the next one
_OF_GRIP = 0.8  # share of the grip for the bend
_OF_BRAKES = 0.5  # share for the brakes: with both the friction circle holds
_LANES = 50  # greatest number of lanes ahead


class BendsAhead:
    """The bends of a map.

    Args:
        road_map: The map.
    """

    def __init__(self, road_map: RoadMap) -> None:
        self._map = road_map

    def fastest(
        self, me: ActorState, route: Route | None, limits: Limits, grip: float, lead: float
    ) -> float:
        """Speed (m/s) at which a driver approaches the bends ahead; infinite on a straight road.

        Args:
            me: The actor.
            route: Its route at forks.
            limits: Of the vehicle on the present road.
            grip: Grip limit (m/s^2).
            lead: Metres ahead at which it will have that speed.
        """
        place = me.lane_position
        if place is None or me.v <= 0.0:
            return math.inf
        across = min(limits.lateral, _OF_GRIP * grip)
        brake = min(COMFORT * limits.deceleration, _OF_BRAKES * grip)
        reach = 0.5 * me.v * me.v / brake + lead
        place, best, before = LanePosition(place.road, place.lane, place.s), math.inf, 0.0
        for _ in range(_LANES):
            lane = self._map.roads[place.road].section_at(place.s).lanes[place.lane]
            line = lane_line(lane)
            at = line.length_at(place.s)
            at = at if lane.direction > 0 else line.length - at
            sharpest, bends = lane_bends(lane)
            if sharpest * me.v * me.v > across:
                for begin, end, curvature in bends:
                    if end > at and before + begin - at <= reach:
                        ahead = max(before + begin - at - lead, 0.0)
                        best = min(best, across / curvature + 2.0 * brake * ahead)
            left = line.length - at + _STEP_OVER
            before += left
            if before > reach:
                break
            step = self._map.advance(place, left, route)
            if step.travelled < left - 0.5 * _STEP_OVER:
                break
            place = step.position
        return math.sqrt(best)

    def sharpest(self) -> float:
        """The largest curvature (1/m) of the driving lanes of the map."""
        lanes = (
            lane
            for road in self._map.roads.values()
            for section in road.sections
            for lane in section.lanes.values()
            if lane.type in DRIVING
        )
        return max((lane_bends(lane).sharpest for lane in lanes), default=0.0)
