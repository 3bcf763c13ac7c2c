"""Live fields of actors: signs as in the standard, errors where nothing is defined."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from osc2tx_runtime.domain import capabilities
from osc2tx_runtime.domain.actors import Person, StationaryObject, Vehicle
from osc2tx_runtime.domain.modifiers import MODIFIERS
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.actions.registry import methods
from osc2tx_runtime.language.context import ExecutionContext
from osc2tx_runtime.modifiers import speed
from osc2tx_runtime.opendrive import LanePosition, RoadMap
from osc2tx_runtime.world import EmbeddedWorld


@pytest.fixture
def pair(highway: RoadMap) -> tuple[Vehicle, Vehicle]:
    """`front` with 10 m/s is 30 m ahead of `back` with 15 m/s, one lane to the left of it."""
    front, back = Vehicle(name="front"), Vehicle(name="back", length=4.0, rear_overhang=1.0)
    place(
        highway,
        (front, LanePosition("1", -2, 130.0), 10.0),
        (back, LanePosition("1", -3, 100.0), 15.0),
    )
    return front, back


def place(road_map: RoadMap, *wishes: tuple[Vehicle, LanePosition, float]) -> EmbeddedWorld:
    world = EmbeddedWorld(road_map)
    context = ExecutionContext(world, None, {actor.id: actor for actor, _, _ in wishes})
    for actor, at, v in wishes:
        actor.bind(context)
        world.add(actor.spec())
        world.place(actor.id, at, v)
    return world


def test_longitudinal_signs(pair: tuple[Vehicle, Vehicle]) -> None:
    front, back = pair
    assert front.position.ahead_of(back) == back.position.behind(front) == pytest.approx(30.0)
    assert back.road_distance(front, "longitudinal") == pytest.approx(30.0)
    gap = 30.0 - 0.92 - 3.0
    assert front.space_gap(back, "longitudinal") == pytest.approx(gap)
    assert back.space_gap(front, "longitudinal") == pytest.approx(-gap)
    assert back.road_distance(front, "longitudinal", "bounding_boxes") == pytest.approx(gap)
    assert front.time_gap(back, "longitudinal") == pytest.approx(gap / 15.0)
    assert back.time_gap(front, "longitudinal") == pytest.approx(-gap / 15.0)
    headway = 30.0 + 3.68 - 3.0
    assert back.space_headway(front) == pytest.approx(headway)
    assert front.space_headway(back) == pytest.approx(-headway)
    assert back.time_headway(front) == pytest.approx(headway / 15.0)


def test_lateral_signs(pair: tuple[Vehicle, Vehicle]) -> None:
    front, back = pair
    between = back.road_distance(front, "lateral")
    assert between > 3.0
    assert front.space_gap(back, "lateral") == pytest.approx(between - 1.9)
    assert back.space_gap(front, "lateral") == pytest.approx(1.9 - between)
    assert front.time_gap(back, "lateral") == math.inf
    assert back.object_distance(front, "lateral") == pytest.approx(between)


def test_coordinates(pair: tuple[Vehicle, Vehicle]) -> None:
    front, back = pair
    assert front.get_s_coord() == pytest.approx(130.0)
    assert front.get_t_coord() == pytest.approx(front.position.y)
    assert back.get_t_coord("on_lane") == 0.0
    assert (front.speed, front.velocity.translational.x) == (10.0, 10.0)
    assert front.acceleration.translational.x == 0.0


def test_time_gap_behind_a_standing_follower_is_infinite(highway: RoadMap) -> None:
    front, back = Vehicle(name="front"), Vehicle(name="back")
    place(
        highway,
        (front, LanePosition("1", -2, 130.0), 10.0),
        (back, LanePosition("1", -2, 100.0), 0.0),
    )
    assert front.time_gap(back, "longitudinal") == math.inf
    assert back.time_gap(front, "longitudinal") == -math.inf


def test_distance_without_a_way_is_an_error(load_map: Callable[[str], RoadMap]) -> None:
    a, b = Vehicle(name="a"), Vehicle(name="b")
    road_map = load_map("crossing")
    place(road_map, (a, LanePosition("1", -1, 100.0), 0.0), (b, LanePosition("1", 1, 100.0), 0.0))
    with pytest.raises(ScenarioError, match="no lane leads from a to b or back"):
        a.position.ahead_of(b)


def test_reading_before_the_run_is_an_error() -> None:
    with pytest.raises(ScenarioError, match="hero is read before the scenario runs"):
        _ = Vehicle(name="hero").speed


def test_unknown_names_have_suggestions() -> None:
    with pytest.raises(ScenarioError, match="did you mean change_lane"):
        methods.bind(Vehicle(), "change_lan")(side="left").setup()
    with pytest.raises(ScenarioError, match="vehicle_category `lorry` is not one of car, van"):
        Vehicle(vehicle_category="lorry")
    with pytest.raises(TypeError, match="wheels"):
        Vehicle(wheels=4)  # type: ignore[call-arg]


def test_shapes_come_from_field_model_or_kind() -> None:
    assert Vehicle(model="vehicle.carlamotors.european_hgv").shape.length == 7.92
    assert Vehicle(vehicle_category="bus", width=2.4).shape.width == 2.4
    assert Person().shape.height == 1.75
    assert StationaryObject(model="static.prop.trafficwarning").shape.rear == pytest.approx(1.185)
    hgv = Vehicle(model="vehicle.carlamotors.european_hgv").spec().limits
    assert (hgv.acceleration, hgv.deceleration, hgv.jerk) == (1.5, 6.0, 10.0)


def test_capabilities_list_what_works() -> None:
    actions, listed = capabilities.actions(), capabilities.modifiers()
    drive = actions["vehicle.drive"]
    assert drive["ends"] == "open" and "speed" in drive["modifiers"]
    assert actions["movable_object.change_speed"]["arguments"] == [
        "target",
        "rate_profile",
        "rate_peak",
    ]
    taken = {name for each in actions.values() for name in each["modifiers"]}
    placing = {name for name, each in listed.items() if each["placement"]}
    assert taken | placing == set(MODIFIERS) == set(listed)
    assert capabilities.objects()["methods"]["traffic_participant.space_gap"] == [
        "reference",
        "direction",
    ]
    assert speed(1.0).name == "speed"
