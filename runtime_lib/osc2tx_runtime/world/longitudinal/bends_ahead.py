"""Bends ahead, and how fast a driver goes towards them.

A driver takes a bend at a comfortable lateral acceleration and brakes for it comfortably: v^2 <=
a_y / |k| + 2 b d for each curvature k at a distance d.
"""

from __future__ import annotations

import math

from osc2tx_runtime.opendrive import DRIVING, LanePosition, RoadMap, Route
from osc2tx_runtime.opendrive.lane_bends import lane_bends
from osc2tx_runtime.opendrive.lane_line import lane_line
from osc2tx_runtime.world.actor_dimensions import COMFORT, Limits
from osc2tx_runtime.world.state import ActorState

_STEP_OVER = 1e-6  # m beyond the end of a lane, so as to be on the next one
_OF_GRIP = 0.8  # share of the grip for the bend
_OF_BRAKES = 0.5  # share for the brakes: with both the friction circle holds
_LANES = 50  # how many lanes ahead are looked at


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
            grip: m/s^2 that the road holds.
            lead: How many metres further on it will have that speed.
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
