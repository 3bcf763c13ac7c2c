"""`route_type` of the measures (§8.7.3.1), and `lateral` beside oncoming traffic (§8.9.8)."""

import math
from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx_runtime import RunSettings, Scenario
from tests.end_to_end.harness import asam, run

Load = Callable[[GeneratedModule], type[Scenario]]

HEAD = """import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "{map}")
    ego, other: vehicle
"""
# In `curve` an arc of 120 m, banked by 0.05 rad, begins before 160 m; lanes are 3.5 m wide.
MEASURES = """    spot: odr_point = road.create_odr_point("1", "{lane}", 200m, 0m)
    event seen is elapsed(0s)
    var lon: length = sample(ego.distance_to_odr_point(spot, longitudinal, {type}), @seen, 0m)
    var lat: length = sample(ego.distance_to_odr_point(spot, lateral, {type}), @seen, 0m)
    do serial:
        ego.remain_stationary() with:
            lane(1, at: start)
            position(160m, at: start)
            until elapsed(0.5s)
"""


def arc(t: float) -> float:
    """Length beside a metre of the reference line, which turns left."""
    return 1.0 - t * math.cos(0.05) / 120.0


# Lanes -1 and -2 are for driving: the ego is in -2, whose centre line is the axis of its section.
@pytest.mark.parametrize(
    ("kind", "metre"),
    [("on_road", 1.0), ("on_lane", arc(-5.25)), ("on_lane_section", arc(-5.25))],
)
@pytest.mark.parametrize(("lane", "t"), [(-2, -5.25), (-1, -1.75), (1, 1.75), (2, 5.25)])
def test_to_a_point(
    load: Load, tmp_path: Path, kind: str, metre: float, lane: int, t: float
) -> None:
    text = HEAD.format(map="curve.xodr") + MEASURES.format(lane=lane, type=f"route_type: {kind}")
    trace = run(load(emit(asam(text, tmp_path))), RunSettings())
    assert (trace.status, trace.reason) == ("success", "")
    found = {line["name"]: line["value"] for line in trace.of_kind("variable")}
    assert found["lat"] == pytest.approx(t + 5.25, abs=2e-3)
    here = trace.of_kind("state")[0]["s"]
    assert 150.0 < here < 165.0
    assert found["lon"] == pytest.approx((200.0 - here) * metre, abs=2e-3)


LATERAL = """    far: position_3d with:
        keep(it.x == 400m)
        keep(it.y == 1.75m)
        keep(it.z == 0m)
    do parallel(duration: 8s):
        other.drive() with:
            position(at_point: far, project_on_route: false, at: start)
            speed(10mps)
            {motion}
        ego.drive() with:
            lane(3, at: start)
            position(60m, at: start)
            speed(10mps)
            {lateral}
"""
OWN, HALF = 1.9, 0.95  # m: width of a vehicle, and half of it


# It comes the other way in the lane at y = 1.75: its left is towards negative y.
@pytest.mark.parametrize(
    ("lateral", "y"),
    [
        ("lateral(4m, side_of: other, side: left)", 1.75 - 4.0),
        ("lateral(4m, side_of: other, side: left, at: end)", 1.75 - 4.0),
        ("lateral(-4m, side_of: other, side: right)", 1.75 - 4.0),
        ("lateral(4m, side_of: other, side: left, measure_by: right_to_left)", -2.25),
        (
            "lateral(2m, side_of: other, side: left, measure_by: left_to_left)",
            1.75 - HALF - 2.0 - HALF,
        ),
        ("lateral(2m, side_of: other, side: left, measure_by: closest)", 1.75 - OWN - 2.0),
    ],
)
@pytest.mark.parametrize("motion", ["", "lateral(0.4m, side: left, at: end)"])
def test_beside_oncoming_traffic(
    load: Load, tmp_path: Path, lateral: str, y: float, motion: str
) -> None:
    text = HEAD.format(map="highway.xodr") + LATERAL.format(lateral=lateral, motion=motion)
    trace = run(load(emit(asam(text, tmp_path))), RunSettings())
    assert (trace.status, trace.reason) == ("success", "")
    last = [state for state in trace.of_kind("state") if state["actor"] == "ego"][-1]
    moved = -0.4 if motion else 0.0
    assert last["y"] == pytest.approx(y + moved, abs=0.05)
    assert not [line for line in trace.of_kind("violation") if line["actor"] == "ego"]
