"""A small player of OpenSCENARIO XML, for tests: independent of the compiler and of its runtime.

It carries out what the back end writes, by the text of the standard: states of storyboard elements,
triggers as OR of ANDs with edges and delays, actions as motion of points along straight roads. A
step at time t looks at the state of t; what starts then acts from t on. Elements see what those
before them in the document did in the same step, and completions one step later.
"""

import math
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import pairwise

from lxml import etree

Node = etree._Element
RULES: dict[str, Callable[[float, float], bool]] = {
    "greaterThan": lambda a, b: a > b,
    "lessThan": lambda a, b: a < b,
    "greaterOrEqual": lambda a, b: a >= b - 1e-9,
    "lessOrEqual": lambda a, b: a <= b + 1e-9,
    "equalTo": lambda a, b: a == b,
    "notEqualTo": lambda a, b: a != b,
}
Course = Callable[[float], float]  # seconds since its start -> value
LANES = {-1: -1.75, -2: -5.25, -3: -8.75, -4: -12.25}  # of highway.xodr: left edge at t = 0


def number(node: Node, name: str, default: float = 0.0) -> float:
    text = node.get(name)
    return default if text is None else value_of(text, node.getroottree().getroot())


def value_of(text: str, root: Node) -> float:
    """Return the value of an attribute: a number, `$name` or `${arithmetic}`."""
    if not text.startswith("$"):
        return float(text)
    declared = {node.get("name"): node.get("value") for node in root.iter("ParameterDeclaration")}
    plain = re.sub(r"\$(\w+)", lambda found: f"({declared[found[1]]})", text.strip("${}"))
    if not text.startswith("${"):
        return float(declared[text[1:]])
    assert re.fullmatch(r"[-+*/(). 0-9e]+", plain), text
    return float(eval(plain))


def shaped(shape: str, start: float, end: float, time: float) -> Course:
    """Return the course of a transition."""

    def course(t: float) -> float:
        if t >= time - 1e-9:
            return end
        part = t / time
        if shape == "sinusoidal":
            part = (1.0 - math.cos(math.pi * part)) / 2.0
        elif shape == "cubic":
            part = part * part * (3.0 - 2.0 * part)
        return start + (end - start) * part

    return course


def with_jerk(start: float, end: float, limit: float, jerk: float) -> tuple[Course, float]:
    """Return the fastest course within limits of acceleration and jerk, and its length."""
    change = abs(end - start)
    ramp = min(limit / jerk, math.sqrt(change / jerk))
    peak = jerk * ramp
    flat = change / peak - ramp if peak else 0.0
    total = 2.0 * ramp + flat
    sign = math.copysign(1.0, end - start)

    def course(t: float) -> float:
        if t >= total - 1e-9:
            return end
        rising = min(t, ramp)
        gained = 0.5 * jerk * rising * rising
        gained += peak * min(max(t - ramp, 0.0), flat)
        falling = max(t - ramp - flat, 0.0)
        gained += peak * falling - 0.5 * jerk * falling * falling
        return start + sign * gained

    return course, total


@dataclass
class Entity:
    """A moving object: x along the road, y to its left."""

    name: str
    front: float
    rear: float
    max_speed: float
    x: float = 0.0
    y: float = 0.0
    v: float = 0.0
    lane: int | None = None
    actions: dict[str, "Running"] = field(default_factory=dict)


@dataclass
class Running:
    """An action at work."""

    entity: Entity
    begun: float
    course: Course | None
    length: float | None  # None: never
    follow: Node | None = None
    done: bool = False
    path: list[tuple[float, float, float]] = field(default_factory=list)


