"""A trace has the first value of a sampled variable, and each one that is not as before."""

from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx_runtime import Scenario
from tests.end_to_end.harness import asam, run

TEXT = """import osc.standard.all

namespace null use std, stdtypes

scenario sampled:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    event tick
    var seen: speed = sample(ego.speed, @tick, 5mps)
    do serial:
        ego.drive(duration: 1s) with:
            lane(2, at: start)
            position(50m, at: start)
            speed(5mps)
        emit tick
        ego.keep_speed(duration: 1s)
        emit tick
        ego.assign_speed(8mps)
        emit tick
        ego.keep_speed(duration: 1s)
        emit tick
        wait elapsed(1s)
"""


def test_only_new_values_are_traced(
    load: Callable[[GeneratedModule], type[Scenario]], tmp_path: Path
) -> None:
    trace = run(load(emit(asam(TEXT, tmp_path))))
    lines = trace.of_kind("variable")
    ticks = [line["t"] for line in trace.of_kind("event") if line["name"] == "tick"]
    assert ticks == [1.0, 2.0, 3.0]  # before and after the assignment: one instant
    assert [line["value"] for line in lines] == pytest.approx([5.0, 8.0])


def test_start_and_end_of_a_scenario_sample(
    load: Callable[[GeneratedModule], type[Scenario]], tmp_path: Path
) -> None:
    """All that happens in it reads the first; the second is there after it."""
    faster = """import osc.standard.all

namespace null use std, stdtypes

scenario vehicle.faster:
    var before: speed = sample(actor.speed, @start)
    var after: speed = sample(actor.speed, @end)
    cover(after, unit: mps)
    do drive(duration: 2s) with:
        speed(before + 5mps, at: end)

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    event told
    do serial:
        ego.drive(duration: 1s) with:
            lane(2, at: start)
            position(100m, at: start)
            speed(10mps)
        more: ego.faster()
        wait more.after == more.before + 5mps
        emit told
"""
    trace = run(load(emit(asam(faster, tmp_path))))
    sampled = [(line["t"], line["name"], line["value"]) for line in trace.of_kind("variable")]
    assert sampled == [(1.0, "more.before", 10.0), (3.0, "more.after", 15.0)]
    assert [(line["t"], line["value"]) for line in trace.of_kind("cover")] == [(3.0, 15.0)]
    assert [(line["t"], line["name"]) for line in trace.of_kind("event")] == [(3.0, "told")]
