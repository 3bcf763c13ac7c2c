"""Moving objects and the actions at work on them, for the player."""

import math
from dataclasses import dataclass, field

from tests.unit.backends.xosc.courses import Course, Node, between, number, shaped, with_jerk

LANES = {-1: -1.75, -2: -5.25, -3: -8.75, -4: -12.25}  # of highway.xodr: left edge at t = 0


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


class Stage:
    """The moving objects of a document, and what moves them."""

    def __init__(self, root: Node, dt: float) -> None:
        self.dt = dt
        self.time = 0.0
        self.entities = {node.get("name"): _entity(node) for node in root.iter("ScenarioObject")}

    def begin(self, action: Node, entity: Entity) -> Running | None:
        """Put a private action to work; those that take no time leave nothing behind."""
        inner = action[0]
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
            case "TrailerAction":
                return None  # nobody asks here where a trailer is
        raise NotImplementedError(inner.tag)

    def distance(self, a: Entity, b: Entity, node: Node) -> float:
        """Return the distance that a condition asks for."""
        if node.get("relativeDistanceType") in ("euclidianDistance", "cartesianDistance"):
            return math.hypot(b.x - a.x, b.y - a.y)
        if node.get("freespace") != "true":
            return abs(b.x - a.x)
        behind, ahead = (a, b) if a.x <= b.x else (b, a)
        return max(ahead.x - ahead.rear - behind.x - behind.front, 0.0)

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
            course, time = with_jerk(
                (entity.v, self._rate(entity)), end, limit, number(limits, "maxAccelerationRate")
            )
            return Running(entity, self.time, course, time)
        points = [(0.0, entity.v)]
        for entry in entries:
            points.append((points[-1][0] + number(entry, "time"), number(entry, "speed")))
        return Running(entity, self.time, lambda t: between(points, t), points[-1][0])

    def _rate(self, entity: Entity) -> float:
        """Return the acceleration at which a change of the speed is interrupted."""
        run = entity.actions.get("longitudinal")
        if run is None or run.done or run.course is None:
            return 0.0
        t = self.time - run.begun
        return (run.course(t) - run.course(t - 1e-4)) / 1e-4

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

    def advance(self) -> None:
        """Move everything by one step."""
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


def _entity(node: Node) -> Entity:
    centre, size = node.find(".//Center"), node.find(".//Dimensions")
    half, x = number(size, "length") / 2, number(centre, "x")
    performance = node.find(".//Performance")
    top = math.inf if performance is None else number(performance, "maxSpeed")
    return Entity(node.get("name"), half + x, half - x, top)


def nearest_lane(y: float) -> int:
    """Return the lane in which a point is."""
    return min(LANES, key=lambda lane: abs(LANES[lane] - y))
