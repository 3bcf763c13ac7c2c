"""Routing actions: routes, and trajectories."""

from __future__ import annotations

import math
from itertools import pairwise

from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Element
from osc2tx.xosc.player.bodies import LATERAL, LONGITUDINAL, Body, Pose, Running
from osc2tx.xosc.player.courses import between, number
from osc2tx.xosc.player.errors import Unplayable
from osc2tx.xosc.player.places import place_of, trajectory_way
from osc2tx.xosc.player.scene import STILL, Scene
from osc2tx.xosc.player.shapes import lengths_of, on_way
from osc2tx_runtime.opendrive import LanePosition


class Ways:
    """Routing actions at work."""

    def __init__(self, scene: Scene) -> None:
        self._scene = scene

    def begin(self, body: Body, node: Element) -> Running | None:
        """Return an action that begins."""
        if node.tag in ("AssignRouteAction", "AcquirePositionAction"):
            places = list(node.below(xml.Position))
            if not places:
                raise Unplayable("the route has no positions: it is one of a catalog", node.place)
            goal, _ = place_of(places[-1].inner, self._scene.bodies, self._scene.map)
            if not isinstance(goal, LanePosition):
                found = self._scene.map.locate(goal.x, goal.y, heading=goal.h)
                if found is None:
                    raise Unplayable("the route leads to no lane", node.place)
                goal = found
            body.route = self._scene.map.route_to(goal)
            return None
        if not (node.tag == "FollowTrajectoryAction"):
            raise Unplayable(f"<{node.tag}> is not played", node.place)
        way = trajectory_way(node, self._scene.bodies, self._scene.map, body.pose)
        timing = node.one(xml.TimeReference).find(xml.Timing)
        is_timed = timing is not None
        if timing is not None:
            scale, offset = number(timing, "scale", 1.0), number(timing, "offset")
            begin = self._scene.time if timing.domainAbsoluteRelative == "absolute" else 0.0
            way = [(time * scale + offset - begin, pose) for time, pose in way]
        domains = (LATERAL, LONGITUDINAL) if is_timed else (LATERAL,)
        run = Running(body, domains, self._scene.time, None, way=way, is_timed=is_timed)
        run.points = lengths_of(way)
        run.driven = number(node, "initialDistanceOffset")
        if timing is not None:
            run.length = way[-1][0]
        body.place = None
        if not is_timed or way[0][0] == 0.0:
            body.pose = on_way(run.way, run.points, run.driven)
        return run

    def _at_time(self, run: Running, time: float) -> Pose:
        times = [t for t, _ in run.way]
        time = min(max(time, times[0]), times[-1])
        driven = between(list(zip(times, run.points, strict=True)), time)
        if any(a == b for a, b in pairwise(run.points)):  # it waits on its path
            xs = between([(t, p.x) for t, p in run.way], time)
            ys = between([(t, p.y) for t, p in run.way], time)
            return Pose(xs, ys, on_way(run.way, run.points, driven).h)
        return on_way(run.way, run.points, driven)

    def follow(self, body: Body, run: Running, way: float, time: float) -> None:
        """Move a body along its path, by metres or to a time of it."""
        if run.is_timed:
            assert run.length is not None
            x, y, _ = body.here
            body.pose = self._at_time(run, time)
            body.v = math.dist(body.pose[:2], (x, y)) / self._scene.dt
            run.done = time >= run.length - STILL
        else:
            run.driven += way
            body.pose = on_way(run.way, run.points, run.driven)
            run.done = run.driven >= run.points[-1] - STILL
        if run.done:
            body.leave_path(self._scene.map)
