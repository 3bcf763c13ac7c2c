"""Lines 7, 8, 14 to 16, 18, 19 and 23: trials with spawned actors.

A second connection spawns them at spawn points of the level, and removes them at the end.
"""

from __future__ import annotations

import math
import operator
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from itertools import pairwise
from statistics import median
from typing import Any

from osc2tx_runtime.simulators.carla.blueprints import WALKER, blueprint_for
from osc2tx_runtime.simulators.carla.cast import LEAST_SIZE
from osc2tx_runtime.simulators.carla.client_process import ClientProcess
from osc2tx_runtime.simulators.carla.frames import measurement_from
from osc2tx_runtime.simulators.carla.plant import SAME_DT

from .probe import Finding, Probe, differs, line, ok, unknown

CAR = "vehicle.tesla.model3"
TIMED = 50  # steps
SAME_BOX = 0.01  # m
EXACT = 1e-3  # m
MOVED = 0.5  # m that an exact actor is moved in a step
KICK, KEPT = 20.0, 19.0  # m/s at the start, and a second later
WALK = 1.4  # m/s
HIGH = 1.0  # m above a spawn point
TILT = 20.0  # degrees
STILL = 0.5  # degrees that a tilt has to change by
STANDS = 0.1  # m
WALKED = 0.8  # share of a distance that a walker has to cover: its start is delayed


@line(7, "steps", drives=True)
def steps(probe: Probe) -> Finding:
    """Steps are made by this client, one by one, with the requested length."""
    driver, dt = probe.driving(), probe.request.world.dt
    looked = [driver.ask("step", []) for _ in range(6)][1:]
    lengths = sorted({each["dt"] for each in looked})
    if any(each["skipped"] for each in looked):
        return differs("another client ticked as well", "end it, or --no-tick")
    if any(abs(each - dt) > SAME_DT for each in lengths):
        return differs(
            f"steps are {', '.join(f'{each:g}' for each in lengths)} s long, not {dt:g} s",
            "times of the trace would be wrong: runs refuse such steps",
        )
    covered = probe.client.ask("situation")["substeps"]
    if covered is None or covered < dt - SAME_DT:
        return differs(
            f"substeps cover {covered or 0.0:g} of {dt:g} s", "bodies with physics are inaccurate"
        )
    return ok(f"{dt:g} s, in substeps")


@line(8, "cost of a step", drives=True)
def cost(probe: Probe) -> Finding:
    """Speed of the server; runs do not depend on it."""
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
        with spawned(driver, name, start_of(probe)) as actor:
            early = driver.ask("describe", actor)["box"]
            driver.ask("step", [])
            told = probe.client.ask(
                "describe", actor
            )  # `client` requests it from the server, `driver` has it
        length = 2.0 * told["box"][1]
        wheels = [place for *place, _ in told.get("wheels", ())]
        if length < LEAST_SIZE:
            wrong.append(f"the box of {name} is {length:.2f} m long")
        elif max(map(abs, map(operator.sub, early, told["box"]))) > SAME_BOX:
            wrong.append(f"the box of {name} changes after its first step")
        elif len(set(map(tuple, wheels))) < len(wheels):
            wrong.append(f"wheels of {name} are at one place")
        else:
            found.append(f"{name} {length:.2f} m")
    if wrong:
        return differs("; ".join(wrong), "sizes and axles of the scenario are used instead")
    return ok(", ".join(found))


@line(15, "exact poses", drives=True)
def exact(probe: Probe) -> Finding:
    """An actor without physics is at its commanded position; other clients see no velocity."""
    driver = probe.driving()
    x, y, z, *turn = start_of(probe)
    with spawned(driver, CAR, (x, y, z + HIGH, *turn)) as actor:
        driver.ask("step", [("physics", actor, False)])
        off, speeds = 0.0, []
        for number in range(1, 6):
            ahead = MOVED * number * math.cos(math.radians(turn[1]))
            aside = MOVED * number * math.sin(math.radians(turn[1]))
            pose = (x + ahead, y + aside, z + HIGH, *turn)
            state = state_in(driver.ask("step", [("place", actor, *pose)]), actor)
            off = max(off, math.dist(state[:3], pose[:3]))
            speeds.append(math.hypot(*state[6:9]))
    if off > EXACT:
        return differs(f"{1e3 * off:.1f} mm from the position that was set", "runs refuse that")
    found = f"within {1e3 * off:.2f} mm; others see {max(speeds):.1f} m/s"
    watched = [each for each in probe.request.world.control.values() if each != "exact"]
    if max(speeds) < 0.5 * MOVED / probe.request.world.dt and watched:
        return differs(
            found,
            "a radar, and every consumer of velocities, sees exact actors stand: exact-physics",
        )
    return ok(found)


