"""Signs and sizes of distances, gaps and headways; contacts of boxes."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime.opendrive import LanePosition, Pose, RoadMap
from osc2tx_runtime.world import ActorSpec, ActorState, EmbeddedWorld
from osc2tx_runtime.world.actor_dimensions import Shape
from osc2tx_runtime.world.commands import LaneOffset
from osc2tx_runtime.world.geometry.lane_neighbours import offset_from
from osc2tx_runtime.world.measuring.collision import box_of, contact_interval, overlapped
from osc2tx_runtime.world.measuring.distances import (
    along_lanes,
    gap_between,
    headway_between,
    lateral_on_road,
    object_distance,
    side_gap,
    time_to_collision,
    time_to_cover,
)
from tests.runtime.opendrive.small_maps import one_road

CAR = Shape(5.0, 2.0, 1.5, 1.0)  # front 4 m, rear 1 m from the reference point
TRUCK = Shape(10.0, 2.5, 3.5, 2.0)


def state(x: float, y: float, h: float = 0.0, v: float = 0.0, shape: Shape = CAR) -> ActorState:
    return ActorState(x, y, 0.0, h, v, 0.0, None, 0.0, shape)


def test_object_distance_is_in_the_axes_of_the_caller() -> None:
    caller, other = state(10.0, 5.0, math.pi / 2), state(7.0, 25.0)
    assert object_distance(caller, other, "longitudinal", "reference_points") == pytest.approx(20)
    assert object_distance(caller, other, "lateral", "reference_points") == pytest.approx(3)
    assert object_distance(other, caller, "longitudinal", "reference_points") == pytest.approx(3)
    assert object_distance(other, caller, "lateral", "reference_points") == pytest.approx(-20)
    euclidean = object_distance(caller, other, "euclidean", "reference_points")
    assert euclidean == pytest.approx(math.hypot(3, 20))


def test_object_distance_between_boxes() -> None:
    caller, other = state(0.0, 0.0), state(20.0, 6.0, shape=TRUCK)
    assert object_distance(caller, other, "longitudinal", "bounding_boxes") == pytest.approx(14)
    assert object_distance(other, caller, "longitudinal", "bounding_boxes") == pytest.approx(-14)
    assert object_distance(caller, other, "lateral", "bounding_boxes") == pytest.approx(3.75)
    euclidean = object_distance(caller, other, "euclidean", "bounding_boxes")
    assert euclidean == pytest.approx(math.hypot(14, 3.75))
    beside = state(2.0, 6.0)
    assert object_distance(caller, beside, "longitudinal", "bounding_boxes") == 0.0


def test_gap_is_positive_ahead_and_headway_positive_behind() -> None:
    assert gap_between(20.0, CAR, TRUCK) == pytest.approx(20 - 1 - 8)
    assert gap_between(-20.0, CAR, TRUCK) == pytest.approx(-(20 - 4 - 2))
    assert gap_between(3.0, CAR, TRUCK) == gap_between(-3.0, CAR, TRUCK) == 0.0
    assert -headway_between(-20.0, CAR, TRUCK) == pytest.approx(20 + 8 - 4)


def test_side_gap_is_positive_on_the_left() -> None:
    assert side_gap(-3.5, CAR, CAR) == pytest.approx(1.5)
    assert side_gap(3.5, CAR, CAR) == pytest.approx(-1.5)
    assert side_gap(1.0, CAR, CAR) == 0.0


def test_time_is_infinite_behind_a_standing_actor() -> None:
    assert time_to_cover(10.0, 5.0) == 2.0
    assert time_to_cover(-10.0, 0.0) == -math.inf
    assert time_to_cover(0.0, 0.0) == 0.0


def test_time_to_collision() -> None:
    assert time_to_collision(state(0, 0, 0, 10), state(30, 0, 0, 5)) == pytest.approx(25 / 5)
    assert time_to_collision(state(0, 0, 0, 5), state(30, 0, 0, 10)) == math.inf
    assert time_to_collision(state(0, 0, 0, 10), state(30, 4, 0, 5)) == math.inf
    assert time_to_collision(state(0, 0), state(1, 0)) == 0.0
    crossing = time_to_collision(state(0, 0, 0, 10), state(30, -27, math.pi / 2, 10))
    assert crossing == pytest.approx(2.5)  # front 4 m + side 1 m before x = 30


def test_along_and_across_on_a_curve(
    load_map: Callable[[str], RoadMap], make_spec: Callable[..., ActorSpec]
) -> None:
    road_map = load_map("curve")
    world = EmbeddedWorld(road_map)
    here = LanePosition("1", -2, 200.0)
    there = road_map.advance(here, 30.0).position
    for name, place in (("a", here), ("b", there), ("c", LanePosition("1", -1, 200.0))):
        world.add(make_spec(name))
        world.place(name, place)
    a, b, c = (world.state(name) for name in "abc")
    assert along_lanes(road_map, a, b) == pytest.approx(30.0, abs=1e-6)
    assert along_lanes(road_map, b, a) == pytest.approx(-30.0, abs=1e-6)
    width = math.dist((a.x, a.y), (c.x, c.y))
    assert lateral_on_road(road_map, a, b) == pytest.approx(0.0, abs=1e-3)
    assert lateral_on_road(road_map, a, c) == pytest.approx(width, abs=1e-2)
    assert lateral_on_road(road_map, c, a) == pytest.approx(-width, abs=1e-2)


def test_contact_of_turned_boxes() -> None:
    a = box_of(state(0, 0))
    assert overlapped(a, {"b": box_of(state(1.5, 2.2, math.pi / 4))}) == ["b"]
    assert not overlapped(a, {"b": box_of(state(1.5, 2.2))})
    high = box_of(state(0, 0)._replace(z=5.0))
    assert not overlapped(a, {"b": high})
    assert contact_interval(a, box_of(state(30, 0)), -5.0, 0.0) == pytest.approx((5.0, 7.0))


def thin_world(
    road_map: RoadMap, speeds: tuple[float, float], apart: float, dt: float
) -> EmbeddedWorld:
    """Two plates of 5 cm that fly towards each other."""
    world = EmbeddedWorld(road_map, dt)
    plate = Shape(0.05, 2.0, 2.0, 0.025)
    for name, x, h, v in (("b", 0.0, 0.0, speeds[0]), ("a", apart, math.pi, speeds[1])):
        spec = ActorSpec(name, "movable_object", plate, limits=None)  # type: ignore[arg-type]
        world.add(spec)
        world.place(name, Pose(x, 0.0, 0.0, h), v)
    return world


def test_thin_boxes_do_not_tunnel(highway: RoadMap) -> None:
    world = thin_world(highway, (30.0, 30.0), 10.3, 0.05)  # 3 m per step, 5 cm thick
    hits = []
    for step in range(1, 11):
        world.step()
        hits += [(step, pair) for pair in world.collisions()]
    assert hits == [(4, ("a", "b"))]


def test_contact_is_reported_once_until_separated(highway: RoadMap) -> None:
    world = thin_world(highway, (0.1, 0.1), 0.06, 0.05)
    hits = 0
    for _ in range(60):
        world.step()
        hits += len(world.collisions())
    assert hits == 1
    world.assign("a", at=Pose(50.0, 0.0, 0.0, math.pi), speed=0.0)
    world.step()
    world.step()
    world.assign("a", at=Pose(world.state("b").x, 0.0, 0.0, math.pi))
    world.step()
    assert world.collisions() == (("a", "b"),)


def test_offsets_on_a_banked_road_are_measured_along_it(make_spec: Callable[..., Any]) -> None:
    """The t of OpenDRIVE lies in the surface: seen from above it is shorter by the cosine."""
    roll = 0.5
    bank = f'<lateralProfile><superelevation s="0" a="{roll}" b="0" c="0" d="0"/></lateralProfile>'
    road_map = one_road("line", 200.0, extra=bank)
    world = EmbeddedWorld(road_map)
    world.add(make_spec("a"))
    world.add(make_spec("b"))
    world.place("a", LanePosition("1", -1, 20.0, 0.4), 10.0)
    world.place("b", LanePosition("1", -1, 40.0, -0.6), 10.0)
    state = world.state("a")
    assert offset_from(road_map, LanePosition("1", -1, 20.0), state.x, state.y) == pytest.approx(
        0.4
    )
    assert world.aside(world.state("a"), world.state("b")) == pytest.approx(-1.0)
    world.command("a", "lateral", LaneOffset(1.0, "smooth", duration=2.0))
    before = world.state("a")
    for _ in range(45):
        world.step()
        now = world.state("a")
        assert abs(now.y - before.y) < 0.05  # from where it was, without a jump
        before = now
    assert now.offset == pytest.approx(1.0)
    assert now.y == pytest.approx((-1.5 + 1.0) * math.cos(roll))
