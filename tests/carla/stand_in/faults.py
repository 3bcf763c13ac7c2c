"""Ways in which servers differ from what runs rely on, by name: `--fault NAME`."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping
from typing import Any

from . import dynamics
from .rpc import CallError
from .simulation import Simulation

LIFE_SPAN = 20  # steps that a walker that was hit is still there
SPIN_UP, SLIP = 0.3, 0.12  # shares of a step
SLOW_MAP = 2.5  # s
RISEN = 0.5  # m
STREAMED = 100.0  # m around what a large level shows
Calls = dict[str, Callable[..., Any]]


def long_steps(simulation: Simulation, calls: Calls) -> None:
    """Steps are longer than they were set."""
    settings = calls["set_episode_settings"]

    def set_longer(given: list[Any]) -> int:
        fixed = [True, 2.0 * given[2][1]] if given[2][0] else given[2]
        return int(settings([*given[:2], fixed, *given[3:]]))

    calls["set_episode_settings"] = set_longer


def slow(simulation: Simulation, calls: Calls) -> None:
    """A step takes longer than it is."""
    tick = calls["tick_cue"]

    def slowly() -> int:
        time.sleep(1.5 * simulation.dt)
        return int(tick())

    calls["tick_cue"] = slowly


def sunk_mesh(simulation: Simulation, calls: Calls) -> None:
    """The mesh is below the lanes."""
    project = calls["project_point"]

    def below(*given: Any) -> list[Any]:
        hit, ((x, y, z), label) = project(*given)
        return [hit, [[x, y, z - 0.5], label]]

    calls["project_point"] = below


def unknown_mesh(simulation: Simulation, calls: Calls) -> None:
    """Nobody tells where the ground is."""
    del calls["project_point"]


def no_boxes(simulation: Simulation, calls: Calls) -> None:
    """Boxes have no size (carla issues 3670, 5841, 7596)."""
    calls["get_actor_bounding_box"] = lambda actor: [[0.0] * 3, [0.0] * 3, [0.0] * 3, actor]
    simulation.box = lambda actor: [[0.0] * 3, [0.0] * 3, [0.0] * 3, actor.id]  # type: ignore[method-assign]


def no_wheels(simulation: Simulation, calls: Calls) -> None:
    """All wheels are at the origin (carla issue 8746)."""
    ask = calls["get_physics_control"]

    def at_the_origin(actor: int) -> list[Any]:
        *others, wheels, sweep = ask(actor)
        return [*others, [[*tyre, [0.0] * 3] for *tyre, _ in wheels], sweep]

    calls["get_physics_control"] = at_the_origin


def frozen_lights(simulation: Simulation, calls: Calls) -> None:
    """A client has stopped the cycles of all lights and is gone."""
    for _, light in simulation.lights():
        light.frozen = True


def loose(simulation: Simulation, calls: Calls) -> None:
    """Poses are not quite those that were sent."""
    batch = calls["apply_batch"]

    def elsewhere(commands: list[Any], tick: bool = False) -> list[Any]:
        for ((number, fields),) in commands:
            if number == 6:
                fields[1][0][0] += 0.02
        return list(batch(commands, tick))

    calls["apply_batch"] = elsewhere


def sagging(simulation: Simulation, calls: Calls) -> None:
    """A body that is given a speed loses it: wheels and gear were not told (carla issue 3710).

    Wheels come up to the speed of the body by a share of the difference in each step, and slow it
    down by another one.
    """
    tick = calls["tick_cue"]
    wheels: dict[int, float] = {}

    def slipping() -> int:
        for actor in simulation.actors.values():
            if actor.kind != "vehicle" or not actor.gravity:
                continue
            speed = math.hypot(*actor.velocity[:2])
            slip = max(speed - wheels.get(actor.id, 0.0), 0.0)
            wheels[actor.id] = speed - (1.0 - SPIN_UP) * slip
            if speed > 0.0:
                actor.velocity = [v * (1.0 - SLIP * slip / speed) for v in actor.velocity]
        return int(tick())

    calls["tick_cue"] = slipping


def weak(simulation: Simulation, calls: Calls) -> None:
    """Engines are too weak to keep a speed."""
    dynamics.THROTTLE.update(dict.fromkeys(dynamics.THROTTLE, 0.01))
    dynamics.DRAG = 0.02


def soft_brakes(simulation: Simulation, calls: Calls) -> None:
    """Brakes are half as strong."""
    dynamics.BRAKING *= 0.5


def other_axes(simulation: Simulation, calls: Calls) -> None:
    """Rates are counted the other way round."""
    righted = dynamics._fall_on_wheels

    def turned(actor: Any, dt: float) -> None:
        before = list(actor.turning)
        righted(actor, dt)
        actor.turning = [2.0 * old - new for old, new in zip(before, actor.turning, strict=True)]

    dynamics._fall_on_wheels = turned


def late_walkers(simulation: Simulation, calls: Calls) -> None:
    """Walkers take half of the speed that they are told."""
    batch = calls["apply_batch"]

    def slower(commands: list[Any], tick: bool = False) -> list[Any]:
        for ((number, fields),) in commands:
            if number == 4:
                fields[1][1] *= 0.5
        return list(batch(commands, tick))

    calls["apply_batch"] = slower


def nameless_lights(simulation: Simulation, calls: Calls) -> None:
    """Lights have no ids of the map."""
    for _, light in simulation.lights():
        light.sign = ""


def sticky_camera(simulation: Simulation, calls: Calls) -> None:
    """What was changed does not go back: the camera drifts."""
    tick = calls["tick_cue"]

    def drifting() -> int:
        simulation.spectator.location[2] += 1.0
        return int(tick())

    calls["tick_cue"] = drifting


def mortal_walkers(simulation: Simulation, calls: Calls) -> None:
    """A walker that a vehicle has hit is removed after its life span."""
    tell, tick = simulation._tell_contact, calls["tick_cue"]
    spans: dict[int, int] = {}

    def note(me: Any, other: Any) -> None:
        if me.kind == "walker":
            spans.setdefault(me.id, LIFE_SPAN)
        tell(me, other)

    def age() -> int:
        for walker in list(spans):
            spans[walker] -= 1
            if spans[walker] == 0 and walker in simulation.actors:
                simulation.destroy(walker)
        return int(tick())

    simulation._tell_contact = note  # type: ignore[method-assign]
    calls["tick_cue"] = age


def large_level(simulation: Simulation, calls: Calls) -> None:
    """Actors far from the camera and from actors named `hero` are put to sleep."""
    tick = calls["tick_cue"]

    def asleep() -> int:
        actors = list(simulation.actors.values())
        shown = [each for each in actors if "hero" in each.attribute("role_name")]
        shown.append(simulation.spectator)
        for each in actors:
            places = (one.location[:2] for one in shown)
            near = any(math.dist(each.location[:2], place) < STREAMED for place in places)
            each.dormant = each.kind == "vehicle" and not near
        return int(tick())

    calls["tick_cue"] = asleep


def slow_map(simulation: Simulation, calls: Calls) -> None:
    """The text of the map takes longer than a call, as that of a large level does."""
    data = calls["get_map_data"]

    def slowly() -> str:
        time.sleep(SLOW_MAP)
        return str(data())

    calls["get_map_data"] = slowly


def rising_mesh(simulation: Simulation, calls: Calls) -> None:
    """The mesh rises above the lanes: who is spawned close to them stands in it."""
    spawn = calls["spawn_actor"]

    def above_the_mesh(description: list[Any], pose: list[Any]) -> list[Any]:
        ground = simulation.level.ground(pose[0], 0.0)
        if ground is not None and pose[0][2] < ground[0] + RISEN:
            raise CallError("Spawn failed because of collision at spawn position")
        return list(spawn(description, pose))

    calls["spawn_actor"] = above_the_mesh


def few_substeps(simulation: Simulation, calls: Calls) -> None:
    """The physics makes one substep of a step, whatever was set."""
    settings = calls["set_episode_settings"]
    calls["set_episode_settings"] = lambda given: settings([*given[:5], 1, *given[6:]])


def late_boxes(simulation: Simulation, calls: Calls) -> None:
    """Boxes have their sizes after a step only."""
    tick, box = calls["tick_cue"], simulation.box
    known: set[int] = set()

    def small_before(actor: Any) -> list[Any]:
        place, extent, *rest = box(actor)
        return [place, extent if actor.id in known else [1.0, 1.0, 1.0], *rest]

    def learn() -> int:
        known.update(simulation.actors)
        return int(tick())

    simulation.box = small_before  # type: ignore[method-assign]
    calls["tick_cue"] = learn


def sunk_walkers(simulation: Simulation, calls: Calls) -> None:
    """The origin of a walker is at its feet."""
    put = simulation._put_on_ground

    def lower(actor: Any) -> None:
        put(actor)
        if actor.kind == "walker":
            actor.location[2] -= actor.extent[2]

    simulation._put_on_ground = lower  # type: ignore[method-assign]


def falling(simulation: Simulation, calls: Calls) -> None:
    """Bodies take their time to fall on the ground."""
    put = simulation._put_on_ground
    speeds: dict[int, float] = {}

    def fall(actor: Any) -> None:
        before, dt = actor.location[2], simulation.dt
        put(actor)
        speed = speeds.get(actor.id, 0.0) - dynamics.GRAVITY * dt
        lower = before + speed * dt
        is_above = lower > actor.location[2]
        speeds[actor.id] = actor.velocity[2] = speed if is_above else 0.0
        actor.location[2] = max(lower, actor.location[2])

    simulation._put_on_ground = fall  # type: ignore[method-assign]


FAULTS: Mapping[str, Callable[[Simulation, Calls], None]] = {
    each.__name__.replace("_", "-"): each
    for each in (
        long_steps,
        slow,
        sunk_mesh,
        unknown_mesh,
        no_boxes,
        no_wheels,
        frozen_lights,
        loose,
        sagging,
        weak,
        soft_brakes,
        other_axes,
        late_walkers,
        nameless_lights,
        sticky_camera,
        mortal_walkers,
        large_level,
        slow_map,
        rising_mesh,
        few_substeps,
        late_boxes,
        sunk_walkers,
        falling,
    )
}