@line(16, "speed at the start", drives=True)
def kick(probe: Probe) -> Finding:
    """A body keeps an assigned speed for a moment."""
    driver, dt = probe.driving(), probe.request.world.dt
    x, y, z, pitch, yaw, roll = start_of(probe)
    vector = (KICK * math.cos(math.radians(yaw)), KICK * math.sin(math.radians(yaw)), 0.0)
    with spawned(driver, CAR, (x, y, z, pitch, yaw, roll)) as actor:
        for _ in range(math.ceil(1.0 / dt)):
            driver.ask("step", [])
        driver.ask("apply", [("velocity", actor, *vector)])
        for _ in range(math.ceil(1.0 / dt)):
            looked = driver.ask("step", [])
        speed = math.hypot(*state_in(looked, actor)[6:8])
    found = f"{speed:.1f} of {KICK:g} m/s after a second without pedals"
    if speed < KEPT:
        return differs(found, "driven and external actors start slower than the scenario states")
    return ok(found)


@line(18, "signs of rates", drives=True)
def rates(probe: Probe) -> Finding:
    """A tilted body falls on its wheels: its reported rate is that of its poses."""
    driver, dt = probe.driving(), probe.request.world.dt
    x, y, z, pitch, yaw, _ = start_of(probe)
    with spawned(driver, CAR, (x, y, z + HIGH, pitch, yaw, TILT)) as actor:
        states = [state_in(driver.ask("step", []), actor) for _ in range(20)]
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
    x, y, z, _, yaw, _ = start_of(probe)
    ahead = (math.cos(math.radians(yaw)), math.sin(math.radians(yaw)))
    with spawned(driver, WALKER, (x, y, z + HIGH, 0.0, yaw, 0.0)) as actor:
        half_height = driver.ask("describe", actor)["box"][3]
        for _ in range(math.ceil(1.0 / dt)):
            looked = driver.ask("step", [])
        begin = state_in(looked, actor)
        (ground,) = driver.ask("ground", [(x, y, z + HIGH)])
        states = [
            state_in(driver.ask("step", [("walk", actor, *ahead, WALK)]), actor)
            for _ in range(math.ceil(2.0 / dt))
        ]
    way = math.dist(begin[:2], states[-1][:2])
    late = sum(math.hypot(*state[6:8]) < 0.5 * WALK for state in states) * dt
    found = f"{way:.2f} m in 2 s at {WALK} m/s, starts after {late:.2f} s"
    if ground is not None and abs(begin[2] - half_height - ground) > STANDS:
        return differs(
            f"its origin is {begin[2] - ground:.2f} m above the ground, and half its height"
            f" {half_height:.2f} m",
            "walkers float or sink",
        )
    if way < WALKED * 2.0 * WALK:
        return differs(found, "driven walkers are late; `exact` walks them to the step")
    return ok(found)


@line(23, "clean end", drives=True)
def clean_end(probe: Probe) -> Finding:
    """All changes are undone."""
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


def start_of(probe: Probe) -> Sequence[float]:
    """Return the spawn point to try things at."""
    found: Sequence[float] = probe.level["spawn_points"][0]
    return found


@contextmanager
def spawned(driver: ClientProcess, blueprint: str, pose: Sequence[float]) -> Iterator[int]:
    """Spawn an actor within a context."""
    actor: int = driver.ask("spawn", blueprint, {}, list(pose))["id"]
    try:
        yield actor
    finally:
        driver.ask("discard", actor)


def state_in(looked: Mapping[str, Any], actor: int) -> Sequence[float]:
    """Return the state of an actor in a look."""
    found: Sequence[float] = dict(looked["actors"])[actor]
    return found
