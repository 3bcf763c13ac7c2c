"""Lateral actions: courses of the offset, and distances across the road."""

from __future__ import annotations

import math

from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Element
from osc2tx.xosc.player.bodies import LATERAL, Body, Running
from osc2tx.xosc.player.courses import PEAK_RATES, Course, number, shaped
from osc2tx.xosc.player.errors import Unplayable
from osc2tx.xosc.player.places import beside, centre, offset_of
from osc2tx.xosc.player.scene import GAP_REACHED, Scene
from osc2tx_runtime.opendrive import LanePosition

NEARING = 2.0  # 1/s
# Peak acceleration times the square of the length, by the change. A steady change has none: the
# standard leaves its length to the tool.
PEAK_FACTORS = {
    "sinusoidal": 0.5 * math.pi**2,
    "linear": 0.5 * math.pi**2,
    "cubic": 6.0,
    "step": 0.0,
}


def _length_of(dynamics: Element, change: float) -> float:
    """Return the length of a lane change, in the seconds or metres that its dynamics state."""
    shape, value = dynamics.said("dynamicsShape"), number(dynamics, "value")
    if shape == "step":
        return 0.0
    if dynamics.said("dynamicsDimension") != "rate":
        return max(value, 0.0)
    if value == 0.0:
        return math.inf if change else 0.0
    return PEAK_RATES[shape] * change / abs(value)


class Offsets:
    """Lateral actions at work."""

    def __init__(self, scene: Scene) -> None:
        self._scene = scene

    def begin(self, body: Body, node: Element) -> Running:
        """Return a lateral action that begins."""
        run = Running(body, (LATERAL,), self._scene.time, 0.0)
        if node.tag == "LateralDistanceAction":
            run.length, run.gap = None, node
            run.side = self._scene.side(body, node, "lateral")
            return run
        if body.place is None:
            if not body.keeps_lanes:
                raise Unplayable(f"{body.name} is on no lane")
            body.put(self._scene.map, body.in_lane(self._scene.map), body.here.h)  # off its path
        if node.tag == "LaneOffsetAction":
            run.length, run.offset = self._to_offset(body, node)
            return run
        if not (node.tag == "LaneChangeAction"):
            raise Unplayable(f"<{node.tag}> is not played", node.place)
        place = body.in_lane(self._scene.map)
        goal = node.one(xml.LaneChangeTarget).inner
        if goal.tag == "AbsoluteTargetLane":
            lane = LanePosition(place.road, int(number(goal, "value")), place.s)
        else:
            other = self._scene.bodies[goal.said("entityRef")]
            theirs = other.in_lane(self._scene.map)
            if theirs.road != place.road:  # at the height of the actor
                along = self._scene.map.route_distance(theirs, place)
                if along is None:
                    raise Unplayable(
                        f"there is no way from {other.name} to {body.name}", node.place
                    )
                theirs = self._scene.map.advance(theirs._replace(offset=0.0), along).position
            number_ = beside(self._scene.map, theirs, other.along, int(number(goal, "value"))).lane
            lane = LanePosition(place.road, number_, place.s)
        run.changes_lane = True
        if self._direction(lane) != self._direction(place):
            body.along = -body.along
        start = offset_of(self._scene.map, lane, body.here)
        body.place = lane._replace(offset=start)
        end = number(node, "targetLaneOffset") * self._direction(lane)
        dynamics = node.one(xml.LaneChangeActionDynamics)
        run.is_by_way = dynamics.said("dynamicsDimension") == "distance"
        run.length = _length_of(dynamics, abs(end - start))
        run.offset = shaped(dynamics.said("dynamicsShape"), start, end, run.length)
        return run

    def _direction(self, place: LanePosition) -> int:
        return self._scene.map.travel_direction(place.road, place.lane)

    def _to_offset(self, body: Body, node: Element) -> tuple[float, Course]:
        """Return length and course of a change of the offset, whose acceleration has a peak.

        Offsets of the document count along t of the road, those beside an entity to its left, those
        of bodies to the left of travel.
        """
        place = body.in_lane(self._scene.map)
        body.place = place._replace(offset=offset_of(self._scene.map, place, body.here))
        target = node.one(xml.LaneOffsetTarget).inner
        end = number(target, "value")
        if target.tag == "RelativeTargetLaneOffset":
            other = self._scene.bodies[target.said("entityRef")]
            theirs, road_map = other.in_lane(self._scene.map), self._scene.map
            apart = centre(road_map, theirs) - centre(road_map, place._replace(offset=0.0))
            end = apart + end * self._direction(theirs) * other.along
        end *= self._direction(place)
        dynamics = node.one(xml.LaneOffsetActionDynamics)
        shape, peak = dynamics.said("dynamicsShape"), number(dynamics, "maxLateralAcc", math.inf)
        change = abs(end - body.place.offset)
        factor = PEAK_FACTORS[shape]
        time = math.sqrt(factor * change / peak)
        return time, shaped(shape, body.place.offset, end, time)

    def keep_aside(self, body: Body, run: Running, node: Element, way: float) -> None:
        """Move a body by a distance (m), and towards its lateral gap.

        Without limits the gap is rigid; otherwise it is approached at a decreasing speed.
        """
        scene = self._scene
        limits, wanted = node.find(xml.DynamicConstraints), number(node, "distance")
        if node.get("freespace") == "true":
            other = scene.bodies[node.said("entityRef")]
            system = node.get("coordinateSystem") or "entity"
            own, theirs = scene.ruler.extents(body, other, "lateral", system)
            wanted += theirs.high - own.low if run.side > 0 else own.high - theirs.low
        aside = scene.gap(body, node, "lateral") + run.side * wanted
        if node.get("continuous") != "true" and abs(aside) < GAP_REACHED:
            run.done = True
        if limits is not None:
            fastest = number(limits, "maxSpeed", math.inf)
            aside = min(max(NEARING * aside, -fastest), fastest) * scene.dt
        if body.place is None:
            raise Unplayable(f"{body.name} is on no lane")
        body.move(scene.map, way, body.place.offset + aside * body.along, scene.dt)
