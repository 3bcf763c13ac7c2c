"""Private actions at the level of kinematics: courses of speed and offset, ways, gaps.

What the standard leaves to the tool is done as plainly as it allows: a gap is closed as fast as the
limits of the action allow, a speed without time is reached as fast as limits and jerk allow.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from osc2tx_runtime.opendrive import LanePosition, RoadMap
from tests.xosc.bodies import LATERAL, LONGITUDINAL, Body, Pose, hang
from tests.xosc.courses import Course, Node, between, number, shaped, with_jerk
from tests.xosc.distances import Extent, Ruler, extent
from tests.xosc.places import beside, offset_of, place_of

STILL = 1e-9
GAP_REACHED = 0.05  # m


@dataclass
class Running:
    """An action at work.

    Attributes:
        body: On what.
        domains: Which of its domains it controls.
        begun: When it began (s).
        length: Seconds that it takes; `None`: it ends by itself or never.
        speed: Course of the speed.
        offset: Course of the offset.
        way: Points of a polyline, with times where it has some.
        gap: The action that keeps a distance.
        relative: The action that keeps a speed relative to that of another one.
        driven: Metres along the way so far.
        done: It is over.
    """

    body: Body
    domains: tuple[str, ...]
    begun: float
    length: float | None
    speed: Course | None = None
    offset: Course | None = None
    way: Sequence[tuple[float, Pose]] = ()
    is_timed: bool = False
    gap: Node | None = None
    relative: Node | None = None
    driven: float = 0.0
    done: bool = False
    points: list[float] = field(default_factory=list)


class Stage:
    """The bodies of a document, and the actions at work on them."""

    def __init__(
        self,
        root: Node,
        bodies: dict[str, Body],
        road_map: RoadMap,
        dt: float,
        *,
        carries: bool = False,
    ) -> None:
        self.root, self.bodies, self.map, self.dt = root, bodies, road_map, dt
        self.carries = carries
        self._speeds: dict[str, float] = {}  # of the next step, as far as they are known
        self.ruler = Ruler(road_map)
        self.time = 0.0

    # --- starting ---------------------------------------------------------------------------------

    def begin(self, action: Node, body: Body) -> Running | None:
        """Put a private action to work; those that take no time leave nothing behind."""
        inner = action[0]
        match inner.tag:
            case "TeleportAction":
                for run in body.actions.values():
                    run.done = run.done or bool(run.way) or run.offset is not None
                body.put(self.map, *place_of(inner.find("Position")[0], self.bodies, self.map))
                return None
            case "LongitudinalAction":
                return self._take(self._longitudinal(body, inner[0]))
            case "LateralAction":
                return self._take(self._lateral(body, inner[0]))
            case "RoutingAction":
                return self._routing(body, inner[0])
            case "TrailerAction":
                self._trailer(body, inner[0])
                return None
            case "AppearanceAction":
                return None
        raise NotImplementedError(inner.tag)

    def _trailer(self, body: Body, node: Node) -> None:
        if node.tag == "ConnectTrailerAction":
            hang(self.root, body, self.bodies[node.get("trailerRef")])
            return
        for each in self.bodies.values():
            if each.behind is not None and each.behind[0] is body:
                each.put(self.map, each.here, each.here.h)

    def _take(self, run: Running) -> Running:
        for domain in run.domains:
            before = run.body.actions.get(domain)
            if before is not None and before is not run:
                before.done = True
            run.body.actions[domain] = run
        if run.length == 0.0:
            self._finish(run)
        return run

    def _finish(self, run: Running) -> None:
        """Bring an action of no length to its end."""
        run.done = True
        if run.speed is not None:
            run.body.v = run.speed(0.0)
        if run.offset is not None and run.body.place is not None:
            place = run.body.place._replace(offset=run.offset(0.0))
            run.body.put(self.map, place, None)

    # --- along the road ---------------------------------------------------------------------------

    def _longitudinal(self, body: Body, node: Node) -> Running:
        match node.tag:
            case "SpeedAction":
                return self._speed(body, node)
            case "SpeedProfileAction":
                return self._profile(body, node)
            case "LongitudinalDistanceAction":
                return Running(body, (LONGITUDINAL,), self.time, None, gap=node)
        raise NotImplementedError(node.tag)

    def _speed(self, body: Body, node: Node) -> Running:
        dynamics, target = node.find("SpeedActionDynamics"), node.find("SpeedActionTarget")[0]
        if target.get("continuous") == "true":
            return Running(body, (LONGITUDINAL,), self.time, None, relative=node)
        end = self._target_speed(target)
        shape, dimension = dynamics.get("dynamicsShape"), dynamics.get("dynamicsDimension")
        value, change = number(dynamics, "value"), abs(end - body.v)
        peak = {"linear": 1.0, "cubic": 1.5, "sinusoidal": math.pi / 2, "step": 0.0}[shape]
        match dimension:
            case "time":
                time = value
            case "rate":
                time = peak * change / value
            case "distance":  # the mean of all these shapes lies in the middle
                time = 2.0 * value / (body.v + end)
        if shape == "step":
            time = 0.0
        else:  # a tool may hold it to what the vehicle can do
            limit = body.limits["maxAcceleration" if end > body.v else "maxDeceleration"]
            time = max(time, peak * change / limit)
        return Running(
            body, (LONGITUDINAL,), self.time, time, speed=shaped(shape, body.v, end, time)
        )

    def _target_speed(self, target: Node) -> float:
        if target.tag == "AbsoluteTargetSpeed":
            return number(target, "value")
        other, value = self.bodies[target.get("entityRef")], number(target, "value")
        is_factor = target.get("speedTargetValueType") == "factor"
        return other.v * value if is_factor else other.v + value

    def _profile(self, body: Body, node: Node) -> Running:
        assert node.get("entityRef") is None
        entries, limits = node.findall("SpeedProfileEntry"), node.find("DynamicConstraints")

        def limit(name: str) -> float:
            told = math.inf if limits is None else number(limits, name, math.inf)
            return min(told, body.limits[name])

        points, courses = [(0.0, body.v)], []
        for entry in entries:
            begin, v = points[-1]
            end = number(entry, "speed")
            if entry.get("time") is not None:
                points.append((begin + number(entry, "time"), end))
                courses.append(None)
                continue
            peak = limit("maxAcceleration" if end > v else "maxDeceleration")
            rate = self._carried(body) if self.carries and not courses else 0.0
            course, time = with_jerk(v, end, peak, limit("maxAccelerationRate"), rate)
            courses.append(course)
            points.append((begin + time, end))

        def value(t: float) -> float:
            for ((begin, _), (end, _)), course in zip(pairwise(points), courses, strict=True):
                if t <= end and course is not None:
                    return course(t - begin)
            return between(points, t)

        return Running(body, (LONGITUDINAL,), self.time, points[-1][0], speed=value)

    @staticmethod
    def _carried(body: Body) -> float:
        """Return the acceleration (m/s^2) that an entity takes into its next action."""
        run = body.actions.get(LONGITUDINAL)
        return 0.0 if run is None or run.done else body.a

    # --- across it --------------------------------------------------------------------------------

    def _lateral(self, body: Body, node: Node) -> Running:
        run = Running(body, (LATERAL,), self.time, 0.0)
        if node.tag == "LateralDistanceAction":
            run.length, run.gap = None, node
            return run
        assert body.place is not None, f"{body.name} is on no lane"
        if node.tag == "LaneOffsetAction":
            run.length, run.offset = self._to_offset(body, node)
            return run
        assert node.tag == "LaneChangeAction", node.tag
        place = body.lane(self.map)
        goal = node.find("LaneChangeTarget")[0]
        if goal.tag == "AbsoluteTargetLane":
            lane = LanePosition(place.road, int(number(goal, "value")), place.s)
        else:
            other = self.bodies[goal.get("entityRef")]
            theirs = other.lane(self.map)
            if theirs.road != place.road:  # at the height of the actor
                along = self.map.route_distance(theirs, place)
                theirs = self.map.advance(theirs._replace(offset=0.0), along).position
            number_ = beside(self.map, theirs, other.along, int(number(goal, "value"))).lane
            lane = LanePosition(place.road, number_, place.s)
        if self._direction(lane) != self._direction(place):
            body.along = -body.along
        start = offset_of(self.map, lane, body.here)
        body.place = lane._replace(offset=start)
        end = number(node, "targetLaneOffset") * body.along
        dynamics = node.find("LaneChangeActionDynamics")
        time = number(dynamics, "value")
        match dynamics.get("dynamicsDimension"):
            case "distance":
                time /= body.v
            case "rate":
                time = abs(end - start) / time
        run.length = time
        run.offset = shaped(dynamics.get("dynamicsShape"), start, end, time)
        return run

    def _direction(self, place: LanePosition) -> int:
        return self.map.travel_direction(place.road, place.lane)

    def _to_offset(self, body: Body, node: Node) -> tuple[float, Course]:
        """Return length and course of a change of the offset, whose acceleration has a peak."""
        place = body.lane(self.map)
        body.place = place._replace(offset=offset_of(self.map, place, body.here))
        target = node.find("LaneOffsetTarget")[0]
        end = number(target, "value")
        if target.tag == "RelativeTargetLaneOffset":
            other = self.bodies[target.get("entityRef")]
            end += other.place.offset * other.along
        end *= body.along
        dynamics = node.find("LaneOffsetActionDynamics")
        shape, peak = dynamics.get("dynamicsShape"), number(dynamics, "maxLateralAcc", math.inf)
        change = abs(end - body.place.offset)
        factor = {"sinusoidal": 0.5 * math.pi * math.pi, "cubic": 6.0, "step": 0.0}[shape]
        time = math.sqrt(factor * change / peak)
        return time, shaped(shape, body.place.offset, end, time)

    # --- ways -------------------------------------------------------------------------------------

    def _routing(self, body: Body, node: Node) -> Running | None:
        if node.tag in ("AssignRouteAction", "AcquirePositionAction"):
            *_, last = node.iter("Position")
            goal, _ = place_of(last[0], self.bodies, self.map)
            if not isinstance(goal, LanePosition):
                goal = self.map.locate(goal.x, goal.y, heading=goal.h)
            body.route = self.map.route_to(goal)
            return None
        assert node.tag == "FollowTrajectoryAction", node.tag
        way = []
        for vertex in node.iter("Vertex"):
            where, h = place_of(vertex.find("Position")[0], self.bodies, self.map)
            pose = where if isinstance(where, Pose) else Pose(*self.map.pose(where)[:2], 0.0)
            way.append((number(vertex, "time"), pose if h is None else pose._replace(h=h)))
        is_timed = node.find("TimeReference/Timing") is not None
        domains = (LATERAL, LONGITUDINAL) if is_timed else (LATERAL,)
        run = Running(body, domains, self.time, None, way=way, is_timed=is_timed)
        lengths = [math.dist(a[:2], b[:2]) for (_, a), (_, b) in pairwise(way)]
        run.points = [0.0]
        for length in lengths:
            run.points.append(run.points[-1] + length)
        if is_timed:
            assert node.find("TimeReference/Timing").get("domainAbsoluteRelative") == "relative"
            run.length = way[-1][0]
        body.place = None
        if not is_timed or way[0][0] == 0.0:
            body.pose = self._on_way(run, 0.0)
        return self._take(run)

    def _on_way(self, run: Running, driven: float) -> Pose:
        """Return the pose so far (m) along a way; it looks along it."""
        last = len(run.way) - 2
        index = next((i for i in range(last) if driven < run.points[i + 1]), last)
        (_, a), (_, b) = run.way[index], run.way[index + 1]
        length = run.points[index + 1] - run.points[index]
        part = (driven - run.points[index]) / length if length else 1.0
        h = math.atan2(b.y - a.y, b.x - a.x) if length else a.h
        return Pose(a.x + part * (b.x - a.x), a.y + part * (b.y - a.y), h)

    def _at_time(self, run: Running, time: float) -> Pose:
        times = [t for t, _ in run.way]
        time = min(max(time, times[0]), times[-1])
        driven = between(list(zip(times, run.points, strict=True)), time)
        if any(a == b for a, b in pairwise(run.points)):  # it waits on its way
            xs = between([(t, p.x) for t, p in run.way], time)
            ys = between([(t, p.y) for t, p in run.way], time)
            return Pose(xs, ys, self._on_way(run, driven).h)
        return self._on_way(run, driven)

    # --- one step ---------------------------------------------------------------------------------

    def advance(self) -> None:
        """Move everything by one step."""
        before = {name: (body.v, body.pose) for name, body in self.bodies.items()}
        self._speeds = {}
        speeds = {name: self._speed_of(body) for name, body in self.bodies.items()}
        for name, body in self.bodies.items():
            if body.pose is not None and body.behind is None:
                self._move(body, speeds[name])
        for body in self.bodies.values():
            if body.behind is not None:
                body.trail()
        for name, body in self.bodies.items():
            v, pose = before[name]
            body.a = (body.v - v) / self.dt
            if pose is not None:
                body.note_motion(pose, self.dt)

    def _speed_of(self, body: Body) -> float:
        """Return the next speed of a body; it may need that of another one."""
        if body.name not in self._speeds:
            self._speeds[body.name] = body.v  # who follows who follows it
            self._speeds[body.name] = self._next_speed(body)
        return self._speeds[body.name]

    def _next_speed(self, body: Body) -> float:
        run = body.actions.get(LONGITUDINAL)
        if run is None or run.done or run.is_timed:
            return body.v
        time = self.time + self.dt - run.begun
        if run.relative is not None:
            return self._nearing(body, run.relative)
        if run.gap is not None:
            return self._closing(body, run)
        assert run.speed is not None and run.length is not None
        run.done = time >= run.length - STILL
        return run.speed(time)

    def _move(self, body: Body, speed: float) -> None:
        way = 0.5 * (body.v + speed) * self.dt
        body.v, body.rate = speed, 0.0
        run = body.actions.get(LATERAL)
        if run is None or run.done:
            body.move(self.map, way, None, self.dt)
            return
        time = self.time + self.dt - run.begun
        if run.way:
            self._follow(body, run, way, time)
        elif run.offset is not None:
            assert run.length is not None
            run.done = time >= run.length - STILL
            body.move(self.map, way, run.offset(time), self.dt)
        else:
            self._keep_aside(body, run, way)

    def _follow(self, body: Body, run: Running, way: float, time: float) -> None:
        if run.is_timed:
            assert run.length is not None
            x, y, _ = body.here
            body.pose = self._at_time(run, time)
            body.v = math.dist(body.pose[:2], (x, y)) / self.dt
            run.done = time >= run.length - STILL
        else:
            run.driven += way
            body.pose = self._on_way(run, run.driven)
            run.done = run.driven >= run.points[-1] - STILL
        if run.done and body.kind == "Vehicle":  # from here on it keeps its lane
            place = self.map.locate(*body.pose[:2], heading=body.pose.h, max_distance=0.0)
            if place is not None:
                body.put(self.map, place, body.pose.h)

    # --- distances that are kept ------------------------------------------------------------------

    def _closing(self, body: Body, run: Running) -> float:
        """Return the next speed of an entity that keeps a distance, as fast as it may."""
        node, limits = run.gap, run.gap.find("DynamicConstraints")
        leader = self.bodies[node.get("entityRef")]
        gap = self.ruler.signed(
            body, leader, "longitudinal", node.get("coordinateSystem", "entity")
        )
        is_behind = (
            node.get("displacement", "trailingReferencedEntity") != "leadingReferencedEntity"
        )
        wanted = number(node, "distance")
        if node.get("timeGap") is not None:
            wanted = number(node, "timeGap") * (body.v if is_behind else leader.v)
        if limits is None and node.get("continuous") == "true":
            return self._rigid(body, leader, gap, number(node, "timeGap"), is_behind=is_behind)
        if node.get("freespace") == "true":
            wanted += body.front + leader.rear if is_behind else body.rear + leader.front
        error = gap - (wanted if is_behind else -wanted)
        low, high = (
            math.inf if limits is None else number(limits, name, math.inf)
            for name in ("maxDeceleration", "maxAcceleration")
        )
        if node.get("continuous") != "true" and abs(error) < GAP_REACHED:
            run.done = True
            return body.v
        rate = 2.0 * error + 2.0 * math.sqrt(2.0) * (leader.v - body.v) * body.along * leader.along
        return body.v + min(max(rate, -low), high) * self.dt

    def _nearing(self, body: Body, action: Node) -> float:
        """Return the next speed of an entity that keeps one relative to that of another one.

        The dynamics say how it is reached: at a rate, or in a step.
        """
        target = self._target_speed(action.find("SpeedActionTarget")[0])
        dynamics = action.find("SpeedActionDynamics")
        if dynamics.get("dynamicsShape") == "step":
            return target
        assert dynamics.get("dynamicsDimension") == "rate", "no length goes with continuous"
        most = number(dynamics, "value") * self.dt
        return body.v + min(max(target - body.v, -most), most)

    def _rigid(
        self, body: Body, leader: Body, gap: float, time: float, *, is_behind: bool
    ) -> float:
        """Return the next speed of an entity that keeps its distance without any limits."""
        speed = self._speed_of(leader)
        if not time or not is_behind:
            return speed
        ways = 0.5 * (leader.v + speed - body.v) * self.dt
        space = body.front + leader.rear if self._is_between_ends(body) else 0.0
        return (gap - space + ways) / (time + 0.5 * self.dt)

    @staticmethod
    def _is_between_ends(body: Body) -> bool:
        run = body.actions[LONGITUDINAL]
        return run.gap is not None and run.gap.get("freespace") == "true"

    def _keep_aside(self, body: Body, run: Running, way: float) -> None:
        node, limits = run.gap, run.gap.find("DynamicConstraints")
        other = self.bodies[node.get("entityRef")]
        found = self.ruler.signed(body, other, "lateral", node.get("coordinateSystem", "entity"))
        wanted = number(node, "distance")
        if node.get("freespace") == "true":
            x, y = math.cos(body.here.h + 0.5 * math.pi), math.sin(body.here.h + 0.5 * math.pi)
            wanted += Extent(0.0, 0.5 * body.width).high + extent(other, x, y).high
        is_left = node.get("displacement") != "rightToReferencedEntity"
        aside = found + (wanted if is_left else -wanted)
        if node.get("continuous") != "true" and abs(aside) < GAP_REACHED:
            run.done = True
        most = number(limits, "maxSpeed", math.inf) * self.dt
        step = min(max(aside, -most), most) * body.along
        body.move(self.map, way, body.place.offset + step, self.dt)
