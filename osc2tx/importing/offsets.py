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
from osc2tx.importing.ground import OnRoad
from osc2tx.importing.points import lane_beside
from osc2tx.importing.statements import Statement, call
from osc2tx.xosc.player.places import centre

SHIFT_FACTORS = {"sinusoidal": 0.5 * math.pi**2, "linear": 0.5 * math.pi**2, "cubic": 6.0}


class Offsets(Reader):
    """Reads lane changes and lane offsets."""

    def effects(self, node: Node, actor: Actor) -> Iterator[Effect]:
        """Return what a lateral action does."""
        if actor.kind != "vehicle":
            node.leave_out("only vehicles have lanes")
            return
        match node.tag:
            case "LaneChangeAction":
                statement = self._lane_change(node, actor)
            case "LaneOffsetAction":
                statement = self._lane_offset(node, actor)
            case _:
                node.leave_out("a distance across the road is not kept here")
                return
        if statement is not None:
            yield Effect(statement, actor.name, frozenset((LATERAL,)))

    def _lane_change(self, node: Node, actor: Actor) -> Statement | None:
        target, before = node.one("LaneChangeTarget").inner, self._lane_of(actor)
        lanes, reference = self._lanes_to(target, actor)
        after = self._lane_of(actor)
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
            to_left = self._along(actor) > 0
            arguments["offset"] = offset.text if to_left else f"-{offset.within(PRODUCT)}"
        self._offsets[actor.said] = offset.value * self._along(actor)
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
            now = self._speeds.get(actor.said)
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
        modifiers = [lane_beside(reference, lanes), f"position(0m, ahead_of: {actor.name})"]
        return Statement(call(actor.name, "assign_position"), modifiers=modifiers, length=0.0)

    def _along(self, actor: Actor) -> int:
        """Return 1 for an actor in a lane along its road, -1 against it."""
        at = self._on_road(actor)
        return 1 if at is None else at.direction

    def _lanes_to(self, target: Node, actor: Actor) -> tuple[int | None, str]:
        """Return how many lanes to the left a target is, and of which other actor."""
        here, at = self._lane_of(actor), self._on_road(actor)
        if target.tag == "RelativeTargetLane":
            reference = self._actor(target)
            lanes = int(self._values.fixed(target, "value"))
            if reference is not actor:
                self._lanes[actor.said] = None
                return lanes, reference.name
            if here is not None:
                there = here + lanes * self._along(actor)
                self._lanes[actor.said] = there if there * here > 0 else None
            return lanes, ""
        goal = int(self._values.fixed(target, "value"))
        if here is None or at is None:
            return None, ""
        section = at.map.roads[at.place.road].section_at(at.place.s)
        low, high = sorted((here, goal))
        between = [each for each in section.lanes if low <= each <= high and each != here]
        driving = [each for each in between if section.lanes[each].type == "driving"]
        self._lanes[actor.said] = goal
        sign = (1 if goal > here else -1) * at.direction  # also in a lane of oncoming traffic
        return sign * len(driving) * at.body.along, ""

    def _lane_of(self, actor: Actor) -> int | None:
        body = self._body(actor)
        start = None if body is None or body.place is None else body.place.lane
        return self._lanes.get(actor.said, start)

    def _lane_offset(self, node: Node, actor: Actor) -> Statement | None:
        target = node.one("LaneOffsetTarget").inner
        offset = self._values.quantity(target, "value", LENGTH)
        beside, sign = 0.0, self._along(actor)
        if target.tag == "RelativeTargetLaneOffset":
            reference = self._actor(target)
            target.approximate(f"the offset of {reference.said} is the one that it was given last")
            beside = self._offset_beside(actor, reference)
            body = self._body(reference)
            sign *= self._along(reference) * (1 if body is None else body.along)
        dynamics = node.one("LaneOffsetActionDynamics")
        shape = dynamics.text("dynamicsShape") or "step"
        peak = self._values.nominal(dynamics, "maxLateralAcc", math.inf)
        continuous = node.is_true("continuous")
        after = offset.value * sign + beside
        change = abs(after - self._offset_of(actor))
        self._shift(actor, after)
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

    def _shift(self, actor: Actor, offset: float) -> None:
        """Note the offset of an actor, which may take it into another lane."""
        self._offsets[actor.said] = offset
        at = self._in_lane(actor)
        if at is None:
            return
        pose = at.map.pose(at.place._replace(offset=offset))
        there = at.map.locate(pose.x, pose.y, heading=pose.h)
        if there is not None and there.road == at.place.road and there.lane != at.place.lane:
            self._lanes[actor.said], self._offsets[actor.said] = there.lane, there.offset

    def _in_lane(self, actor: Actor) -> OnRoad | None:
        """Return an actor at its start, in the lane in which it is by now; `None`: not known."""
        at = self._on_road(actor)
        place = None if at is None else at.body.lane(at.map)
        lane = None if place is None else self._lanes.get(actor.said, place.lane)
        if at is None or place is None or lane is None:
            return None
        return at._replace(place=place._replace(lane=lane))

    def _offset_beside(self, actor: Actor, reference: Actor) -> float:
        """Return the offset (m) at which an actor is as far across the road as another one."""
        theirs, mine = self._in_lane(reference), self._in_lane(actor)
        offset = self._offset_of(reference)
        if theirs is None or mine is None or theirs.place.road != mine.place.road:
            return offset
        across = centre(theirs.map, theirs.place._replace(offset=offset))
        return (across - centre(mine.map, mine.place._replace(offset=0.0))) * self._along(actor)

    def _offset_of(self, actor: Actor) -> float:
        """Return the offset (m) of an actor in its lane that was commanded last, to the left."""
        if actor.said in self._offsets:
            return self._offsets[actor.said]
        at = self._on_road(actor)
        place = None if at is None else at.body.lane(at.map)
        return 0.0 if place is None else place.offset  # in the lane that it is really in
