"""Private actions at the level of kinematics: they begin, and everything moves by steps."""

from __future__ import annotations

import math

from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Element
from osc2tx.xosc.player.across import Offsets
from osc2tx.xosc.player.bodies import LATERAL, Body, Running, hang
from osc2tx.xosc.player.errors import Unplayable
from osc2tx.xosc.player.places import place_of
from osc2tx.xosc.player.reading import BY_THE_STANDARD, Reading
from osc2tx.xosc.player.scene import STILL, Scene
from osc2tx.xosc.player.speeds import Speeds
from osc2tx.xosc.player.ways import Ways
from osc2tx_runtime.opendrive import RoadMap


class Stage:
    """The bodies of a document, and the actions at work on them."""

    def __init__(
        self,
        root: Element,
        bodies: dict[str, Body],
        road_map: RoadMap,
        dt: float,
        reading: Reading = BY_THE_STANDARD,
    ) -> None:
        self._root = root
        self._scene = Scene(bodies, road_map, dt)
        self._speeds = Speeds(self._scene, reading)
        self._offsets, self._ways = Offsets(self._scene), Ways(self._scene)

    # --- starting ---------------------------------------------------------------------------------

    def begin(self, action: Element, body: Body, time: float) -> Running | None:
        """Start a private action; an instantaneous one leaves no running action."""
        self._scene.time, inner = time, action.inner
        match inner.tag:
            case "TeleportAction":
                for run in body.actions.values():
                    run.done = run.done or bool(run.way) or run.offset is not None
                bodies, road_map = self._scene.bodies, self._scene.map
                body.put(road_map, *place_of(inner.one(xml.Position).inner, bodies, road_map))
                return None
            case "LongitudinalAction":
                return self._take(self._speeds.begin(body, inner.inner))
            case "SynchronizeAction":
                return self._take(self._speeds.begin(body, inner))
            case "LateralAction":
                return self._take(self._offsets.begin(body, inner.inner))
            case "RoutingAction":
                following = self._ways.begin(body, inner.inner)
                return None if following is None else self._take(following)
            case "TrailerAction":
                self._trailer(body, inner.inner)
                return None
            case "AppearanceAction":
                return None
        raise Unplayable(f"<{inner.tag}> is not played", inner.place)

    def _trailer(self, body: Body, node: Element) -> None:
        if node.tag == "ConnectTrailerAction":
            hang(self._root, body, self._scene.bodies[node.said("trailerRef")])
            return
        for each in self._scene.bodies.values():
            if each.behind is not None and each.behind[0] is body:
                each.put(self._scene.map, each.here, each.here.h)

    def _take(self, run: Running) -> Running:
        for domain in run.domains:
            before = run.body.actions.get(domain)
            if before is not None and before is not run:
                before.done = True
                if before.way and not run.way and run.body.place is None:
                    run.body.leave_path(self._scene.map)
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
            h = self._scene.map.pose(place).h
            run.body.put(self._scene.map, place, h if run.body.along > 0 else h + math.pi)

    # --- one step ---------------------------------------------------------------------------------

    def advance(self, time: float) -> None:
        """Move everything by one step, which begins at a time (s)."""
        self._scene.time = time
        bodies, dt = self._scene.bodies, self._scene.dt
        before = {name: (body.v, body.pose) for name, body in bodies.items()}
        speeds = self._speeds.step()
        for name, body in bodies.items():
            if body.pose is not None and body.behind is None:
                self._move(body, speeds[name])
        for body in bodies.values():
            if body.behind is not None:
                body.trail()
        for name, body in bodies.items():
            v, pose = before[name]
            body.a = (body.v - v) / dt
            if pose is not None:
                body.note_motion(pose, dt)

    def _move(self, body: Body, speed: float) -> None:
        scene = self._scene
        way = 0.5 * (body.v + speed) * scene.dt
        body.v, body.rate = speed, 0.0
        run = body.actions.get(LATERAL)
        if run is None or run.done:
            body.move(scene.map, way, None, scene.dt)
            return
        time = scene.time + scene.dt - run.begun
        if run.way:
            self._ways.follow(body, run, way, time)
        elif run.offset is not None:
            assert run.length is not None
            run.driven += abs(way)
            passed = run.driven if run.is_by_way else time
            run.done = passed >= run.length - STILL
            body.move(scene.map, way, run.offset(passed), scene.dt)
        elif run.gap is not None:
            self._offsets.keep_aside(body, run, run.gap, way)
