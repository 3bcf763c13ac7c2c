"""Placement: order of dependencies, exact distances, and the message for each mistake."""

from __future__ import annotations

import dataclasses
import math
from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest

import osc2tx_runtime
from osc2tx_runtime import RunSettings
from osc2tx_runtime.domain.actors import (
    Person,
    PhysicalObject,
    Point,
    Pose,
    StationaryObject,
    Vehicle,
)
from osc2tx_runtime.domain.modifiers import Modifier
from osc2tx_runtime.domain.placing.initializer import ScenarioInitializer
from osc2tx_runtime.errors import ScenarioError, SettingsError
from osc2tx_runtime.language.actions.placement import Placement
from osc2tx_runtime.language.context import ExecutionContext
from osc2tx_runtime.modifiers import keep_lane, lane, location, position, speed, yaw
from osc2tx_runtime.opendrive import RoadMap, read_map
from osc2tx_runtime.world import EmbeddedWorld

MAPS = Path(osc2tx_runtime.__file__).parent / "maps"
Wish = tuple[PhysicalObject, Sequence[Modifier]]


def place(road_map: RoadMap, *wishes: Wish, **settings: Any) -> EmbeddedWorld:
    """Places actors; the n-th wish stands in line n of the scenario."""
    world = EmbeddedWorld(road_map)
    actors = {actor.id: actor for actor, _ in wishes}
    context = ExecutionContext(world, RunSettings(**settings), actors)
    for actor in actors.values():
        actor.bind(context)
    placements = [
        Placement(actor, tuple(modifiers), f"test.osc:{number}")
        for number, (actor, modifiers) in enumerate(wishes, 1)
        if modifiers
    ]
    ScenarioInitializer(context).run(placements)
    return world


@pytest.fixture
def a() -> Vehicle:
    return Vehicle(name="a")


@pytest.fixture
def b() -> Vehicle:
    return Vehicle(name="b")


def test_lanes_are_counted_from_either_edge(highway: RoadMap, a: Vehicle, b: Vehicle) -> None:
    world = place(highway, (a, [lane(1)]), (b, [lane(1, from_="left")]))
    assert (world.state("a").lane, world.state("b").lane) == (-4, -1)


def test_relative_places_wait_for_their_reference(highway: RoadMap, a: Vehicle, b: Vehicle) -> None:
    world = place(
        highway,
        (b, [lane(side="right", side_of=a), position(distance=5.0, behind=a), speed(same_as=a)]),
        (a, [lane(2), position(distance=50.0), speed(12.0)]),
    )
    assert world.state("a").s == pytest.approx(50.0)
    assert world.state("b").s == pytest.approx(45.0)
    assert (world.state("a").lane, world.state("b").lane) == (-3, -4)
    assert world.state("b").v == 12.0
    assert b.position.behind(a) == pytest.approx(5.0)


def test_time_uses_the_speed_of_the_one_behind(highway: RoadMap, a: Vehicle, b: Vehicle) -> None:
    first = [lane(2), position(distance=50.0), speed(12.0)]
    ahead = place(highway, (a, first), (b, [lane(same_as=a), position(time=2.0, ahead_of=a)]))
    assert ahead.state("b").s == pytest.approx(74.0)
    behind = place(
        highway,
        (a, first),
        (b, [lane(same_as=a), position(time=2.0, behind=a), speed(7.0)]),
    )
    assert behind.state("b").s == pytest.approx(36.0)


@pytest.mark.parametrize("beside", [False, True])
def test_ahead_of_on_a_curve_is_lane_length(
    load_map: Callable[[str], RoadMap], a: Vehicle, b: Vehicle, beside: bool
) -> None:
    where = lane(side="left", side_of=a) if beside else lane(same_as=a)
    world = place(
        load_map("curve"),
        (a, [lane(1), position(distance=200.0)]),
        (b, [where, position(distance=30.0, ahead_of=a)]),
    )
    assert b.position.ahead_of(a) == pytest.approx(30.0, abs=1e-6)
    assert a.position.behind(b) == pytest.approx(30.0, abs=1e-6)
    moved = (world.state("b").s or 0.0) - (world.state("a").s or 0.0)
    assert abs(moved) != pytest.approx(30.0, abs=0.1)


