"""Invocations without labels are numbered down the text: the order of members is nothing."""

from collections.abc import Callable
from pathlib import Path

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
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
    assert permuted.ordered == plain.ordered


ALIKE = """import osc.standard.all

namespace null use std, stdtypes

scenario wander:
    car: vehicle
    pace: speed with:
        keep(it in [5mps..25mps])
    do car.drive(duration: 1s) with:
        speed(pace)

scenario alike:
    road: map with:
        keep(it.map_file == "highway.xodr")
    do parallel:
        wander()
        serial:
            wander()
            wander(duration: 1s)
        wander()
"""


def test_draws_go_by_place(
    load: Callable[[GeneratedModule], type[Scenario]], tmp_path: Path
) -> None:
    """Those that are written alike draw different values, each its own in any order."""
    module = asam(ALIKE, tmp_path)
    plain, permuted = run(load(emit(module))), run(load(permuted_module(module)))
    assert permuted.ordered == plain.ordered
    speeds = {line["actor"]: line["v"] for line in plain.of_kind("state") if line["t"] == 0.5}
    assert len(speeds) == len(set(speeds.values())) >= 3


def test_a_draw_stays_when_members_change_places(
    load: Callable[[GeneratedModule], type[Scenario]], tmp_path: Path
) -> None:
    """What is written stays what it is, wherever it stands in a `parallel`."""
    text = ALIKE.replace("wander(duration: 1s)", "wander()").replace(
        "        wander()\n        serial:\n            wander()\n            wander()\n",
        "        wander(duration: 1s)\n        wander()\n",
    )
    swapped = text.replace(
        "        wander(duration: 1s)\n        wander()\n",
        "        wander()\n        wander(duration: 1s)\n",
    )
    assert text != swapped
    found = []
    for each in (text, swapped):
        trace = run(load(emit(asam(each, tmp_path))))
        found.append(sorted(line["v"] for line in trace.of_kind("state") if line["t"] == 0.5))
    assert found[0] == found[1]
