"""Lines 7, 8, 14 to 19 and 23: what has to be tried, with actors of our own.

They are spawned by a second connection at spawn points of the level, and are gone at the end.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from itertools import pairwise
from statistics import median
from typing import Any

from osc2tx_runtime.opendrive import LanePosition
from osc2tx_runtime.simulators.carla.attendance import Attendance
from osc2tx_runtime.simulators.carla.blueprints import WALKER, blueprint_for
from osc2tx_runtime.simulators.carla.cast import LEAST_SIZE
from osc2tx_runtime.simulators.carla.client_process import ClientProcess
from osc2tx_runtime.simulators.carla.frames import measurement_from
from osc2tx_runtime.simulators.carla.level import with_spawn_points
from osc2tx_runtime.simulators.carla.plant import SAME_DT, CarlaPlant
from osc2tx_runtime.simulators.carla.sensors import SensorStacks
from osc2tx_runtime.world.actor_dimensions import limits_of, shape_of
from osc2tx_runtime.world.embedded import EmbeddedWorld
from osc2tx_runtime.world.protocol import ActorSpec

from .probe import Finding, Probe, differs, line, ok, unknown

CAR = "vehicle.tesla.model3"
TIMED = 50  # steps
EXACT = 1e-3  # m
MOVED = 0.5  # m that an exact actor is moved in a step
KICK, KEPT = 20.0, 19.0  # m/s at the start, and a second later
PACE, WALK = 10.0, 1.4  # m/s of a car and of a walker
FAR = 100.0  # m that a car is driven
SPEED_OFF, PLACE_OFF = 0.5, 0.3  # m/s, m from the reference
HIGH = 1.0  # m above a spawn point
TILT = 20.0  # degrees
STILL = 0.5  # degrees that a tilt has to change by
WALKED = 0.8  # share of a way that a walker has to cover: it starts after a moment


@line(7, "steps", drives=True)
def steps(probe: Probe) -> Finding:
    """Steps are ours, one by one, of the length that was asked for."""
    driver, dt = probe.driving(), probe.request.world.dt
    looked = [driver.ask("step", []) for _ in range(6)][1:]
    lengths = sorted({each["dt"] for each in looked})
    if any(each["skipped"] for each in looked):
        return differs("steps were made by another client as well", "end it, or --no-tick")
    if any(abs(each - dt) > SAME_DT for each in lengths):
        return differs(
            f"steps are {', '.join(f'{each:g}' for each in lengths)} s long, not {dt:g} s",
            "times of the trace would be wrong: runs refuse such steps",
        )
    return ok(f"{dt:g} s")


@line(8, "cost of a step", drives=True)
def cost(probe: Probe) -> Finding:
    """How fast the server is; no run depends on it."""
    driver, dt = probe.driving(), probe.request.world.dt
    took = []
    for _ in range(TIMED):
        begin = time.perf_counter()
        driver.ask("step", [])
        took.append(time.perf_counter() - begin)
    factor = dt / median(took)
    found = f"{1e3 * median(took):.0f} ms, {factor:.2g} times real time"
    if factor < 1.0:
        return differs(found, "a stack that needs real time gets it slowed down")
    return ok(found)


@line(14, "sizes", drives=True)
def sizes(probe: Probe) -> Finding:
    """Boxes and wheels of the models that the scenario uses."""
    driver, wrong, found = probe.driving(), [], []
    for name in _vehicles(probe):
        with _spawned(driver, name, _start(probe)) as actor:
            driver.ask("step", [])
            told = driver.ask("describe", actor)
        length = 2.0 * told["box"][1]
        wheels = [place for *place, _ in told.get("wheels", ())]
        if length < LEAST_SIZE:
            wrong.append(f"the box of {name} is {length:.2f} m long")
        elif len(set(map(tuple, wheels))) < len(wheels):
            wrong.append(f"wheels of {name} are at one place")
        else:
            found.append(f"{name} {length:.2f} m")
    if wrong:
        return differs("; ".join(wrong), "sizes and axles of the scenario are used instead")
    return ok(", ".join(found))


@line(15, "exact poses", drives=True)
def exact(probe: Probe) -> Finding:
    """An actor without physics is where it is put; others see it without a velocity."""
    driver = probe.driving()
    x, y, z, *turn = _start(probe)
    with _spawned(driver, CAR, (x, y, z + HIGH, *turn)) as actor:
        driver.ask("step", [("physics", actor, False)])
        off, speeds = 0.0, []
        for number in range(1, 6):
            ahead = MOVED * number * math.cos(math.radians(turn[1]))
            aside = MOVED * number * math.sin(math.radians(turn[1]))
            pose = (x + ahead, y + aside, z + HIGH, *turn)
            state = _state(driver.ask("step", [("place", actor, *pose)]), actor)
            off = max(off, math.dist(state[:3], pose[:3]))
            speeds.append(math.hypot(*state[6:9]))
    if off > EXACT:
        return differs(f"{1e3 * off:.1f} mm from where it was put", "runs refuse that")
    found = f"within {1e3 * off:.2f} mm; others see {max(speeds):.1f} m/s"
    watched = [each for each in probe.request.world.control.values() if each != "exact"]
    if max(speeds) < 0.5 * MOVED / probe.request.world.dt and watched:
        return differs(
            found,
            "a radar, and whoever looks at velocities, sees exact actors stand: exact-physics",
        )
    return ok(found)


@line(16, "speed at the start", drives=True)
def kick(probe: Probe) -> Finding:
    """A body that is given a speed keeps it for a moment."""
    driver, dt = probe.driving(), probe.request.world.dt
    x, y, z, pitch, yaw, roll = _start(probe)
    vector = (KICK * math.cos(math.radians(yaw)), KICK * math.sin(math.radians(yaw)), 0.0)
    with _spawned(driver, CAR, (x, y, z, pitch, yaw, roll)) as actor:
        for _ in range(math.ceil(1.0 / dt)):
            driver.ask("step", [])
        driver.ask("apply", [("velocity", actor, *vector)])
        for _ in range(math.ceil(1.0 / dt)):
            looked = driver.ask("step", [])
        speed = math.hypot(*_state(looked, actor)[6:8])
    found = f"{speed:.1f} of {KICK:g} m/s after a second without pedals"
    if speed < KEPT:
        return differs(found, "driven and external actors start slower than the scenario says")
    return ok(found)


@line(17, "gains", drives=True)
def gains(probe: Probe) -> Finding:
    """A driven car keeps to its lane and its speed over 100 m."""
    assert probe.road_map is not None
    driver = ClientProcess(probe.timeout)
    contact = probe.connect(driver)
    dt = probe.request.world.dt
    plant = CarlaPlant(
        driver,
        contact["server"],
        {"": "driven"},
        {},
        SensorStacks({}),
        ticks=True,
        dt=dt,
        seed=0,
        manager_port=None,
        attendance=Attendance(),
    )
    road_map = with_spawn_points(probe.road_map, probe.level)
    world = EmbeddedWorld(road_map, dt, plant)
    slow, aside = 0.0, 0.0
    try:
        world.add(ActorSpec("probe", "vehicle", shape_of("vehicle"), limits_of("vehicle"), CAR))
        world.place("probe", _place_for(road_map.spawn_points(), road_map), PACE)
        world.begin()
        for number in range(math.ceil(FAR / PACE / dt)):
            world.step()
            state, wanted = world.state("probe"), world.reference("probe")
            if number * dt > 2.0:
                slow = max(slow, abs(state.v - wanted.v))
                aside = max(aside, math.hypot(state.x - wanted.x, state.y - wanted.y))
    finally:
        world.close()
    found = f"speed within {slow:.2f} m/s, position within {aside:.2f} m over {FAR:g} m"
    if slow > SPEED_OFF or aside > PLACE_OFF:
        return differs(found, "driven actors follow their references no better than that")
    return ok(found)


@line(18, "signs of rates", drives=True)
def rates(probe: Probe) -> Finding:
    """A tilted body falls on its wheels: its rate is that of its poses."""
    driver, dt = probe.driving(), probe.request.world.dt
    x, y, z, pitch, yaw, _ = _start(probe)
    with _spawned(driver, CAR, (x, y, z + HIGH, pitch, yaw, TILT)) as actor:
        states = [_state(driver.ask("step", []), actor) for _ in range(20)]
    for before, after in pairwise(states):
        turned = math.radians(after[5] - before[5])
        turning = measurement_from(after).turning
        if abs(turned) > math.radians(STILL) and turning is not None:
            told = turning[0] * math.cos(math.radians(yaw)) - turning[1] * math.sin(
                math.radians(yaw)
            )
            if told * turned > 0.0:
                return ok(f"roll {turned / dt:.2f} rad/s by poses, {told:.2f} by the server")
            return differs(
                f"roll {turned / dt:.2f} rad/s by poses, {told:.2f} by the server",
                "rates of roll and pitch in traces of driven actors have the wrong sign",
            )
    return unknown("the tilted body did not turn")


@line(19, "walkers", drives=True)
def walkers(probe: Probe) -> Finding:
    """A walker walks at the commanded speed, and its origin is in its middle."""
    driver, dt = probe.driving(), probe.request.world.dt
    x, y, z, _, yaw, _ = _start(probe)
    ahead = (math.cos(math.radians(yaw)), math.sin(math.radians(yaw)))
    with _spawned(driver, WALKER, (x, y, z + HIGH, 0.0, yaw, 0.0)) as actor:
        for _ in range(math.ceil(1.0 / dt)):
            looked = driver.ask("step", [])
        begin = _state(looked, actor)
        for _ in range(math.ceil(2.0 / dt)):
            looked = driver.ask("step", [("walk", actor, *ahead, WALK)])
        end = _state(looked, actor)
    way = math.dist(begin[:2], end[:2])
    found = f"{way:.2f} m in 2 s at {WALK} m/s"
    if way < WALKED * 2.0 * WALK:
        return differs(found, "driven walkers are late; `exact` walks them to the step")
    return ok(found)


@line(23, "clean end", drives=True)
def clean_end(probe: Probe) -> Finding:
    """What was changed is as before."""
    before = probe.before
    probe.close()
    after = probe.client.ask("situation")
    left = [name for name in before if after[name] != before[name]]
    if left:
        return differs(f"not restored: {', '.join(left)}", "reload the level before a next run")
    return ok("settings, weather, actors, camera and lights are as before")


def _vehicles(probe: Probe) -> Sequence[str]:
    """Return the blueprints of the vehicles that the scenario has, else of a car."""
    library = probe.client.ask("blueprints")
    specs = [each for each in probe.request.actors if each.shape.wheelbase > 0.0]
    return sorted({blueprint_for(each, library) for each in specs}) or [CAR]


def _start(probe: Probe) -> Sequence[float]:
    """Return the spawn point to try things at."""
    found: Sequence[float] = probe.level["spawn_points"][0]
    return found


def _place_for(places: Sequence[LanePosition], road_map: Any) -> LanePosition:
    """Return the first spawn point before which there is room to drive."""
    for place in places:
        road = road_map.roads[place.road]
        ahead = road_map.travel_direction(place.road, place.lane) > 0
        if (road.length - place.s if ahead else place.s) > 1.5 * FAR:
            return place
    return places[0]


@contextmanager
def _spawned(driver: ClientProcess, blueprint: str, pose: Sequence[float]) -> Iterator[int]:
    """Have an actor for a while."""
    actor: int = driver.ask("spawn", blueprint, {}, list(pose))["id"]
    try:
        yield actor
    finally:
        driver.ask("discard", actor)


def _state(looked: Mapping[str, Any], actor: int) -> Sequence[float]:
    found: Sequence[float] = dict(looked["actors"])[actor]
    return found