def test_default_places_do_not_overlap(highway: RoadMap) -> None:
    cars = [Vehicle(name=f"c{i}") for i in range(6)]
    world = place(highway, *((car, ()) for car in cars))
    places = [(world.state(car.id).lane, world.state(car.id).s) for car in cars]
    assert len(set(places)) == 6


def test_the_road_ahead_of_a_start_is_looked_at_once(
    highway: RoadMap, a: Vehicle, b: Vehicle, monkeypatch: pytest.MonkeyPatch
) -> None:
    """However many positions of `a` leave no room for `b`."""
    looked: list[Any] = []
    advance = RoadMap.advance

    def counted(road_map: RoadMap, place: Any, distance: float, route: Any = None) -> Any:
        looked.append((place, distance))
        return advance(road_map, place, distance, route)

    monkeypatch.setattr(RoadMap, "advance", counted)
    text = failure(highway, (a, ()), (b, [position(distance=5000.0, ahead_of=a)]))
    assert "the lane does not reach 5000.0 m ahead of a" in text
    starts = highway.spawn_points()
    assert {place for place, _ in looked} == set(starts)
    assert set(Counter(looked).values()) == {1}


def test_carla_frame_is_left_handed(highway: RoadMap) -> None:
    cone = StationaryObject(name="cone")
    world = place(highway, (cone, [position(x=100.0, y=3.0, h=0.5, frame="carla")]))
    state = world.state("cone")
    assert (state.x, state.y, state.h) == (100.0, -3.0, -0.5)


def test_person_at_a_point_faces_along_the_road_or_by_yaw(
    load_map: Callable[[str], RoadMap],
) -> None:
    walker = Person(name="walker")
    at = position(at_point=Point(200.0, -9.0), project_on_route=False)
    along = place(load_map("crossing"), (walker, [at])).state("walker").h
    across = place(load_map("crossing"), (walker, [at, yaw(math.pi / 2)])).state("walker").h
    assert across - along == pytest.approx(math.pi / 2)


def test_point_is_projected_unless_told_otherwise(load_map: Callable[[str], RoadMap]) -> None:
    walker, point = Person(name="walker"), Point(200.0, -9.0)
    road_map = load_map("crossing")
    projected = place(road_map, (walker, [position(at_point=point)])).state("walker")
    exact = position(at_point=point, project_on_route=False)
    there = place(road_map, (walker, [exact])).state("walker")
    assert (projected.lane, projected.s, projected.offset) == (-1, 200.0, 0.0)
    assert (there.x, there.y) == (200.0, -9.0)


def test_location_is_for_stationary_objects(highway: RoadMap, a: Vehicle) -> None:
    cone, at = StationaryObject(name="cone"), location(Pose(x=60.0, y=-2.0, yaw=0.3))
    state = place(highway, (cone, [at])).state("cone")
    assert (state.x, state.y, state.h) == (60.0, -2.0, 0.3)
    assert "location is for stationary objects" in failure(highway, (a, [at]))


def test_spawn_is_the_position(highway: RoadMap, a: Vehicle) -> None:
    world = place(highway, (a, [lane(2), speed(3.0)]), spawn={"a": ("1", -3, 77.0)})
    state = world.state("a")
    assert (state.lane, state.s, state.v) == (-3, 77.0, 3.0)


def failure(road_map: RoadMap, *wishes: Wish, **settings: Any) -> str:
    with pytest.raises(ScenarioError) as caught:
        place(road_map, *wishes, **settings)
    return str(caught.value)


def test_cycle(highway: RoadMap, a: Vehicle, b: Vehicle) -> None:
    text = failure(
        highway,
        (a, [position(distance=5.0, behind=b)]),
        (b, [position(distance=5.0, behind=a)]),
    )
    assert text == ("test.osc:2: the starts of a (test.osc:1), b (test.osc:2) depend on each other")


