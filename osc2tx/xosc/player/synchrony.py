"""Synchronized entities: one reaches its position when the master reaches its own.

The standard leaves the course of the speed to the tool. Here an entity holds its speed as long as
possible and then changes it at a constant rate; if that is not sufficient, it changes twice,
through an intermediate speed. The final speed is held for the distance or time of the action.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Element
from osc2tx.xosc.player.bodies import LATERAL, LONGITUDINAL, Body, Pose, Running
from osc2tx.xosc.player.courses import number
from osc2tx.xosc.player.places import place_of
from osc2tx.xosc.player.scene import STILL, Scene
from osc2tx.xosc.player.shapes import nearest_on
from osc2tx_runtime.opendrive import LanePosition, RoadMap

REACHED = 0.05  # m
EVEN = 1e-3  # m/s: speeds nearer than this are the same


class Plan(NamedTuple):
    """How an entity reaches its position.

    Attributes:
        hold: Seconds for which it holds its speed.
        through: Speed (m/s) in the middle of the change; `None`: the change is a single one.
        change: Seconds of the change, to the final speed.
        steady: Seconds for which it then holds the final speed.
    """

    hold: float
    through: float | None
    change: float
    steady: float


def plan(way: float, time: float, v: float, final: float, steady: float) -> Plan:
    """Return how an entity reaches a position in time.

    Args:
        way: Metres to the position.
        time: Seconds until the master is at its position.
        v: Its speed (m/s).
        final: Its speed at the place (m/s).
        steady: Seconds for which it has that before (s).
    """
    steady = min(steady, time)
    time, way = time - steady, way - steady * final
    mean, apart = 0.5 * (v + final), 0.5 * (v - final)
    if time <= STILL:
        return Plan(0.0, None, 0.0, steady)
    hold = (way - mean * time) / apart if abs(apart) > EVEN else 0.0
    if abs(apart) > EVEN and 0.0 <= hold <= time:
        return Plan(hold, None, time - hold, steady)
    return Plan(0.0, 2.0 * way / time - mean, time, steady)


def final_of(node: Element, v: float, master: Body) -> tuple[float, float]:
    """Return the final speed (m/s) of an action, and for how long (s) it is held before.

    Args:
        node: `SynchronizeAction`.
        v: The speed of the entity (m/s), which it keeps if no other one is stated.
        master: The master.
    """
    holder = node.find(xml.FinalSpeed)
    if holder is None or not holder.children:
        return v, 0.0
    inner = holder.inner
    final = number(inner, "value")
    if inner.tag == "RelativeSpeedToMaster":
        is_factor = inner.get("speedTargetValueType") == "factor"
        final = master.v * final if is_factor else master.v + final
    for each in inner.children:
        if each.tag == "TargetTimeSteadyState":
            return final, number(each, "time")
        if each.tag == "TargetDistanceSteadyState" and final > 0.0:
            return final, number(each, "distance") / final
    return final, 0.0


def way_left(body: Body, goal: LanePosition | Pose, road_map: RoadMap) -> float:
    """Return the distance (m) to a position on the path of an entity; negative behind it."""
    pose = Pose(*road_map.pose(goal)[:2], 0.0) if isinstance(goal, LanePosition) else goal
    run = body.actions.get(LATERAL)
    if run is not None and run.way and not run.done:
        return nearest_on(run.way, run.points, pose.x, pose.y) - run.driven
    if body.place is not None:
        there: LanePosition | None
        if isinstance(goal, LanePosition):
            there = goal
        else:
            there = road_map.locate(goal.x, goal.y, heading=body.here.h)
        if there is not None and there.road == body.place.road:
            direction = road_map.travel_direction(body.place.road, body.place.lane)
            return (there.s - body.place.s) * direction * body.along
        found = None if there is None else road_map.route_distance(body.place, there)
        if found is not None:
            return found * body.along
    x, y, h = body.here
    ahead = (pose.x - x) * math.cos(h) + (pose.y - y) * math.sin(h)
    return math.copysign(math.dist((x, y), pose[:2]), ahead)


class Synchrony:
    """Synchronized entities at work."""

    def __init__(self, scene: Scene) -> None:
        self._scene = scene

    def begin(self, body: Body, node: Element) -> Running:
        """Return an action that begins; its places are those of now."""
        scene = self._scene
        goals = [
            place_of(node.one(kind).inner, scene.bodies, scene.map)[0]
            for kind in (xml.TargetPositionMaster, xml.TargetPosition)
        ]
        run = Running(body, (LONGITUDINAL,), scene.time, None)
        run.master = (scene.bodies[node.said("masterEntityRef")], node, goals[0], goals[1])
        return run

    def next_speed(self, body: Body, run: Running) -> float:
        """Return the next speed of an entity."""
        assert run.master is not None
        master, node, theirs, ours = run.master
        ahead = way_left(master, theirs, self._scene.map) * math.copysign(1.0, master.v)
        own = way_left(body, ours, self._scene.map)
        final, steady = final_of(node, body.v, master)
        dt = self._scene.dt
        if ahead <= REACHED or own <= REACHED:
            run.done = True
            return final
        if abs(master.v) <= EVEN:
            return body.v
        found = plan(own, ahead / abs(master.v), body.v, final, steady)
        if found.hold + found.change <= dt:
            return final
        now, left = self._scene.time - run.begun, found.hold + found.change
        if run.length is None and found.through is not None:
            run.length = 0.5 * found.change  # from then on it approaches its final speed
        if run.length is not None and now < run.length - STILL:
            first = run.length - now
            second = left - first
            way = own - final * found.steady
            through = (2.0 * way - body.v * first - final * second) / left
            return max(body.v + (through - body.v) * dt / first, 0.0)
        if run.length is not None:
            return body.v + (final - body.v) * dt / left
        return (
            body.v if found.hold >= dt else body.v + (final - body.v) * dt / max(found.change, dt)
        )
