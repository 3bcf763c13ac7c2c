"""Actions as invocations."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence

from osc2tx.importing.cast import Actor
from osc2tx.importing.cursor import Node
from osc2tx.importing.places import Places, Spot
from osc2tx.importing.program import Statement, composed
from osc2tx.importing.values import (
    ACCELERATION,
    ANGLE,
    LENGTH,
    NUMBER,
    PRODUCT,
    SPEED,
    SUM,
    TIME,
    Dimension,
    Quantity,
    Values,
    literal,
)
from osc2tx.xosc.element import Unresolved
from osc2tx_shared.classes import dataclass

LONGITUDINAL, LATERAL = "longitudinal", "lateral"
BOTH = frozenset((LONGITUDINAL, LATERAL))
PROFILES = {"linear": "constant", "sinusoidal": "smooth", "cubic": "smooth"}
SHIFT_FACTORS = {"sinusoidal": 0.5 * math.pi**2, "linear": 0.5 * math.pi**2, "cubic": 6.0}
COMFORT = {"maxAcceleration": 2.0, "maxDeceleration": 4.0, "maxAccelerationRate": 10.0}
"""Limits of a change of the speed without a profile, in the embedded world."""


@dataclass(frozen=True, slots=True)
class Effect:
    """What an action does to an actor.

    Attributes:
        statement: The invocation.
        actor: The actor; `""`: none.
        slots: What of its motion the action controls.
    """

    statement: Statement
    actor: str = ""
    slots: frozenset[str] = frozenset()


class Actions:
    """Reads the actions of a document.

    Attributes:
        needs_environment: Whether the scenario needs an environment.
    """

    def __init__(
        self,
        values: Values,
        places: Places,
        actors: Mapping[str, Actor],
        name_of_mark: Callable[[str, str], str],
        emitted: set[str],
    ) -> None:
        self._values, self._places, self._actors = values, places, actors
        self._name_of_mark, self._emitted = name_of_mark, emitted
        self._lanes: dict[str, int | None] = {}
        self._speeds: dict[str, Quantity | None] = {}
        self.needs_environment = False

    # --- dispatch ---------------------------------------------------------------------------------

    def effects(self, action: Node, said: Sequence[str], *, at_start: bool = False) -> list[Effect]:
        """Return what an action does; with a finding what of it the language cannot say.

        Args:
            action: `PrivateAction` or `GlobalAction`.
            said: The entities that carry out a private action.
            at_start: Whether it belongs to `Init`.
        """
        found: list[Effect] = []
        try:
            if action.tag == "GlobalAction":
                found += self._global(action.inner)
            elif action.tag == "PrivateAction":
                if not said:
                    action.leave_out("no actor carries it out")
                for name in said:
                    actor = self._actors.get(name)
                    if actor is None:
                        raise Unresolved(f"there is no entity {name}", action.place)
                    found += self._private(action.inner, name, actor, at_start)
            else:
                action.leave_out("actions of a user are for one tool")
        except Unresolved as error:
            action.leave_out(error.reason)
        return found

    def _private(self, node: Node, said: str, actor: Actor, at_start: bool) -> Iterator[Effect]:
        match node.tag:
            case "LongitudinalAction":
                yield from self._longitudinal(node.inner, said, actor, at_start)
            case "LateralAction":
                yield from self._lateral(node.inner, said, actor)
            case "TeleportAction":
                yield from self._teleport(node, said, actor)
            case "RoutingAction":
                yield from self._routing(node.inner, said, actor)
            case "ControllerAction" | "ActivateControllerAction":
                actor.is_under_test = True
                node.use_all()
            case "SynchronizeAction":
                yield from self._synchronize(node, actor)
            case _:
                node.leave_out("the language has no such action")

    # --- along the road ---------------------------------------------------------------------------

    def _longitudinal(
        self, node: Node, said: str, actor: Actor, at_start: bool
    ) -> Iterator[Effect]:
        slots = frozenset((LONGITUDINAL,))
        match node.tag:
            case "SpeedAction":
                statement = self._speed(node, said, actor, at_start)
            case "SpeedProfileAction":
                statement = self._profile(node, said, actor)
            case "LongitudinalDistanceAction":
                statement = self._gap(node, actor)
            case _:
                node.leave_out("the language has no such action")
                return
        if statement is not None:
            yield Effect(statement, actor.name, slots)

    def _speed(self, node: Node, said: str, actor: Actor, at_start: bool) -> Statement | None:
        target_node = node.one("SpeedActionTarget").inner
        dynamics = node.one("SpeedActionDynamics")
        target = self._target(target_node, at_start)
        shape = dynamics.text("dynamicsShape") or "step"
        dynamics.text("followingMode")
        if (target_node.text("continuous") or "false").lower() in ("true", "1"):
            return self._as_fast_as(node, target_node, dynamics, actor)
        standing = Quantity(literal(0.0, SPEED), 0.0) if at_start else None
        before = self._speeds.get(said, standing)
        self._speeds[said] = target
        value = self._values.quantity(dynamics, "value", _of_dynamics(dynamics))
        dimension = dynamics.text("dynamicsDimension") or "time"
        if shape == "step" or (dimension in ("time", "distance") and value.value == 0.0):
            dynamics.idle("the speed is there at once")
            return Statement(f"{actor.name}.assign_speed({target.text})", length=0.0)
        if shape == "cubic":
            dynamics.approximate("a cubic course of the speed is smooth here")
        arguments = f"target: {target.text}, rate_profile: {PROFILES.get(shape, 'constant')}"
        call = f"{actor.name}.change_speed"
        if dimension == "time":
            return Statement(f"{call}({arguments}, duration: {value.text})", length=value.value)
        if dimension == "rate":
            if value.value == 0.0:
                dynamics.approximate(
                    "a change at a rate of 0 never changes anything; there is none"
                )
                self._speeds[said] = before
                return None
            if value.value < 0.0:
                dynamics.approximate("a rate has no sign; its size counts")
                value = Quantity(literal(-value.value, ACCELERATION), -value.value)
            length = None
            if before is not None:
                length = abs(target.value - before.value) / value.value * _peak(shape)
            return Statement(f"{call}({arguments}, rate_peak: {value.text})", length=length)
        if before is not None and before.value + target.value > 0.0:
            time = Quantity(
                f"2 * {value.within(PRODUCT)} / ({before.text} + {target.text})",
                2.0 * value.value / (before.value + target.value),
            )
            return Statement(f"{call}({arguments}, duration: {time.text})", length=time.value)
        dynamics.approximate("the way of the change is that of its usual rate")
        return Statement(f"{call}(target: {target.text})")

    def _target(self, node: Node, at_start: bool) -> Quantity:
        if node.tag == "AbsoluteTargetSpeed":
            for each in node.children():
                each.leave_out("a steady state has no counterpart in the DSL")
            return self._values.quantity(node, "value", SPEED)
        reference_said = self._values.text(node, "entityRef")
        reference = self._actors.get(reference_said)
        if reference is None:
            raise Unresolved(f"there is no entity {reference_said}", node.place)
        known = self._speeds.get(reference_said) if at_start else None
        now = self._speeds.get(reference_said)
        nominal = now.value if now is not None else 0.0
        base = known.within(SUM) if known is not None else f"{reference.name}.speed"
        if (node.text("speedTargetValueType") or "delta") == "factor":
            factor = self._values.quantity(node, "value", NUMBER)
            base = known.within(PRODUCT) if known is not None else base
            return Quantity(
                f"{factor.within(PRODUCT)} * {base}", factor.value * nominal, True, PRODUCT
            )
        delta = self._values.quantity(node, "value", SPEED)
        if not delta.is_open and delta.value == 0.0:
            return Quantity(base, nominal, True, SUM)
        if not delta.is_open and delta.value < 0.0:
            return Quantity(
                f"{base} - {literal(-delta.value, SPEED)}", nominal + delta.value, True, SUM
            )
        return Quantity(f"{base} + {delta.within(SUM)}", nominal + delta.value, True, SUM)

    def _as_fast_as(self, node: Node, target: Node, dynamics: Node, actor: Actor) -> Statement:
        """Return a speed that is kept against that of another actor."""
        reference = self._actors[self._values.text(target, "entityRef")].name
        if dynamics.text("dynamicsShape") != "step":
            node.approximate("how fast a relative speed is reached is a matter of the world")
        self._values.quantity(dynamics, "value", _of_dynamics(dynamics))
        dynamics.text("dynamicsDimension")
        if (target.text("speedTargetValueType") or "delta") == "factor":
            factor = self._values.quantity(target, "value", NUMBER)
            modifier = f"speed(0mps, faster_than: {reference}, factor: {factor.text})"
        else:
            delta = self._values.quantity(target, "value", SPEED)
            modifier = f"speed({delta.text}, faster_than: {reference})"
            if not delta.is_open and delta.value == 0.0:
                modifier = f"speed(same_as: {reference})"
        return Statement(f"{actor.verb}()", modifiers=[modifier], length=math.inf)

    def _profile(self, node: Node, said: str, actor: Actor) -> Statement | None:
        mode = node.text("followingMode") or "position"
        if node.has("entityRef"):
            node.leave_out(
                "a speed profile relative to another actor has no counterpart in the DSL"
            )
            return None
        limits = node.find("DynamicConstraints")
        changes = []
        for entry in node.children("SpeedProfileEntry"):
            speed = self._values.quantity(entry, "speed", SPEED)
            time = self._values.quantity(entry, "time", TIME)
            if not entry.has("time"):
                changes.append(Statement(f"{actor.name}.change_speed(target: {speed.text})"))
                told = (
                    {}
                    if limits is None
                    else {name: self._values.nominal(limits, name, math.inf) for name in COMFORT}
                )
                if told != COMFORT:
                    entry.approximate("the speed changes with the usual accelerations of the world")
            elif time.value == 0.0:
                changes.append(Statement(f"{actor.name}.assign_speed({speed.text})", length=0.0))
            else:
                arguments = f"target: {speed.text}, rate_profile: constant, duration: {time.text}"
                call = f"{actor.name}.change_speed({arguments})"
                changes.append(Statement(call, length=time.value))
            self._speeds[said] = speed
        if limits is not None:
            limits.use_all()
        del mode
        return composed("serial", changes) if changes else None

    def _gap(self, node: Node, actor: Actor) -> Statement | None:
        said = self._values.text(node, "entityRef")
        reference = self._actors.get(said)
        if reference is None or actor.kind != "vehicle":
            node.leave_out("only vehicles keep gaps to actors")
            return None
        node.approximate("how a gap is closed is a matter of the world")
        side = node.text("displacement") or "trailingReferencedEntity"
        direction = "ahead" if side.startswith("leading") else "behind"
        for name in ("freespace", "coordinateSystem"):
            node.text(name)
        for each in node.children("DynamicConstraints"):
            each.use_all()
        continuous = (node.text("continuous") or "false").lower() in ("true", "1")
        if node.has("timeGap"):
            target = self._values.quantity(node, "timeGap", TIME)
            kind = "time"
        else:
            target = self._values.quantity(node, "distance", LENGTH)
            kind = "space"
        arguments = f"target: {target.text}, direction: {direction}, reference: {reference.name}"
        change = Statement(f"{actor.name}.change_{kind}_gap({arguments})")
        if not continuous:
            return change
        keep = Statement(
            f"{actor.name}.keep_{kind}_gap(reference: {reference.name}, direction: longitudinal)",
            length=math.inf,
        )
        return composed("serial", [change, keep])

    # --- across it --------------------------------------------------------------------------------

    def _lateral(self, node: Node, said: str, actor: Actor) -> Iterator[Effect]:
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
        target = node.one("LaneChangeTarget").inner
        lanes, reference = self._lanes_to(target, said)
        if lanes is None:
            target.leave_out("which lane the actor is in is not known before the run")
            node.use_all()
            return None
        arguments = []
        if lanes == 0 and not reference:
            node.use_all()  # it is in that lane
            return None
        if lanes == 0:
            arguments.append("side: same")
        else:
            if abs(lanes) > 1:
                arguments.append(f"num_of_lanes: {abs(lanes)}")
            arguments.append(f"side: {'left' if lanes > 0 else 'right'}")
        if reference:
            arguments.append(f"reference: {reference}")
        offset = self._values.quantity(node, "targetLaneOffset", LENGTH)
        if offset.is_open or abs(offset.value) > 1e-9:
            sign = self._along(said)
            text = offset.text if sign > 0 else f"-{offset.within(PRODUCT)}"
            arguments.append(f"offset: {text}")
        dynamics = node.one("LaneChangeActionDynamics")
        shape = dynamics.text("dynamicsShape") or "sinusoidal"
        dynamics.text("followingMode")
        dimension = dynamics.text("dynamicsDimension") or "time"
        value = self._values.quantity(dynamics, "value", _of_dynamics(dynamics))
        length: float | None = None
        if shape == "step" or value.value <= 0.0:
            dynamics.approximate("a jump to another lane is a quick change here")
            arguments += ["rate_profile: constant", "duration: 0.1s"]
            return Statement(f"{actor.name}.change_lane({', '.join(arguments)})", length=0.1)
        if shape == "cubic":
            dynamics.approximate("a cubic course across the road is smooth here")
        if shape == "linear":
            arguments.append("rate_profile: constant")
        if dimension == "time":
            arguments.append(f"duration: {value.text}")
            length = value.value
        elif dimension == "rate":
            if shape != "linear":
                arguments.append("rate_profile: smooth")
                peak = 0.5 * math.pi * value.value
                text = (
                    f"{_number(0.5 * math.pi)} * {value.within(PRODUCT)}"
                    if value.is_open
                    else literal(round(peak, 9), SPEED)
                )
            else:
                text = value.text
            arguments.append(f"rate_peak: {text}")
        else:
            now = self._speeds.get(said)
            if now is None or now.value <= 0.0:
                dynamics.approximate("the way of the change is that of its usual time")
            else:
                dynamics.approximate("the way of the change is that at the speed last commanded")
                length = value.value / now.value
                arguments.append(f"duration: {literal(round(length, 6), TIME)}")
        return Statement(f"{actor.name}.change_lane({', '.join(arguments)})", length=length)

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
        sign = (1 if goal > here else -1) * road_map.travel_direction(body.place.road, here)
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
        if target.tag != "AbsoluteTargetLaneOffset":
            target.leave_out("an offset from that of another actor has no counterpart in the DSL")
            return None
        offset = self._values.quantity(target, "value", LENGTH)
        text = offset.text if self._along(said) > 0 else f"-{offset.within(PRODUCT)}"
        dynamics = node.one("LaneOffsetActionDynamics")
        shape = dynamics.text("dynamicsShape") or "step"
        peak = self._values.nominal(dynamics, "maxLateralAcc", math.inf)
        continuous = (node.text("continuous") or "false").lower() in ("true", "1")
        body = self._places.bodies.get(said)
        before = 0.0 if body is None or body.place is None else body.place.offset
        change = abs(offset.value * self._along(said) - before)
        time = math.sqrt(SHIFT_FACTORS.get(shape, 0.0) * change / peak) if peak > 0.0 else 0.0
        if time <= 0.0 or shape == "step":
            node.approximate(
                "how fast an offset without limits is reached is a matter of the world"
            )
            time = 1.0
        profile = PROFILES.get(shape, "smooth")
        lasting = literal(round(time, 6), TIME)
        call = f"follow_lane(offset: {text}, rate_profile: {profile}, duration: {lasting})"
        if continuous:
            node.approximate("an offset that is kept ends here when it is reached")
        return Statement(f"{actor.name}.{call}", length=time)

    # --- elsewhere --------------------------------------------------------------------------------

    def _teleport(self, node: Node, said: str, actor: Actor) -> Iterator[Effect]:
        spot = self._places.spot(node.one("Position"), actor.name, at_start=False)
        self._lanes[said] = None
        if spot is not None:
            if spot.yaw:
                node.approximate("it looks along its lane")
            yield from self.moved(spot, actor)

    @staticmethod
    def moved(spot: Spot, actor: Actor) -> Iterator[Effect]:
        """Return what puts an actor at a place at once."""
        call = f"{actor.name}.assign_position({spot.argument})"
        statement = Statement(call, modifiers=list(spot.modifiers), length=0.0)
        yield Effect(statement, actor.name, BOTH)

    def _routing(self, node: Node, said: str, actor: Actor) -> Iterator[Effect]:
        if node.tag == "AssignRouteAction":
            node.leave_out("routes are not imported yet: the actor goes on along its road")
            return
        if node.tag == "AcquirePositionAction":
            spot = self._places.spot(node.one("Position"), actor.name, at_start=False)
            if spot is None or not spot.argument.startswith("odr_point"):
                return
            node.approximate("the way to the place is that of the world")
            target = spot.argument.replace("odr_point:", "target_odr:", 1)
            yield Effect(
                Statement(f"{actor.name}.change_position({target}, on_road_network: true)"),
                actor.name,
                BOTH,
            )
            return
        if node.tag == "FollowTrajectoryAction":
            yield from self._trajectory(node, said, actor)
            return
        node.leave_out("the language has no such action")

    def _trajectory(self, node: Node, said: str, actor: Actor) -> Iterator[Effect]:
        lines = [each for each in node.element.walk() if each.tag == "Polyline"]
        if not lines:
            node.leave_out("of trajectories only polylines are imported yet")
            return
        points, times = [], []
        for holder in node.children("TrajectoryRef", "Trajectory"):
            trajectory = holder if holder.tag == "Trajectory" else holder.find("Trajectory")
            if trajectory is None:
                continue
            for shape in trajectory.children("Shape"):
                for vertex in (
                    each for line in shape.children("Polyline") for each in line.children("Vertex")
                ):
                    found = self._places.coordinates(vertex.one("Position"))
                    if found is None:
                        node.leave_out("a corner of the trajectory is not known before the run")
                        return
                    vertex.use_all()
                    if any(
                        text.startswith("$")
                        for each in vertex.element.walk()
                        for _, text in each.attributes
                    ):
                        vertex.approximate("the corner keeps the place of its nominal values")
                    times.append(self._values.nominal(vertex, "time"))
                    points.append(self._places.pose(*found, actor.name))
        timed = any(each.tag == "Timing" for each in node.element.walk())
        for name in ("initialDistanceOffset",):
            if abs(self._values.nominal(node, name)) > 1e-9:
                node.approximate(f"{name} has no counterpart in the DSL")
        node.use_all()
        listed = ", ".join(points)
        told = f"points: [{listed}], interpolation: straight_line"
        length = None
        if timed:
            stamps = ", ".join(literal(round(each, 6), TIME) for each in times)
            made = f"trajectory(absolute: road.create_trajectory({told}, time_stamps: [{stamps}]))"
            length = times[-1] if times else None
        else:
            made = f"path(absolute: road.create_path({told}))"
        yield Effect(Statement(f"{actor.name}.replay_{made}", length=length), actor.name, BOTH)
        self._lanes[said] = None

    def _synchronize(self, node: Node, actor: Actor) -> Iterator[Effect]:
        final = node.find("FinalSpeed")
        speed = None if final is None else next(final.children("AbsoluteSpeed"), None)
        node.approximate(
            "the time at which both reach their positions has no counterpart in the DSL; the actor"
            " takes its final speed"
        )
        if speed is not None:
            target = self._values.quantity(speed, "value", SPEED)
            node.use_all()
            yield Effect(
                Statement(f"{actor.name}.change_speed(target: {target.text})"),
                actor.name,
                frozenset((LONGITUDINAL,)),
            )
        else:
            node.leave_out("the actor goes on as it does")

    # --- without an actor -------------------------------------------------------------------------

    def _global(self, node: Node) -> Iterator[Effect]:
        match node.tag:
            case "VariableAction":
                name = self._values.text(node, "variableRef")
                setting = node.find("SetAction")
                if setting is None:
                    node.leave_out("variables are events here: they are set, not computed")
                    return
                value = self._values.text(setting, "value")
                event = self._name_of_mark(name, value)
                self._emitted.add(event)
                yield Effect(Statement(f"emit {event}", length=0.0))
            case "EnvironmentAction":
                yield from self._environment(node)
            case _:
                node.leave_out("the language has no such action, or not for this document")

    def _environment(self, node: Node) -> Iterator[Effect]:
        environment = node.find("Environment")
        if environment is None:
            node.leave_out("environments of catalogs are not imported yet")
            return
        for each in environment.children():
            if each.tag == "Weather":
                yield from self._weather(each)
            elif each.tag not in ("ParameterDeclarations",):
                each.leave_out("of the environment only the weather is imported")

    def _weather(self, node: Node) -> Iterator[Effect]:
        for name in ("cloudState", "fractionalCloudCover"):
            if node.has(name):
                node.approximate(f"{name}={node.text(name)!r} has no counterpart in the DSL")
        for each in node.children():
            call = None
            if each.tag == "Fog" and each.has("visualRange"):
                value = self._values.quantity(each, "visualRange", LENGTH)
                call = f"fog(visual_range: {value.text})"
            elif each.tag == "Sun" and each.has("azimuth"):
                azimuth = self._values.quantity(each, "azimuth", ANGLE)
                elevation = self._values.quantity(each, "elevation", ANGLE)
                call = (
                    f"assign_celestial_position(light_source: environment_.sun, "
                    f"azimuth: {azimuth.text}, elevation: {elevation.text})"
                )
            for unsaid in each.element.attributes:
                if unsaid[0] not in ("visualRange", "azimuth", "elevation"):
                    each.text(unsaid[0])
                    each.approximate(f"{unsaid[0]}={unsaid[1]!r} has no counterpart in the DSL")
            if call is not None:
                self.needs_environment = True
                yield Effect(Statement(f"environment_.{call}", length=0.0))


def _of_dynamics(node: Node) -> Dimension:
    dimension = node.text("dynamicsDimension") or "time"
    rate = ACCELERATION if node.tag == "SpeedActionDynamics" else SPEED
    return {"time": TIME, "distance": LENGTH, "rate": rate}.get(dimension, TIME)


def _peak(shape: str) -> float:
    return {"sinusoidal": 0.5 * math.pi, "cubic": 1.5}.get(shape, 1.0)


def _number(value: float) -> str:
    return f"{value:.9f}".rstrip("0")
