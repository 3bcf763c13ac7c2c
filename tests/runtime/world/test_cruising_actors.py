"""Actors that cruise are where they would be if each step were computed by itself, to the bit."""

from collections.abc import Callable
from random import Random

import pytest

from osc2tx_runtime.opendrive import LaneCursor, RoadMap
from osc2tx_runtime.world import ActorSpec, EmbeddedWorld
from osc2tx_runtime.world.commands import LaneChange, LaneOffset, SpeedChange
from osc2tx_runtime.world.state import ActorState
from tests.work import calls

MakeSpec = Callable[[str], ActorSpec]
STEPS = 600


def busy_world(road_map: RoadMap, make_spec: MakeSpec, cars: int = 12) -> EmbeddedWorld:
    world, places = EmbeddedWorld(road_map), road_map.spawn_points()
    for i in range(cars):
        world.add(make_spec(f"car{i}"))
        world.place(f"car{i}", places[i * len(places) // cars], 5.0 * (i % 4))
    world.begin()
    return world


def tell(world: EmbeddedWorld, random: Random) -> None:
    """Tell somebody something else, now and then."""
    car = random.choice(world.actors())
    match random.randrange(80):
        case 0:
            world.command(car, "longitudinal", SpeedChange(random.choice([0.0, 8.0, 20.0])))
        case 1:
            world.command(car, "lateral", LaneChange(random.choice([-1, 1])))
        case 2:
            world.command(car, "lateral", LaneOffset(random.choice([0.0, 0.5])))
        case 3:
            world.assign(car, speed=random.choice([0.0, 6.0]))
        case 4:
            world.command(car, "longitudinal", None)


def course(
    road_map: RoadMap, make_spec: MakeSpec, seed: int
) -> list[tuple[list[ActorState], object]]:
    world, random, found = busy_world(road_map, make_spec), Random(seed), []
    for car in world.actors():
        world.command(car, "longitudinal", SpeedChange(world.state(car).v))
    for _ in range(STEPS):
        tell(world, random)
        world.step()
        found.append(([world.state(car) for car in world.actors()], world.collisions()))
    return found


@pytest.mark.parametrize("name", ["highway", "merge", "urban_crossing"])
def test_cruising_changes_no_digit(
    load_map: Callable[[str], RoadMap],
    make_spec: MakeSpec,
    name: str,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for seed in range(3):
        cruising = course(load_map(name), make_spec, seed)
        with monkeypatch.context() as patch:
            patch.setattr(LaneCursor, "stretch", lambda *_: None)
            step_by_step = course(load_map(name), make_spec, seed)
        assert cruising == step_by_step


def test_who_cruises_is_hardly_any_work(highway: RoadMap, make_spec: MakeSpec) -> None:
    def steps(cars: int) -> int:
        world = busy_world(highway, make_spec, cars)
        for car in world.actors():
            world.command(car, "longitudinal", SpeedChange(world.state(car).v))
        for _ in range(3):
            world.step()
        return calls(lambda: [world.step() for _ in range(10)])

    assert steps(28) - steps(8) <= 20 * 10 * 8