class Player:
    """Plays a document; `starts` and `ends` hold the times of its events, `track` the motion."""

    def __init__(self, xml: str, dt: float = 0.05, *, is_lazy: bool = False) -> None:
        self.is_lazy = is_lazy
        self.root = etree.fromstring(xml.encode())
        self.dt = dt
        self.time = 0.0
        self.entities = {
            node.get("name"): self._entity(node) for node in self.root.iter("ScenarioObject")
        }
        self.variables = {
            node.get("name"): node.get("value")
            for tag in ("VariableDeclaration", "ParameterDeclaration")
            for node in self.root.iter(tag)
        }
        self.state: dict[Node, str] = {}
        self.completed: set[Node] = set()  # known from the next step on
        self.visible: set[Node] = set()
        self.history: dict[Node, list[tuple[float, bool]]] = {}
        self.last: dict[Node, bool] = {}
        self.work: dict[Node, list[Running]] = {}
        self.starts: dict[str, float] = {}
        self.ends: dict[str, float] = {}
        self.track: dict[str, list[tuple[float, float, float, float]]] = {}
        for private in self.root.iterfind("Storyboard/Init/Actions/Private"):
            for action in private:
                self._start(action, self.entities[private.get("entityRef")])
        for entity in self.entities.values():
            entity.actions.clear()

    def play(self, most: float = 120.0) -> float:
        """Play to the end; return when that is."""
        steps = 0
        while self.time < most:
            for entity in self.entities.values():
                row = (self.time, entity.x, entity.y, entity.v)
                self.track.setdefault(entity.name, []).append(row)
            if self._fires(self.root.find("Storyboard/StopTrigger")):
                return self.time
            for act in self.root.iter("Act"):
                self._step_act(act)
            self._advance()
            self.visible = set(self.completed)
            steps += 1
            self.time = round(steps * self.dt, 9)
        return math.inf

    # --- storyboard -------------------------------------------------------------------------------

    def _step_act(self, act: Node) -> None:
        state = self.state.setdefault(act, "standby")
        if state == "complete":
            return
        if state == "standby":
            if not self._fires(act.find("StartTrigger")):
                return
            self.state[act] = "running"
        stop = act.find("StopTrigger")
        if stop is not None and self._fires(stop):
            for event in act.iter("Event"):
                self._complete(event)
            self.state[act] = "complete"
            self.completed.add(act)
            return
        for event in act.iter("Event"):
            self._step_event(event)
        if all(self.state.get(event) == "complete" for event in act.iter("Event")):
            self.state[act] = "complete"
            self.completed.add(act)

    def _step_event(self, event: Node) -> None:
        state = self.state.setdefault(event, "standby")
        if state == "running" and all(run.done for run in self.work[event]):
            again = event.get("maximumExecutionCount", "1") != "1"
            self.state[event] = state = "standby" if again else "complete"
            if not again:
                self._complete(event)
        if state == "standby" and self._fires(event.find("StartTrigger")):
            self.state[event] = "running"
            self.starts.setdefault(event.get("name"), self.time)
            group = event.getparent().getparent()
            actor = group.find("Actors/EntityRef")
            entity = None if actor is None else self.entities[actor.get("entityRef")]
            runs = [self._start(action[0], entity) for action in event.iterfind("Action")]
            self.work[event] = [run for run in runs if run is not None]

    def _complete(self, event: Node) -> None:
        for run in self.work.get(event, ()):
            run.done = True
        if event in self.work:
            self.ends.setdefault(event.get("name"), self.time)
        self.state[event] = "complete"
        self.completed.add(event)

    def _fires(self, trigger: Node | None) -> bool:
        groups = () if trigger is None else trigger.iterfind("ConditionGroup")
        return any([self._all_hold(list(group)) for group in groups])  # each is looked at

    def _all_hold(self, conditions: list[Node]) -> bool:
        """Whether all hold; a lazy tool looks at none behind a false one, but at delayed ones."""
        result = True
        for condition in conditions:
            if result or not self.is_lazy or number(condition, "delay") > 0.0:
                held = self._holds(condition)
                result = result and held
        return result

    def _holds(self, condition: Node) -> bool:
        value = self._test(
            condition[0][0] if condition[0].tag == "ByValueCondition" else condition[0]
        )
        edge, before = condition.get("conditionEdge"), self.last.get(condition)
        self.last[condition] = value
        if edge == "rising":
            value = value and before is False
        elif edge == "falling":
            value = not value and before is True
        history = self.history.setdefault(condition, [])
        history.append((self.time, value))
        delay = number(condition, "delay")
        past = [held for at, held in history if at <= self.time - delay + 1e-9]
        return bool(past) and past[-1]

    def _test(self, node: Node) -> bool:
        match node.tag:
            case "SimulationTimeCondition":
                return RULES[node.get("rule")](self.time, number(node, "value"))
            case "VariableCondition" | "ParameterCondition":
                name = node.get("variableRef") or node.get("parameterRef")
                return (self.variables[name] == node.get("value")) is (
                    node.get("rule") == "equalTo"
                )
            case "StoryboardElementStateCondition":
                kind = {"act": "Act", "event": "Event"}[node.get("storyboardElementType")]
                named = next(
                    each
                    for each in self.root.iter(kind)
                    if each.get("name") == node.get("storyboardElementRef")
                )
                if node.get("state") == "completeState":
                    return named in self.visible
                return self.state.get(named) == "running"
            case "ByEntityCondition":
                entity = self.entities[node.find("TriggeringEntities/EntityRef").get("entityRef")]
                return self._test_entity(entity, node.find("EntityCondition")[0])
        raise NotImplementedError(node.tag)

    def _test_entity(self, entity: Entity, node: Node) -> bool:
        if node.tag == "SpeedCondition":
            return RULES[node.get("rule")](entity.v, number(node, "value"))
        if node.tag == "RelativeClearanceCondition":
            other = self.entities[node.find("EntityRef").get("entityRef")]
            apart = other.x - entity.x
            low, high = -number(node, "distanceBackward"), number(node, "distanceForward")
            return not low <= apart <= high
        if node.tag == "RelativeDistanceCondition":
            other = self.entities[node.get("entityRef")]
            return RULES[node.get("rule")](
                self._distance(entity, other, node), number(node, "value")
            )
        raise NotImplementedError(node.tag)

    def _distance(self, a: Entity, b: Entity, node: Node) -> float:
        if node.get("relativeDistanceType") in ("euclidianDistance", "cartesianDistance"):
            return math.hypot(b.x - a.x, b.y - a.y)
        if node.get("freespace") != "true":
            return abs(b.x - a.x)
        behind, ahead = (a, b) if a.x <= b.x else (b, a)
        return max(ahead.x - ahead.rear - behind.x - behind.front, 0.0)

    # --- actions ----------------------------------------------------------------------------------

    def _start(self, action: Node, entity: Entity | None) -> Running | None:
        inner = action[0] if action.tag in ("PrivateAction", "GlobalAction") else action
        if inner.tag in ("VariableAction", "ParameterAction"):
            name = inner.get("variableRef") or inner.get("parameterRef")
            self.variables[name] = inner.find("SetAction").get("value")
            return None
        assert entity is not None
        match inner.tag:
            case "TeleportAction":
                self._teleport(entity, inner.find("Position")[0])
                return None
            case "LongitudinalAction":
                return self._take(entity, "longitudinal", self._longitudinal(entity, inner[0]))
            case "LateralAction":
                return self._take(entity, "lateral", self._lateral(entity, inner[0]))
            case "RoutingAction":
                entity.actions.pop("longitudinal", None)
                return self._take(entity, "path", self._path(entity, inner[0]))
        raise NotImplementedError(inner.tag)

    def _take(self, entity: Entity, domain: str, run: Running) -> Running:
        replaced = entity.actions.get(domain)
        if replaced is not None:
            replaced.done = True
        entity.actions[domain] = run
        if run.length == 0.0:
            self._move(entity, domain, run, 0.0)
        return run

    def _longitudinal(self, entity: Entity, node: Node) -> Running:
        if node.tag == "LongitudinalDistanceAction":
            return Running(entity, self.time, None, None, follow=node)
        if node.tag == "SpeedProfileAction":
            return self._profile(entity, node)
        target = node.find("SpeedActionTarget/AbsoluteTargetSpeed")
        end = entity.v if target is None else number(target, "value")
        dynamics = node.find("SpeedActionDynamics")
        shape, time = dynamics.get("dynamicsShape"), number(dynamics, "value")
        if dynamics.get("dynamicsDimension") == "rate":
            time = {"linear": 1.0, "sinusoidal": math.pi / 2}[shape] * abs(end - entity.v) / time
        time = 0.0 if shape == "step" else time
        return Running(entity, self.time, shaped(shape, entity.v, end, time), time)

    def _profile(self, entity: Entity, node: Node) -> Running:
        entries = node.findall("SpeedProfileEntry")
        limits = node.find("DynamicConstraints")
        if limits is not None:
            end = number(entries[0], "speed")
            faster = end > entity.v
            limit = number(limits, "maxAcceleration" if faster else "maxDeceleration")
            course, time = with_jerk(entity.v, end, limit, number(limits, "maxAccelerationRate"))
            return Running(entity, self.time, course, time)
        points = [(0.0, entity.v)]
        for entry in entries:
            points.append((points[-1][0] + number(entry, "time"), number(entry, "speed")))
        return Running(entity, self.time, lambda t: between(points, t), points[-1][0])

    def _lateral(self, entity: Entity, node: Node) -> Running:
        assert entity.lane is not None
        if node.tag == "LaneOffsetAction":
            target = LANES[entity.lane] + number(node.find("LaneOffsetTarget")[0], "value")
            dynamics = node.find("LaneOffsetActionDynamics")
            peak = number(dynamics, "maxLateralAcc")
            time = math.pi * math.sqrt(0.5 * abs(target - entity.y) / peak)
        else:
            beside = node.find("LaneChangeTarget/RelativeTargetLane")
            own = nearest_lane(self.entities[beside.get("entityRef")].y)
            entity.lane = own + int(beside.get("value"))
            target = LANES[entity.lane] + number(node, "targetLaneOffset")
            dynamics = node.find("LaneChangeActionDynamics")
            time = number(dynamics, "value")
        course = shaped(dynamics.get("dynamicsShape"), entity.y, target, time)
        return Running(entity, self.time, course, time)

    def _path(self, entity: Entity, node: Node) -> Running:
        path = []
        for vertex in node.iter("Vertex"):
            place = vertex.find("Position/WorldPosition")
            path.append((number(vertex, "time"), number(place, "x"), number(place, "y")))
        return Running(entity, self.time, None, path[-1][0], path=path)

    def _teleport(self, entity: Entity, place: Node) -> None:
        match place.tag:
            case "LanePosition":
                entity.lane = int(place.get("laneId"))
                entity.x = number(place, "s")
                entity.y = LANES[entity.lane] + number(place, "offset")
            case "RelativeLanePosition":
                other = self.entities[place.get("entityRef")]
                assert other.lane is not None
                entity.lane = other.lane + int(place.get("dLane"))
                entity.x = other.x + number(place, "dsLane") + number(place, "ds")
                entity.y = LANES[entity.lane] + number(place, "offset")
            case "WorldPosition":
                entity.x, entity.y = number(place, "x"), number(place, "y")
            case _:
                raise NotImplementedError(place.tag)

    def _advance(self) -> None:
        for entity in self.entities.values():
            before = entity.v
            for domain in ("longitudinal", "path"):
                run = entity.actions.get(domain)
                if run is not None and not run.done:
                    self._move(entity, domain, run, self.time + self.dt - run.begun)
            if "path" in entity.actions:
                continue
            way, aside = 0.5 * (before + entity.v) * self.dt, entity.y
            run = entity.actions.get("lateral")
            if run is not None and not run.done:
                self._move(entity, "lateral", run, self.time + self.dt - run.begun)
            entity.x += math.sqrt(max(way * way - (entity.y - aside) ** 2, 0.0))

    def _move(self, entity: Entity, domain: str, run: Running, time: float) -> None:
        if run.follow is not None:
            self._keep_gap(entity, run.follow)
        elif run.path:
            xs = [(t, x) for t, x, _ in run.path]
            ys = [(t, y) for t, _, y in run.path]
            x, y = between(xs, time), between(ys, time)
            entity.v = math.hypot(x - entity.x, y - entity.y) / self.dt
            entity.x, entity.y = x, y
        elif domain == "longitudinal":
            entity.v = run.course(time) if run.course else entity.v
        else:
            entity.y = run.course(time) if run.course else entity.y
        run.done = run.length is not None and time >= run.length - 1e-9

    def _keep_gap(self, entity: Entity, node: Node) -> None:
        """Follow with the stiffest control that the limit allows."""
        leader = self.entities[node.get("entityRef")]
        gap = leader.x - leader.rear - entity.x - entity.front
        error, closing = gap - number(node, "distance"), leader.v - entity.v
        rate = 2.0 * error + 2.0 * math.sqrt(2.0) * closing
        limits = node.find("DynamicConstraints")
        low, high = -number(limits, "maxDeceleration"), number(limits, "maxAcceleration")
        entity.v += min(max(rate, low), high) * self.dt

    def _entity(self, node: Node) -> Entity:
        centre, size = node.find(".//Center"), node.find(".//Dimensions")
        half, x = number(size, "length") / 2, number(centre, "x")
        performance = node.find(".//Performance")
        top = math.inf if performance is None else number(performance, "maxSpeed")
        return Entity(node.get("name"), half + x, half - x, top)


def nearest_lane(y: float) -> int:
    """Return the lane in which a point is."""
    return min(LANES, key=lambda lane: abs(LANES[lane] - y))


def between(points: list[tuple[float, float]], at: float) -> float:
    """Interpolate linearly."""
    for (t0, v0), (t1, v1) in pairwise(points):
        if at <= t1:
            return v0 + (v1 - v0) * max(at - t0, 0.0) / (t1 - t0)
    return points[-1][1]
