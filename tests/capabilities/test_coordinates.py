"""C27 to C29: the world, the frame of an actor, the road."""

import math

import pytest

from tests.capabilities.kit import ROUNDED, Perform, next_step


def test_c27_points_and_distances_of_the_world(perform: Perform) -> None:
    run = perform("C27_world_coordinates")
    assert run.status == "success"
    barrier = run.last("barrier")
    assert (barrier["x"], barrier["y"], barrier["z"]) == (130.0, -24.0, 0.0)
    assert barrier["h"] == pytest.approx(math.pi / 2, abs=ROUNDED)
    approach = run.span("walker walk")
    walker = run.at("walker", approach.end)
    # On a line 4 m beside the barrier the distance is 5 m where 3 m are left along it.
    assert walker["y"] == pytest.approx(-20.0, abs=ROUNDED)
    assert approach.end == next_step(27.0 / 1.4)
    assert walker["x"] == pytest.approx(100.0 + 1.4 * approach.end, abs=ROUNDED)
    assert math.hypot(walker["x"] - 130.0, walker["y"] + 24.0) < 5.0


def test_c28_distances_in_the_frame_of_an_actor(perform: Perform) -> None:
    run = perform("C28_relative_coordinates")
    assert run.status == "success"
    abreast = run.event("abreast")
    # The walker at x = 150 m faces the road: the car's rear axle is to its left while x < 150 m.
    assert abreast == next_step((150.0 - 51.5) / 20.0)
    values = {line["name"]: line["value"] for line in run.of_kind("variable")}
    # lane 1: 12.25 m right of the middle of the road
    assert values["ahead"] == pytest.approx(25.0 - 12.25, abs=ROUNDED)
    assert values["left_of_car"] == pytest.approx(-(25.0 - 12.25), abs=ROUNDED)


def turned(s: float) -> float:
    """Heading of the reference line of `curve.xodr` at s (rad), up to the end of its first arc.

    100 m straight, a clothoid of 50 m to a radius of 120 m, an arc of 120 m.
    """
    clothoid = min(max(s - 100.0, 0.0), 50.0)
    arc = min(max(s - 150.0, 0.0), 120.0)
    return (clothoid**2 / (2.0 * 50.0) + arc) / 120.0


def test_c29_points_along_and_across_a_road_that_bends(perform: Perform) -> None:
    run = perform("C29_route_coordinates")
    assert run.status == "success"
    put = run.at("ego", run.span("ego assign_position").end)
    assert (put["road"], put["lane"], put["s"], put["offset"]) == ("1", -1, 120.0, 0.0)
    for line in run.states("ego")[2:]:
        if line["s"] < 270.0:
            # The road leans by 0.05 rad, which draws the lane 2 mm inwards on 50 m.
            assert line["h"] == pytest.approx(turned(line["s"]), abs=1e-4)
    # The middle of lane 1 lies 1.75 m outside of the bend: its way is longer by 1.75 m per radian.
    # The road climbs as well, with at most 4 %: less than 0.1 % more.
    start = run.span("ego assign_speed").end
    s = run.at("ego", start)["s"]
    way = 250.0 - s + 1.75 * (turned(250.0) - turned(s))
    passed = run.event("passed")
    assert way / 15.0 - 1e-6 <= passed - start <= 1.001 * way / 15.0 + 0.05
    (across,) = run.of_kind("variable")
    # The road leans by 0.05 rad there, and its t axis with it.
    assert across["value"] == pytest.approx(-1.75, abs=ROUNDED)


def test_c27_distance_to_a_point(perform: Perform) -> None:
    run = perform("C27_point_distance")
    assert run.status == "success"
    # 31.25 + 8.75 = 40 m beside the way, so 50 m straight where 30 m are left along it.
    approach = run.span("ego drive")
    assert approach.end == next_step((200.0 - 30.0 - 50.0) / 20.0) == run.event("near")
    assert run.at("ego", approach.end)["x"] >= 170.0


def test_c29_points_of_routes_and_back(perform: Perform) -> None:
    run = perform("C29_route_points")
    assert run.status == "success"
    half_way = run.event("half_way")
    assert half_way == next_step((250.0 - 100.0 - 50.0) / 16.0)
    values = {line["name"]: line["value"] for line in run.of_kind("variable")}
    assert values["s_there"] == pytest.approx(50.0 + 16.0 * half_way, abs=ROUNDED)
    # Middles of lanes -3 and -1 of 3.5 m: 8.75 m and 1.75 m right of the road's middle
    assert values["t_there"] == pytest.approx(-8.75, abs=ROUNDED)
    assert values["across"] == pytest.approx(-1.75 + 8.75, abs=ROUNDED)


def test_c29_the_map_has_what_the_scenario_asks_for(perform: Perform) -> None:
    run = perform("C29_abstract_route")
    assert run.status == "success"
    # Of the 2000 m of the road, the three lanes that run against its s: 200 m from their start
    begin = run.at("ego", 0.0)
    assert begin["lane"] > 0
    assert begin["s"] == pytest.approx(2000.0 - 200.0, abs=ROUNDED)
    assert run.last("ego")["s"] < begin["s"] - 0.95 * 15.0 * 3.0


def test_c29_points_of_the_road_and_of_the_world(perform: Perform) -> None:
    run = perform("C29_conversions")
    assert run.status == "success"
    values = {line["name"]: line["value"] for line in run.of_kind("variable")}
    # On a straight road s is x; -5 m is 0.25 m left of the middle of lane -2, whose t it is.
    assert (values["s_of_point"], values["t_of_point"]) == pytest.approx((300.0, 0.25))
    assert (values["x_of_place"], values["y_of_place"]) == pytest.approx((400.0, -5.25))
    # After a second at 10 m/s from 50 m on
    assert values["way"] == pytest.approx(400.0 - 60.0)
    # Right-hand traffic
    assert values["is_right"] is True and values["is_left"] is True
