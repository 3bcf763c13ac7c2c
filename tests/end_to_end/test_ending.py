"""`emit end` and `emit fail`, and scenarios that are invoked more than once."""

from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx_runtime import Scenario
from tests.end_to_end.harness import asam, permuted_module, run

Load = Callable[[GeneratedModule], type[Scenario]]

HEAD = """import osc.standard.all

namespace null use std, stdtypes
"""
MEMBERS = """
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
"""


@pytest.mark.parametrize(
    ("word", "status", "reason"),
    [
        ("end", "success", ""),
        ("fail", "failure", "emit fail (case.osc:14)"),
    ],
)
def test_a_scenario_says_that_it_is_over(
    load: Load, tmp_path: Path, word: str, status: str, reason: str
) -> None:
    text = f"""{HEAD}
scenario ending:{MEMBERS}
    do parallel:
        ego.drive(duration: 10s)
        serial:
            wait elapsed(1s)
            emit {word}
            wait elapsed(10s)
"""
    module = asam(text, tmp_path)
    trace = run(load(emit(module)))
    assert trace.status == status
    assert trace.lines[-1]["steps"] == 20
    assert reason in trace.lines[-1]["reason"]
    assert trace.action("case.osc:11", "end") == 1.0
    assert run(load(permuted_module(module))).ordered == trace.ordered


def test_as_a_reaction(load: Load, tmp_path: Path) -> None:
    text = f"""{HEAD}
scenario ending:{MEMBERS}
    on ego.speed > 36kph:
        emit fail
    do ego.change_speed(target: 72kph, rate_profile: constant, duration: 4s) with:
        speed(0kph, at: start)
"""
    trace = run(load(emit(asam(text, tmp_path))))
    assert trace.status == "failure"
    assert trace.lines[-1]["steps"] == pytest.approx(41, abs=1)


def test_only_the_invoked_scenario_ends(load: Load, tmp_path: Path) -> None:
    text = f"""{HEAD}
scenario vehicle.step:
    v: speed
    do parallel:
        drive() with:
            speed(v)
        serial:
            wait elapsed(1s)
            emit end

scenario ending:{MEMBERS}
    do serial:
        one: ego.step(v: 10kph)
        two: ego.step(v: 30kph)
"""
    trace = run(load(emit(asam(text, tmp_path))))
    assert trace.status == "success"
    assert trace.lines[-1]["steps"] == 40
    # What holds throughout holds at the start of the run, and is driven to later.
    assert trace.state("ego", 0.0)["v"] == pytest.approx(10 / 3.6)
    assert trace.state("ego", 1.0)["v"] == pytest.approx(10 / 3.6)
    assert 10 / 3.6 < trace.state("ego", 1.5)["v"] < trace.states("ego")[-1]["v"] < 30 / 3.6
