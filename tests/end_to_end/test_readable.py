"""Members and methods that scenarios read: velocities, hitches, dates."""

from __future__ import annotations

import calendar
from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx_runtime import Scenario, ScenarioError
from tests.end_to_end.harness import asam, run

SCENARIO = """import osc.standard.all

namespace null use std, stdtypes

scenario readable:
    road: map with:
        keep(it.map_file == "highway.xodr")
    sky: environment
    ego: vehicle
    cart: trailer
    spot: position_3d with:
        keep(it.x == 3m)
        keep(it.y == 4m)
    noon: time = sky.local_to_unix_time(2024, 2, 29, 12, 30, 15, 1.5)

    event braking is rise(ego.acceleration.translational.x < -1mpss)
    event slow is rise(ego.velocity.translational.x < 5mps)
    event let_go is fall(ego.trailer_receiver.is_towing)
    event free is fall(cart.coupler.is_towed)
    event pulled_slowly is fall(cart.tow_vehicle.speed > 7mps)

    ego.tow_trailer(cart)

    do parallel:
        serial:
            ego.drive(duration: 2s) with:
                lane(2, at: start)
                position(100m, at: start)
                speed(10mps)
            ego.change_speed(4mps, rate_profile: constant, rate_peak: 2mpss)
            ego.disconnect_trailer()
        wait @braking
        wait @slow
        wait @let_go
        wait @free
        wait @pulled_slowly
        wait spot.norm() == 5m
"""


def test_what_actors_tell(
    load: Callable[[GeneratedModule], type[Scenario]], tmp_path: Path
) -> None:
    scenario = load(emit(asam(SCENARIO, tmp_path)))
    trace = run(scenario)
    assert trace.status == "success"
    # From 10 m/s at t = 2 s with 2 m/s2: 7 m/s at 3.5 s, 5 m/s at 4.5 s, 4 m/s at 5 s.
    assert trace.event("braking") == 2.05
    assert trace.event("pulled_slowly") == 3.5
    assert trace.event("slow") == 4.55
    assert trace.event("let_go") == trace.event("free") == 5.0


def test_values_before_the_run(
    load: Callable[[GeneratedModule], type[Scenario]], tmp_path: Path
) -> None:
    scenario = load(emit(asam(SCENARIO, tmp_path)))()
    utc = calendar.timegm((2024, 2, 29, 11, 0, 15))  # 12:30:15 one and a half hours east
    assert scenario.noon == pytest.approx(utc)  # type: ignore[attr-defined]
    assert scenario.spot.norm() == 5.0  # type: ignore[attr-defined]


ALONG = """import osc.standard.all

namespace null use std, stdtypes

scenario along:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    middle: lane with:
        keep(it.anchors == ["1:-3"])
    whole: road with:
        keep(it.anchors == ["1"])
    begin: pose_3d with:
        keep(it.position.x == 90m)
        keep(it.position.y == -8.75m)
    end_: pose_3d with:
        keep(it.position.x == 190m)
        keep(it.position.y == -8.75m)
    way: path = road.create_path([begin, end_], straight_line)

    event on_lane is rise(ego.distance_along_route(middle) >= 120m)
    event on_road is rise(ego.distance_along_route(whole) >= 140m)
    event on_path is rise(ego.distance_along_route(way, from: from_end) <= 30m)

    do parallel:
        ego.drive(duration: 8s) with:
            lane(2, at: start)
            position(100m, at: start)
            speed(10mps)
        wait @on_lane
        wait @on_road
        wait @on_path
"""


def test_distances_along_routes(
    load: Callable[[GeneratedModule], type[Scenario]], tmp_path: Path
) -> None:
    trace = run(load(emit(asam(ALONG, tmp_path))))
    assert trace.status == "success"
    # At 10 m/s from x = s = 100 m, on a lane that begins at s = 0; the path ends at x = 190 m.
    assert trace.event("on_lane") == 2.0
    assert trace.event("on_road") == 4.0
    assert trace.event("on_path") == 6.0


def test_off_the_route_is_an_error(
    load: Callable[[GeneratedModule], type[Scenario]], tmp_path: Path
) -> None:
    scenario = load(emit(asam(ALONG.replace("lane(2", "lane(1"), tmp_path)))
    with pytest.raises(ScenarioError, match="ego: the actor is on lane -4 of road 1, not on lane"):
        run(scenario)


def test_a_route_through_points(
    load: Callable[[GeneratedModule], type[Scenario]], tmp_path: Path
) -> None:
    text = ALONG.replace(
        "    way: path = road.create_path([begin, end_], straight_line)\n",
        "    from_: xyz_point = road.create_xyz_point(90m, -8.75m, 0m)\n"
        '    to_: odr_point = road.create_odr_point("1", "-3", 190m, 0m)\n'
        "    way: compound_route = road.create_route([from_, to_])\n",
    )
    generated = emit(asam(text, tmp_path))
    assert "self.road.create_route([self.from_, self.to_])" in generated.python
    trace = run(load(generated))
    assert trace.event("on_path") == 6.0