@pytest.mark.parametrize(
    ("modifiers", "message"),
    [
        (
            [lane(side="left", side_of="a")],
            "there is no lane to the left of a, which is in lane -1 of road 1",
        ),
        (
            [lane(same_as="a"), position(distance=2.0, ahead_of="a")],
            "b overlaps a by 2.60 m at its start",
        ),
        (
            [position(distance=5000.0, ahead_of="a")],
            "the lane does not reach 5000.0 m ahead of a",
        ),
        ([position(x=9000.0, y=0.0)], "(9000, 0) is off the map, which reaches from"),
        ([lane(9)], "map highway has no free position on a road with a lane 9 from the right"),
        ([keep_lane()], "b cannot start with keep_lane"),
        ([speed(3.0, at="end")], "speed at the end is not a start"),
        ([speed(3.0, rate_profile="smooth")], "a speed at the start takes no rate_profile"),
        ([position(x=9.0, y=-2.0), lane(1)], "b: its point is not on lane 1 from the right"),
        (
            [position(x=9.0, y=-2.0), lane(same_as="a")],
            "already determines the lane, which cannot be relative to a",
        ),
    ],
)
def test_mistakes(
    highway: RoadMap, a: Vehicle, b: Vehicle, modifiers: list[Any], message: str
) -> None:
    wishes = [swap(each, a) for each in modifiers]
    text = failure(highway, (a, [lane(1, from_="left"), position(distance=50.0)]), (b, wishes))
    assert message in text
    assert text.startswith("test.osc:2: ")


def swap(modifier: Any, a: Vehicle) -> Any:
    """The modifier with the actor in place of its name."""
    values = {f.name: getattr(modifier, f.name) for f in dataclasses.fields(modifier)}
    return type(modifier)(**{name: a if v == "a" else v for name, v in values.items()})


@pytest.mark.parametrize(
    ("spawn", "message"),
    [
        (("1", -3, 20.0), "lane -3 of road 1 is number 2 from the right, the scenario requires 1"),
        (("7", -3, 20.0), "there is no road `7`"),
        (("1", -4, 9999.0), "road 1 is 2000.0 m long, so there is no s = 9999 m"),
    ],
)
def test_wrong_spawn(
    highway: RoadMap, a: Vehicle, spawn: tuple[str, int, float], message: str
) -> None:
    assert message in failure(highway, (a, [lane(1)]), spawn={"a": spawn})


def test_wrong_destination(highway: RoadMap, a: Vehicle) -> None:
    with pytest.raises(SettingsError, match="write a placed actor or ROAD,LANE,S"):
        place(highway, (a, [lane(1)]), destination={"a": "nowhere"})


def test_town06_lane_numbers(test_data: Path) -> None:
    town = read_map(test_data / "maps/carla-2020/Town06.xodr")
    a, b = Vehicle(name="a"), Vehicle(name="b")
    spawn = {"a": ("40", -7, 100.0), "b": ("40", -3, 100.0)}
    world = place(town, (a, [lane(1)]), (b, [lane(1, from_="left")]), spawn=spawn)
    assert (world.state("a").lane, world.state("b").lane) == (-7, -3)


@pytest.mark.parametrize("wanted", [(), (lane(1),), (lane(1), position(20.0))])
def test_roads_that_lead_on_are_preferred(test_data: Path, wanted: Sequence[Modifier]) -> None:
    # Two lanes of each of its four roads: one to the junction, one to the edge of the map.
    town = read_map(test_data / "maps/esmini/fabriksgatan.xodr")
    first = town.spawn_points()[0]
    assert town.advance(first, 100.0).travelled < 100.0
    a = Vehicle(name="a")
    at = place(town, (a, wanted)).state("a").lane_position
    assert at is not None
    assert town.advance(at, 100.0).travelled == pytest.approx(100.0)
