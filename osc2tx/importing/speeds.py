"""Actions along the road."""

from __future__ import annotations

import math
from collections.abc import Iterator

from osc2tx.importing.cast import Actor
from osc2tx.importing.cursor import Node
from osc2tx.importing.dimensions import (
    ACCELERATION,
    LENGTH,
    NUMBER,
    PRODUCT,
    SPEED,
    TIME,
    Quantity,
    literal,
    total,
)
from osc2tx.importing.effects import (
    CUBIC,
    LONGITUDINAL,
    PROFILES,
    Effect,
    Reader,
    Readings,
    of_dynamics,
    smooth_peak,
)
from osc2tx.importing.ground import is_ahead
from osc2tx.importing.points import lane_beside
from osc2tx.importing.profiles import Profiles
from osc2tx.importing.statements import Statement, call, composed
from osc2tx.xosc.player.courses import PEAK_RATES


class Speeds(Reader):
    """Reads actions on speeds, and on distances along the road."""

    def __init__(self, readings: Readings) -> None:
        super().__init__(readings)
        self._profiles = Profiles(readings)

    def effects(self, node: Node, actor: Actor, at_start: bool) -> Iterator[Effect]:
        """Return what a longitudinal action does."""
        slots = frozenset((LONGITUDINAL,))
        match node.tag:
            case "SpeedAction":
                statement = self._speed(node, actor, at_start)
            case "SpeedProfileAction":
                statement = self._profiles.statement(node, actor)
            case "LongitudinalDistanceAction":
                statement = self._gap(node, actor, at_start)
            case _:
                node.leave_out("the language has no such action")
                return
        if statement is None:
            return
        members = statement.members if at_start else None  # `Init` has no compositions
        for each in members or [statement]:
            yield Effect(each, actor.name, slots)

    def _speed(self, node: Node, actor: Actor, at_start: bool) -> Statement | None:
        target_node = node.one("SpeedActionTarget").inner
        dynamics = node.one("SpeedActionDynamics")
        target = self._target(target_node, at_start)
        shape = dynamics.text("dynamicsShape") or "step"
        dynamics.text("followingMode")
        if target_node.is_true("continuous"):
            kept = self._as_fast_as(node, target_node, dynamics, actor)
            if shape != "step":
                return kept
            assigned = Statement(call(actor.name, "assign_speed", target.text), length=0.0)
            return composed("serial", [assigned, kept])
        standing = Quantity(literal(0.0, SPEED), 0.0)
        before = self._speeds.get(actor.said, standing)
        self._speeds[actor.said] = target
        value = self._values.quantity(dynamics, "value", of_dynamics(dynamics))
        dimension = dynamics.text("dynamicsDimension") or "time"
        if shape == "step" or (dimension in ("time", "distance") and value.value == 0.0):
            dynamics.idle("the speed is there at once")
            return Statement(call(actor.name, "assign_speed", target.text), length=0.0)
        if shape == "cubic":
            dynamics.approximate(
                f"a cubic course of the speed is smooth here, {CUBIC:.1%} of its change off at most"
            )
        arguments = {"target": target.text, "rate_profile": PROFILES.get(shape, "constant")}
        limit = self._limit_within(actor, before, target, shape, value.value, dimension)
        if limit is not None:
            dynamics.approximate("the change is held to what the vehicle can do")
            value, dimension = Quantity(literal(limit, ACCELERATION), limit), "rate"
        if dimension == "time":
            arguments["duration"] = value.text
            return Statement(call(actor.name, "change_speed", **arguments), length=value.value)
        if dimension == "rate":
            if value.value == 0.0:
                dynamics.approximate(
                    "a change at a rate of 0 never changes anything; there is none"
                )
                self._speeds[actor.said] = before
                return None
            if value.value < 0.0:
                dynamics.approximate("a rate has no sign; its size counts")
                value = Quantity(literal(-value.value, ACCELERATION), -value.value)
            length = None
            if before is not None:
                length = abs(target.value - before.value) / value.value * _peak(shape)
            is_cubic = shape == "cubic"
            arguments["rate_peak"] = smooth_peak(value, ACCELERATION) if is_cubic else value.text
            return Statement(call(actor.name, "change_speed", **arguments), length=length)
        if before is not None and before.value + target.value > 0.0:
            time = Quantity(
                f"2 * {value.within(PRODUCT)} / ({before.text} + {target.text})",
                2.0 * value.value / (before.value + target.value),
            )
            arguments["duration"] = time.text
            return Statement(call(actor.name, "change_speed", **arguments), length=time.value)
        dynamics.approximate("the distance of the change is that of the usual acceleration")
        return Statement(call(actor.name, "change_speed", target=target.text))

    def _limit_within(
        self,
        actor: Actor,
        before: Quantity | None,
        target: Quantity,
        shape: str,
        value: float,
        dimension: str,
    ) -> float | None:
        """Return the acceleration (m/s^2) that a vehicle has at most, if a change asks for more."""
        body = self._body(actor)
        if body is None or before is None or dimension == "distance":
            return None
        change = target.value - before.value
        limit = body.limits.get("maxAcceleration" if change > 0.0 else "maxDeceleration", math.inf)
        asked = value if dimension == "rate" else _peak(shape) * abs(change) / value
        return limit if change and asked > limit + 1e-9 else None

    def _target(self, node: Node, at_start: bool) -> Quantity:
        if node.tag == "AbsoluteTargetSpeed":
            for each in node.children():
                each.leave_out("a steady state has no counterpart in the DSL")
            return self._values.quantity(node, "value", SPEED)
        reference = self._actor(node)
        now = self._speeds.get(reference.said)
        known = now if at_start else None
        nominal = now.value if now is not None else 0.0
        base = f"{reference.name}.speed"
        if (node.text("speedTargetValueType") or "delta") == "factor":
            factor = self._values.quantity(node, "value", NUMBER)
            base = known.within(PRODUCT) if known is not None else base
            return Quantity(
                f"{factor.within(PRODUCT)} * {base}", factor.value * nominal, True, PRODUCT
            )
        delta = self._values.quantity(node, "value", SPEED)
        found = known if known is not None else Quantity(base, nominal, True)
        return total(SPEED, (1, found), (1, delta))

    def _as_fast_as(self, node: Node, target: Node, dynamics: Node, actor: Actor) -> Statement:
        """Return a speed that is kept against that of another actor."""
        reference = self._actor(target).name
        if dynamics.text("dynamicsShape") != "step":
            node.approximate("how fast a relative speed is reached is up to the simulator")
        self._values.quantity(dynamics, "value", of_dynamics(dynamics))
        dynamics.text("dynamicsDimension")
        if (target.text("speedTargetValueType") or "delta") == "factor":
            factor = self._values.quantity(target, "value", NUMBER)
            modifier = f"speed(0mps, faster_than: {reference}, factor: {factor.text})"
        else:
            delta = self._values.quantity(target, "value", SPEED)
            modifier = f"speed({delta.text}, faster_than: {reference})"
            if not delta.is_open and delta.value == 0.0:
                modifier = f"speed(same_as: {reference})"
        return Statement(actor.moves, modifiers=[modifier], length=math.inf)

    def _gap(self, node: Node, actor: Actor, at_start: bool) -> Statement | None:
        said = self._values.text(node, "entityRef")
        reference = self._actors.get(said)
        if reference is None or actor.kind != "vehicle":
            node.leave_out("only vehicles keep gaps to actors")
            return None
        continuous = node.is_true("continuous")
        if node.find("DynamicConstraints") is None and not continuous:
            at_once = self._at_once(node, actor, reference, at_start)
            if at_once is not None:
                return at_once
        node.approximate("how a gap is closed is up to the simulator")
        side = node.text("displacement") or "trailingReferencedEntity"
        direction = "ahead" if side.startswith("leading") else "behind"
        for name in ("freespace", "coordinateSystem"):
            node.text(name)
        for each in node.children("DynamicConstraints"):
            each.use_all()
        in_time = ("time", "timeGap", TIME)
        kind, name, dimension = in_time if node.has("timeGap") else ("space", "distance", LENGTH)
        target = self._values.quantity(node, name, dimension)
        arguments = {"target": target.text, "direction": direction, "reference": reference.name}
        change = Statement(call(actor.name, f"change_{kind}_gap", **arguments))
        if not continuous:
            return change
        arguments = {"reference": reference.name, "direction": "longitudinal"}
        keep = call(actor.name, f"keep_{kind}_gap", **arguments)
        return composed("serial", [change, Statement(keep, length=math.inf)])

    def _at_once(
        self, node: Node, actor: Actor, reference: Actor, at_start: bool
    ) -> Statement | None:
        """Return a place at a gap, which nothing keeps the actor from having at once.

        `None`: both are in different lanes, or somewhere else by now.
        """
        own, other = self._body(actor), self._body(reference)
        if own is None or other is None or own.place is None or other.place is None:
            return None
        if own.place[:2] != other.place[:2] or own.along != other.along:
            return None
        ahead = is_ahead(own, other)
        side = node.text("displacement")
        if side is not None:
            ahead = side.startswith("leading")
        space = 0.0
        if node.is_true("freespace"):
            space = own.rear + other.front if ahead else own.front + other.rear
        node.text("coordinateSystem")
        if node.has("timeGap"):
            time = self._values.quantity(node, "timeGap", TIME)
            moving = reference if ahead else actor
            known = self._speeds.get(moving.said) if at_start else None
            speed = known.within(PRODUCT) if known else f"{moving.name}.speed"
            gap = Quantity(f"{time.within(PRODUCT)} * {speed}", 0.0, True, PRODUCT)
        else:
            gap = self._values.quantity(node, "distance", LENGTH)
        way = total(LENGTH, (1, gap), (1, Quantity(literal(space, LENGTH), space)))
        side = "ahead_of" if ahead else "behind"
        modifiers = [
            lane_beside(reference.name, 0),
            f"position({way.text}, {side}: {reference.name})",
        ]
        is_aside, beside = abs(own.place.offset) > 1e-9, self._places.beside
        if at_start and (is_aside or beside.varies_aside(actor.said)):
            spot = beside.at_gap(node, actor.said, reference.said, way, ahead=ahead)
            if spot is not None:
                return Statement(spot.assigned_to(actor.name), length=0.0)
        if is_aside:
            node.approximate("it is in the middle of its lane after it was put there")
        return Statement(call(actor.name, "assign_position"), modifiers=modifiers, length=0.0)


def _peak(shape: str) -> float:
    return PEAK_RATES.get(shape, 1.0)
