"""Declared paths, trajectories, points and trailers, from the scenario to the places in the trace.

The scenario is the golden case `paths`. What is expected comes from its numbers alone: straight
lines between its points, and the lanes of the map, whose centres are at y = -5.25, -8.75, -12.25.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx_runtime import Scenario
from tests.end_to_end.harness import Trace, asam, run

CASE = Path(__file__).parents[1] / "golden" / "py_trees" / "paths" / "input.osc"


@pytest.fixture(scope="module")
def trace(
    load: Callable[[GeneratedModule], type[Scenario]], tmp_path_factory: pytest.TempPathFactory
) -> Trace:
    text = CASE.read_text(encoding="utf-8")
    return run(load(emit(asam(text, tmp_path_factory.mktemp("paths")))))


def ends(trace: Trace, name: str) -> list[float]:
    actions = trace.of_kind("action")
    return [line["t"] for line in actions if line["name"] == name and line["status"] == "end"]


def test_a_declared_trajectory_is_replayed_exactly(trace: Trace) -> None:
    assert ends(trace, "other replay_trajectory") == [4.0]
    for t in (1.0, 2.0, 3.0, 4.0):
        state = trace.state("other", t)
        line = (110.0 + 10.0 * t, -8.75 + 1.75 * t / 4.0)  # from begin to aside in 4 s
        assert (state["x"], state["y"]) == pytest.approx(line, abs=1e-6)
        assert state["h"] == pytest.approx(math.atan2(1.75, 40.0), abs=1e-6)


def test_a_declared_path_is_followed(trace: Trace) -> None:
    first = ends(trace, "ego follow_path")[0]
    for t in (3.0, 4.0, first):  # behind the swerve to its start the line is met within 8 cm
        state = trace.state("ego", t)
        on_line = -8.75 + 1.75 * (state["x"] - 110.0) / 40.0
        assert state["y"] == pytest.approx(on_line, abs=0.08)
    assert trace.state("ego", first)["x"] == pytest.approx(150.0, abs=0.6)  # a step is 0.5 m


def test_a_path_on_the_road_network_keeps_to_lanes(trace: Trace) -> None:
    start, end = ends(trace, "ego follow_path")[:2]
    states = [s for s in trace.states("ego") if start <= s["t"] <= end]
    at = {x: min(states, key=lambda s: abs(s["x"] - x)) for x in (195.0, 259.0)}
    assert at[195.0]["y"] == pytest.approx(-8.75, abs=0.05)  # still on the first lane
    assert at[259.0]["y"] == pytest.approx(-5.25, abs=0.05)  # the second point: one lane on
    assert trace.state("ego", end)["x"] == pytest.approx(260.0, abs=0.6)


def test_a_relative_path_starts_where_its_reference_is(trace: Trace) -> None:
    start, end = ends(trace, "ego follow_path")[1:]
    here, there = trace.state("ego", start), trace.state("ego", end)
    assert there["x"] - here["x"] == pytest.approx(40.0, abs=0.6)
    assert there["y"] == pytest.approx(-5.25 + 1.0, abs=0.05)  # 1 m left of the lane's centre


def test_a_drive_along_a_path_made_in_place(trace: Trace) -> None:
    last = trace.states("ego")[-1]
    assert last["x"] == pytest.approx(390.0, abs=0.6)
    assert last["y"] == pytest.approx(-8.75, abs=0.05)


def test_a_trailer_is_towed_until_it_is_let_go(trace: Trace) -> None:
    (let_go,) = ends(trace, "ego disconnect_trailer")

    def gap(t: float) -> float:
        ego, cart = trace.state("ego", t), trace.state("cart", t)
        return math.hypot(ego["x"] - cart["x"], ego["y"] - cart["y"])

    bar = gap(0.0)
    assert bar > 5.0
    for t in (2.0, 7.5, 13.0, let_go - 0.05):  # the bar is stiff; its hinge is not at the axle
        assert gap(t) == pytest.approx(bar, abs=0.1)
    assert gap(let_go + 5.0) > bar + 20.0
    assert trace.state("cart", let_go + 5.0)["v"] == 0.0


def test_distance_to_a_declared_point(trace: Trace) -> None:
    assert trace.event("near_the_corner") == 4.0  # x = 150 m, 250 m before the corner at 400 m
