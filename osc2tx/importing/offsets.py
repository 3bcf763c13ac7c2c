"""Actions across the road."""

from __future__ import annotations

import math
from collections.abc import Iterator

from osc2tx.importing.cast import Actor
from osc2tx.importing.cursor import Node
from osc2tx.importing.dimensions import (
    LENGTH,
    PRODUCT,
    SPEED,
    TIME,
    Quantity,
    literal,
    total,
)
from osc2tx.importing.effects import (
    CUBIC,
    LATERAL,
    PROFILES,
    Effect,
    Reader,
    of_dynamics,
    smooth_peak,
)
from osc2tx.importing.statements import Statement, call
from osc2tx.xosc.element import Unresolved
from osc2tx.xosc.player.places import centre
from osc2tx_runtime.opendrive import LanePosition

SHIFT_FACTORS = {"sinusoidal": 0.5 * math.pi**2, "linear": 0.5 * math.pi**2, "cubic": 6.0}


class Offsets(Reader):
    """Reads lane changes and lane offsets."""

    def effects(self, node: Node, said: str, actor: Actor) -> Iterator[Effect]:
        """Return what a lateral action does."""
        if actor.kind != "vehicle":
            node.leave_out("only vehicles have lanes")
            return
        match node.tag:
            case "LaneChangeAction":
                statement = self._lane_change(node, said, actor)
            case "LaneOffsetAction":
                statement = self._lane_offset(node, said, actor)
            case _:
                node.leave_out("a distance across the road is not kept here")
                return
        if statement is not None:
            yield Effect(statement, actor.name, frozenset((LATERAL,)))

    def _lane_change(self, node: Node, said: str, actor: Actor) -> Statement | None:
        target, before = node.one("LaneChangeTarget").inner, self._lane_of(said)
        lanes, reference = self._lanes_to(target, said)
        after = self._lane_of(said)
        is_along = before is None or after is None or before * after > 0
        if lanes is None:
            target.leave_out("which lane the actor is in is not known before the run")
            node.use_all()
            return None
        arguments = {}
        if lanes == 0 and not reference:
            node.use_all()  # it is in that lane
            return None
        if lanes == 0:
            arguments["side"] = "same"
        else:
            if abs(lanes) > 1:
                arguments["num_of_lanes"] = str(abs(lanes))
            arguments["side"] = "left" if lanes > 0 else "right"
        if reference:
            arguments["reference"] = reference
        offset = self._values.quantity(node, "targetLaneOffset", LENGTH)
        if offset.is_open or abs(offset.value) > 1e-9:
            sign = self._along(said)
            text = offset.text if sign > 0 else f"-{offset.within(PRODUCT)}"
            arguments["offset"] = text
        self._offsets[said] = offset.value * self._along(said)
        dynamics = node.one("LaneChangeActionDynamics")
        shape = dynamics.text("dynamicsShape") or "sinusoidal"
        dynamics.text("followingMode")
        dimension = dynamics.text("dynamicsDimension") or "time"
        value = self._values.quantity(dynamics, "value", of_dynamics(dynamics))
        length: float | None = None
        if shape == "step" or value.value <= 0.0:
            if is_along and "offset" not in arguments:
                return self._at_once(actor, lanes, reference or actor.name)
            dynamics.approximate("a jump to another lane is a quick change here")
            arguments |= {"rate_profile": "constant", "duration": "0.1s"}
            return Statement(call(actor.name, "change_lane", **arguments), length=0.1)
        if shape == "cubic":
            dynamics.approximate(
                f"a cubic course is smooth here, {CUBIC:.1%} of its way off at most"
            )
        if shape == "linear":
            arguments["rate_profile"] = "constant"
        if dimension == "time":
            arguments["duration"] = value.text
            length = value.value
        elif dimension == "rate":
            if shape != "linear":
                arguments["rate_profile"] = "smooth"
            arguments["rate_peak"] = smooth_peak(value, SPEED) if shape == "cubic" else value.text
        else:
            now = self._speeds.get(said)
            if now is None or now.value <= 0.0:
                dynamics.approximate("the way of the change is that of its usual time")
            else:
                dynamics.approximate("the way of the change is that at the speed last commanded")
                length = value.value / now.value
                arguments["duration"] = literal(round(length, 6), TIME)
        return Statement(call(actor.name, "change_lane", **arguments), length=length)

    @staticmethod
    def _at_once(actor: Actor, lanes: int, reference: str) -> Statement:
        """Return what puts an actor into another lane, where it is along the road."""
        side = "left" if lanes > 0 else "right"
        count = "" if abs(lanes) == 1 else f"{abs(lanes)}, "
        lane = f"lane({count}side_of: {reference}, side: {side})"
        modifiers = [
            lane if lanes else f"lane(same_as: {reference})",
            f"position(0m, ahead_of: {actor.name})",
        ]
        return Statement(call(actor.name, "assign_position"), modifiers=modifiers, length=0.0)

    def _along(self, said: str) -> int:
        """Return 1 for an actor in a lane along its road, -1 against it."""
        body, road_map = self._places.bodies.get(said), self._places.map
        if body is None or body.place is None or road_map is None:
            return 1
        return road_map.travel_direction(body.place.road, body.place.lane)

    def _lanes_to(self, target: Node, said: str) -> tuple[int | None, str]:
        """Return how many lanes to the left a target is, and of which other actor."""
        if target.tag == "RelativeTargetLane":
            reference = self._values.text(target, "entityRef")
            lanes = int(self._values.fixed(target, "value"))
            if reference == said:
                self._move(said, lanes)
                return lanes, ""
            self._lanes[said] = None
            actor = self._actors.get(reference)
            if actor is None:
                raise Unresolved(f"there is no entity {reference}", target.place)
            return lanes, actor.name
        goal = int(self._values.fixed(target, "value"))
        body, road_map = self._places.bodies.get(said), self._places.map
        here = self._lane_of(said)
        if here is None or road_map is None or body is None or body.place is None:
            return None, ""
        section = road_map.roads[body.place.road].section_at(body.place.s)
        low, high = sorted((here, goal))
        between = [each for each in section.lanes if low <= each <= high and each != here]
        driving = [each for each in between if section.lanes[each].type == "driving"]
        self._lanes[said] = goal
        sign = (1 if goal > here else -1) * self._along(said)  # also in a lane of oncoming traffic
        return sign * len(driving) * body.along, ""

    def _lane_of(self, said: str) -> int | None:
        if said in self._lanes:
            return self._lanes[said]
        body = self._places.bodies.get(said)
        return None if body is None or body.place is None else body.place.lane

    def _move(self, said: str, lanes: int) -> None:
        here = self._lane_of(said)
        if here is not None:
            there = here + lanes * self._along(said)
            self._lanes[said] = there if there * here > 0 else None

    def _lane_offset(self, node: Node, said: str, actor: Actor) -> Statement | None:
        target = node.one("LaneOffsetTarget").inner
        offset = self._values.quantity(target, "value", LENGTH)
        beside, sign = 0.0, self._along(said)
        if target.tag == "RelativeTargetLaneOffset":
            reference = self._values.text(target, "entityRef")
            target.approximate(f"the offset of {reference} is the one that it was given last")
            beside = self._offset_beside(said, reference)
            body = self._places.bodies.get(reference)
            sign *= self._along(reference) * (1 if body is None else body.along)
        dynamics = node.one("LaneOffsetActionDynamics")
        shape = dynamics.text("dynamicsShape") or "step"
        peak = self._values.nominal(dynamics, "maxLateralAcc", math.inf)
        continuous = (node.text("continuous") or "false").lower() in ("true", "1")
        after = offset.value * sign + beside
        change = abs(after - self._offset_of(said))
        self._shift(said, after)
        time = math.sqrt(SHIFT_FACTORS.get(shape, 0.0) * change / peak) if peak > 0.0 else 0.0
        if time <= 0.0 or shape == "step":
            node.approximate(
                "how fast an offset without limits is reached is a matter of the world"
            )
            time = 1.0
        elif offset.is_open:
            node.approximate("the change takes as long as that of the nominal values")
        if shape == "cubic":
            said_off = f"a cubic course is smooth here, {CUBIC:.1%} of its way off at most"
            dynamics.approximate(said_off, bound=math.ceil(CUBIC * change * 1e3) / 1e3)
        text = total(LENGTH, (sign, offset), (1, Quantity("", round(beside, 6)))).text
        arguments = {"offset": text, "rate_profile": PROFILES.get(shape, "smooth")}
        if change > 0.0:
            fastest = change / time * (1.0 if shape == "linear" else 0.5 * math.pi)
            arguments["rate_peak"] = literal(round(fastest, 4), SPEED)
        arguments["duration"] = literal(round(time, 4), TIME)
        if continuous:
            node.approximate("an offset that is kept ends here when it is reached")
        return Statement(call(actor.name, "follow_lane", **arguments), length=time)

    def _shift(self, said: str, offset: float) -> None:
        """Note the offset of an actor, which may take it into another lane."""
        self._offsets[said] = offset
        body, road_map = self._places.bodies.get(said), self._places.map
        place = None if body is None or road_map is None else body.lane(road_map)
        if place is None or road_map is None:
            return
        lane = self._lanes.get(said, place.lane)
        if lane is None:
            return
        pose = road_map.pose(place._replace(lane=lane, offset=offset))
        there = road_map.locate(pose.x, pose.y, heading=pose.h)
        if there is not None and there.road == place.road and there.lane != lane:
            self._lanes[said], self._offsets[said] = there.lane, there.offset

    def _offset_beside(self, said: str, reference: str) -> float:
        """Return the offset (m) at which an actor is as far across the road as another one."""
        theirs, mine = self._across(reference, self._offset_of(reference)), self._across(said, 0.0)
        if theirs is None or mine is None or theirs[0] != mine[0]:
            return self._offset_of(reference)
        return (theirs[1] - mine[1]) * self._along(said)

    def _across(self, said: str, offset: float) -> tuple[str, float] | None:
        """Return the road of an actor and its t (m) there, with an offset in its lane."""
        body, road_map = self._places.bodies.get(said), self._places.map
        if body is None or body.place is None or road_map is None:
            return None
        place = body.lane(road_map)
        lane = None if place is None else self._lanes.get(said, place.lane)
        if place is None or lane is None:
            return None
        return place.road, centre(road_map, LanePosition(place.road, lane, place.s, offset))

    def _offset_of(self, said: str) -> float:
        """Return the offset (m) of an actor in its lane that was commanded last, to the left."""
        if said in self._offsets:
            return self._offsets[said]
        body, road_map = self._places.bodies.get(said), self._places.map
        if body is None or body.place is None or road_map is None:
            return 0.0
        place = body.lane(road_map)  # the one that it is in, which it may not be said to be in
        return 0.0 if place is None else place.offset
