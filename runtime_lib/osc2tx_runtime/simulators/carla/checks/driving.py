"""Line 17: how well a driven car follows its lane and its speed, and the gains of its pedals.

The check drives with the controllers of runs, on a straight and on a curved stretch of 100 m.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from osc2tx_runtime.opendrive import LanePosition, RoadMap
from osc2tx_runtime.opendrive.geometry import wrap
from osc2tx_runtime.simulators.carla.attendance import Attendance
from osc2tx_runtime.simulators.carla.client_process import ClientProcess
from osc2tx_runtime.simulators.carla.gains import CAR as CAR_GAINS
from osc2tx_runtime.simulators.carla.level import with_spawn_points
from osc2tx_runtime.simulators.carla.plant import CarlaPlant
from osc2tx_runtime.simulators.carla.sensors import SensorStacks
from osc2tx_runtime.world.actor_dimensions import limits_of, shape_of
from osc2tx_runtime.world.embedded import EmbeddedWorld
from osc2tx_runtime.world.protocol import ActorSpec

from .motion import CAR, spawned, start_of, state_in
from .probe import Finding, Probe, differs, line, ok

PACE, FAR = 10.0, 100.0  # m/s, m
SETTLED = 2.0  # s after which the deviation counts
SPEED_OFF, PLACE_OFF = 0.5, 0.3  # m/s, m from the reference
FLOORED = (1.0, 3.0)
"""Seconds of full throttle between which the acceleration is measured: gears take a moment."""

BRAKED = 0.5  # s
ALIKE = 0.25  # share by which proposed gains may differ from those of runs
TURNS = math.radians(5.0)  # change of heading over a stretch that makes it a curve


@line(17, "gains", drives=True)
def gains(probe: Probe) -> Finding:
    """A driven car follows its lane and its speed; its pedals match the controllers."""
    assert probe.road_map is not None
    road_map = with_spawn_points(probe.road_map, probe.level)
    straight, curve = stretches(road_map)
    slow, aside = _deviations(probe, road_map, straight)
    found = f"speed within {slow:.2f} m/s, position within {aside:.2f} m over {FAR:g} m"
    if curve is not None:
        more = _deviations(probe, road_map, curve)
        slow, aside = max(slow, more[0]), max(aside, more[1])
        found += f", {more[1]:.2f} m in a curve"
    throttle, brake = _pedals(probe)
    found += f"; a pedal per m/s^2: throttle {throttle:.2f}, brake {brake:.3f}"
    if slow > SPEED_OFF or aside > PLACE_OFF:
        return differs(found, "driven actors follow their references no better than that")
    used = CAR_GAINS._replace(**_own_gains(probe))
    measured = {"throttle": throttle, "brake": brake}
    proposed = [
        f"--carla-gains {name}={value:.2g}"
        for name, value in measured.items()
        if abs(value / getattr(used, name) - 1.0) > ALIKE
    ]
    if proposed:
        return differs(found, f"{' '.join(proposed)} makes driven cars accelerate as commanded")
    return ok(found)


def _own_gains(probe: Probe) -> Mapping[str, float]:
    found: Mapping[str, float] = probe.request.world.options.get("carla_gains", {})
    return found


def stretches(road_map: RoadMap) -> tuple[LanePosition, LanePosition | None]:
    """Return the spawn points before the straightest and the most curved stretch, if any."""
    turns = {place: _turn(road_map, place) for place in road_map.spawn_points()}
    long = {place: turn for place, turn in turns.items() if turn is not None}
    if not long:
        return road_map.spawn_points()[0], None
    straight, curve = min(long, key=long.__getitem__), max(long, key=long.__getitem__)
    return straight, curve if long[curve] > TURNS else None


def _turn(road_map: RoadMap, place: LanePosition) -> float | None:
    """Return the change of heading (rad) of the lane ahead; None if it is too short."""
    ahead = road_map.advance(place, 1.5 * FAR, None)
    if ahead.travelled < 1.5 * FAR - 1.0:
        return None
    goal = road_map.advance(place, FAR, None).position
    return abs(wrap(road_map.pose(goal).h - road_map.pose(place).h))


def _deviations(probe: Probe, road_map: RoadMap, place: LanePosition) -> tuple[float, float]:
    """Return the largest deviations of speed (m/s) and position (m) of a drive from a position."""
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
        gains=_own_gains(probe),
        attendance=Attendance(),
    )
    world = EmbeddedWorld(road_map, dt, plant)
    slow, aside = 0.0, 0.0
    try:
        world.add(ActorSpec("probe", "vehicle", shape_of("vehicle"), limits_of("vehicle"), CAR))
        world.place("probe", place, PACE)
        world.begin()
        for number in range(math.ceil(FAR / PACE / dt)):
            world.step()
            state, wanted = world.state("probe"), world.reference("probe")
            if number * dt > SETTLED:
                slow = max(slow, abs(state.v - wanted.v))
                aside = max(aside, math.hypot(state.x - wanted.x, state.y - wanted.y))
    finally:
        world.close()
    return slow, aside


def _pedals(probe: Probe) -> tuple[float, float]:
    """Return the pedal per m/s^2 of acceleration and of braking, from full throttle and brake."""
    driver, dt = probe.driving(), probe.request.world.dt
    begin, end = (round(each / dt) for each in FLOORED)
    braking = max(1, round(BRAKED / dt))
    with spawned(driver, CAR, start_of(probe)) as actor:
        for _ in range(math.ceil(1.0 / dt)):
            driver.ask("step", [])
        speeds = [_speed(driver, actor, 1.0, 0.0) for _ in range(end)]
        after = [_speed(driver, actor, 0.0, 1.0) for _ in range(braking)]
    gained = (speeds[-1] - speeds[begin - 1]) / ((end - begin) * dt)
    lost = (speeds[-1] - after[-1]) / (braking * dt)
    return 1.0 / max(gained, LEAST), 1.0 / max(lost, LEAST)


LEAST = 0.01  # m/s^2


def _speed(driver: ClientProcess, actor: int, throttle: float, brake: float) -> float:
    """Make a step with pedals; return the speed (m/s) after it."""
    control: Sequence[Any] = ("control", actor, throttle, 0.0, brake, False, False)
    return math.hypot(*state_in(driver.ask("step", [control]), actor)[6:8])
