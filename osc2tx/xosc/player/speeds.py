"""Longitudinal actions: courses of the speed, and gaps along the road.

Behavior that the standard leaves to the tool is as simple as possible: a gap is closed as fast as
the limits of the action allow, a speed without time is reached as fast as limits and jerk allow.
"""

from __future__ import annotations

import math
from itertools import pairwise

from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Element
from osc2tx.xosc.player.bodies import LONGITUDINAL, Body, Running
from osc2tx.xosc.player.courses import PEAK_RATES, Course, between, number, shaped, with_jerk
from osc2tx.xosc.player.errors import Unplayable
from osc2tx.xosc.player.reading import Reading
from osc2tx.xosc.player.scene import GAP_REACHED, STILL, Scene
from osc2tx.xosc.player.synchrony import Synchrony


class Speeds:
    """Longitudinal actions at work."""

    def __init__(self, scene: Scene, reading: Reading) -> None:
        self._scene, self._reading = scene, reading
        self._synchrony = Synchrony(scene)
        self._next: dict[str, float] = {}  # of the next step, as far as they are known

    def step(self) -> dict[str, float]:
        """Return the next speeds (m/s) of all bodies."""
        self._next = {}
        return {name: self.next_of(body) for name, body in self._scene.bodies.items()}

    # --- starting ---------------------------------------------------------------------------------

    def begin(self, body: Body, node: Element) -> Running:
        """Return an action that begins."""
        match node.tag:
            case "SpeedAction":
                return self._speed(body, node)
            case "SpeedProfileAction":
                return self._profile(body, node)
            case "SynchronizeAction":
                return self._synchrony.begin(body, node)
            case "LongitudinalDistanceAction":
                side = self._scene.side(body, node, "longitudinal")
                if node.find(xml.DynamicConstraints) is None and node.get("continuous") != "true":
                    return self._at_once(body, node, side)
                return Running(body, (LONGITUDINAL,), self._scene.time, None, gap=node, side=side)
        raise Unplayable(f"<{node.tag}> is not played", node.place)

    def _speed(self, body: Body, node: Element) -> Running:
        dynamics, target = node.one(xml.SpeedActionDynamics), node.one(xml.SpeedActionTarget).inner
        if target.get("continuous") == "true":
            return Running(body, (LONGITUDINAL,), self._scene.time, None, relative=node)
        end = self._target_speed(target)
        shape, dimension = dynamics.said("dynamicsShape"), dynamics.said("dynamicsDimension")
        value, change = number(dynamics, "value"), abs(end - body.v)
        peak = PEAK_RATES.get(shape, 0.0)
        time = math.inf if change else 0.0  # at a rate of 0 it never gets there
        match dimension:
            case "time":
                time = value
            case "rate" if value:
                time = peak * change / abs(value)
            case "distance" if body.v + end:  # the mean of all these shapes lies in the middle
                time = 2.0 * value / abs(body.v + end)
        if shape == "step" or (dimension != "rate" and value == 0.0):
            time = 0.0
        else:  # a tool may limit it to the performance of the vehicle
            limit = body.limits["maxAcceleration" if end > body.v else "maxDeceleration"]
            time = max(time, peak * change / limit)
        return Running(
            body, (LONGITUDINAL,), self._scene.time, time, speed=shaped(shape, body.v, end, time)
        )

    def _target_speed(self, target: Element) -> float:
        if target.tag == "AbsoluteTargetSpeed":
            return number(target, "value")
        other, value = self._scene.bodies[target.said("entityRef")], number(target, "value")
        is_factor = target.get("speedTargetValueType") == "factor"
        return other.v * value if is_factor else other.v + value

    def _profile(self, body: Body, node: Element) -> Running:
        assert node.get("entityRef") is None
        entries, limits = node.all(xml.SpeedProfileEntry), node.find(xml.DynamicConstraints)

        def limit(name: str) -> float:
            told = math.inf if limits is None else number(limits, name, math.inf)
            return min(told, body.limits[name])

        points = [(0.0, body.v)]
        courses: list[Course | None] = []
        for entry in entries:
            begin, v = points[-1]
            end = number(entry, "speed")
            if entry.get("time") is not None:
                points.append((begin + number(entry, "time"), end))
                courses.append(None)
                continue
            peak = limit("maxAcceleration" if end > v else "maxDeceleration")
            rate = (
                self._carried(body) if self._reading.carries_acceleration and not courses else 0.0
            )
            course, time = with_jerk(v, end, peak, limit("maxAccelerationRate"), rate)
            courses.append(course)
            points.append((begin + time, end))

        def value(t: float) -> float:
            for ((begin, _), (end, _)), course in zip(pairwise(points), courses, strict=True):
                if t <= end and course is not None:
                    return course(t - begin)
            return between(points, t)

        return Running(body, (LONGITUDINAL,), self._scene.time, points[-1][0], speed=value)

    @staticmethod
    def _carried(body: Body) -> float:
        """Return the acceleration (m/s^2) that an entity takes into its next action."""
        run = body.actions.get(LONGITUDINAL)
        return 0.0 if run is None or run.done else body.a

    # --- one step ---------------------------------------------------------------------------------

    def next_of(self, body: Body) -> float:
        """Return the next speed of a body; it may need that of another one."""
        if body.name not in self._next:
            self._next[body.name] = body.v  # the chain of references
            self._next[body.name] = _within(self._following(body), body.limits["maxSpeed"])
        return self._next[body.name]

    def _following(self, body: Body) -> float:
        run = body.actions.get(LONGITUDINAL)
        if run is None or run.done or run.is_timed:
            return body.v
        time = self._scene.time + self._scene.dt - run.begun
        if run.relative is not None:
            return self._nearing(body, run.relative)
        if run.master is not None:
            return self._synchrony.next_speed(body, run)
        if run.gap is not None:
            return self._closing(body, run, run.gap)
        assert run.speed is not None and run.length is not None
        run.done = time >= run.length - STILL
        return run.speed(time)

    def _closing(self, body: Body, run: Running, node: Element) -> float:
        """Return the next speed of an entity that keeps a distance, as fast as it may."""
        limits = node.find(xml.DynamicConstraints)
        leader, is_behind = self._scene.bodies[node.said("entityRef")], run.side > 0
        gap = self._scene.gap(body, node, "longitudinal")
        wanted = number(node, "distance")
        if node.get("timeGap") is not None:
            wanted = number(node, "timeGap") * (body.v if is_behind else leader.v)
        is_rigid = limits is None and node.get("continuous") == "true"
        if is_rigid and self._reading.fits_gaps:
            return self._fitted(body, run, node, leader)
        if is_rigid:
            time = number(node, "timeGap")
            return self._possible(body, self._rigid(body, leader, gap, time, is_behind=is_behind))
        wanted += self._between_ends(body, leader, node, is_behind=is_behind)
        error = gap - run.side * wanted
        low, high = (
            math.inf if limits is None else number(limits, name, math.inf)
            for name in ("maxDeceleration", "maxAcceleration")
        )
        if node.get("continuous") != "true" and abs(error) < GAP_REACHED:
            run.done = True
            return body.v
        rate = 2.0 * error + 2.0 * math.sqrt(2.0) * (leader.v - body.v) * body.along * leader.along
        fastest = math.inf if limits is None else number(limits, "maxSpeed", math.inf)
        wanted = body.v + min(max(rate, -low), high) * self._scene.dt
        return self._possible(body, _within(wanted, fastest))

    def _fitted(self, body: Body, run: Running, node: Element, leader: Body) -> float:
        """Move an entity to its distance, and return the speed of the reference."""
        scene, wanted = self._scene, number(node, "distance")
        if node.get("timeGap") is not None:
            wanted = number(node, "timeGap") * abs(leader.v)
        speed = self.next_of(leader)
        gap = scene.gap(body, node, "longitudinal")
        if node.get("freespace") == "true":
            gap = scene.ruler.space_ahead(body, leader)
        body.move(scene.map, gap - run.side * wanted, None, scene.dt)
        return speed

    def _at_once(self, body: Body, node: Element, side: int) -> Running:
        """Place an entity at its distance: the motion is not limited."""
        scene = self._scene
        leader, is_behind = scene.bodies[node.said("entityRef")], side > 0
        wanted = number(node, "distance")
        if node.get("timeGap") is not None:
            wanted = number(node, "timeGap") * (body.v if is_behind else leader.v)
        wanted += self._between_ends(body, leader, node, is_behind=is_behind)
        body.move(scene.map, scene.gap(body, node, "longitudinal") - side * wanted, None, scene.dt)
        return Running(body, (LONGITUDINAL,), scene.time, 0.0)

    @staticmethod
    def _between_ends(body: Body, leader: Body, node: Element, *, is_behind: bool) -> float:
        """Return the metres between reference points that boxes take, if the space counts."""
        if node.get("freespace") != "true":
            return 0.0
        return body.front + leader.rear if is_behind else body.rear + leader.front

    def _possible(self, body: Body, speed: float) -> float:
        """Return the nearest speed that the performance of a body allows."""
        low, high = (
            body.limits[name] * self._scene.dt for name in ("maxDeceleration", "maxAcceleration")
        )
        return min(max(speed, body.v - low), body.v + high)

    def _nearing(self, body: Body, action: Element) -> float:
        """Return the next speed of an entity with a speed relative to the reference.

        The dynamics state how it is reached: at a rate, or in a step.
        """
        target = self._target_speed(action.one(xml.SpeedActionTarget).inner)
        dynamics = action.one(xml.SpeedActionDynamics)
        if dynamics.get("dynamicsShape") == "step":
            return target
        if not (dynamics.get("dynamicsDimension") == "rate"):
            raise Unplayable("no length goes with continuous")
        most = number(dynamics, "value") * self._scene.dt
        return body.v + min(max(target - body.v, -most), most)

    def _rigid(
        self, body: Body, leader: Body, gap: float, time: float, *, is_behind: bool
    ) -> float:
        """Return the next speed of an entity that keeps its distance without any limits."""
        speed = self.next_of(leader)
        if not time or not is_behind:
            return speed
        ways = 0.5 * (leader.v + speed - body.v) * self._scene.dt
        space = body.front + leader.rear if self._is_between_ends(body) else 0.0
        return (gap - space + ways) / (time + 0.5 * self._scene.dt)

    @staticmethod
    def _is_between_ends(body: Body) -> bool:
        run = body.actions[LONGITUDINAL]
        return run.gap is not None and run.gap.get("freespace") == "true"


def _within(value: float, most: float) -> float:
    """Return a value, or the nearest one whose size a limit allows."""
    return min(max(value, -most), most)
