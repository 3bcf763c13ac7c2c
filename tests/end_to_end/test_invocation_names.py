"""Invocations without labels are numbered down the text: the order of members is nothing."""

from collections.abc import Callable
from pathlib import Path

from osc2tx.backends.py_trees import emit
from osc2tx.backends.py_trees.emitter import GeneratedModule
from osc2tx_runtime import Scenario
from tests.end_to_end.harness import asam, permuted_module, run

TEXT = """import osc.standard.all

namespace null use std, stdtypes

scenario vehicle.gain_speed:
    by: speed
    event faster
    do serial:
        actor.change_speed(by)
        emit faster

scenario names:
    road: map with:
        keep(it.map_file == "highway.xodr")
    one: vehicle
    other: vehicle
    do parallel:
        one.gain_speed(15mps)
        other.gain_speed(12mps)
"""


def test_names_go_by_place(
    load: Callable[[GeneratedModule], type[Scenario]], tmp_path: Path
) -> None:
    module = asam(TEXT, tmp_path)
    plain, permuted = run(load(emit(module))), run(load(permuted_module(module)))
    assert {line["name"] for line in plain.of_kind("event")} == {
        "gain_speed.faster",
        "gain_speed_2.faster",
    }
    assert permuted.text == plain.text
