"""What does not hold names the line and column of its modifier, not those of the action."""

from __future__ import annotations

import json
import pickle
from pathlib import Path

import pytest

from osc2tx.module_loading import scenarios_of_file
from osc2tx_runtime import RunResult, RunSettings, run_scenario
from osc2tx_runtime.campaigns.executor import reported
from osc2tx_runtime.errors import SourcePlace
from osc2tx_runtime.report.trace_reader import read_run
from osc2tx_runtime.running.main import verdict
from tests.end_to_end.harness import generate

START = """\
import osc.standard.all

namespace null use std, stdtypes

modifier vehicle.calm:
    speed(12mps)

scenario cruise:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle

    do serial:
        ego.drive(duration: 2s) with:
            lane(2, at: start)
            position(50m, at: start)
            speed(10mps)
"""
ACTION = START.count("\n") + 1
"""The line of the action that follows."""


def run(tmp_path: Path, action: str) -> RunResult:
    path = tmp_path / "cruise.osc"
    path.write_text(START + action, encoding="utf-8")
    module = generate(path)
    written = path.with_suffix(".py")
    written.write_text(module.python, encoding="utf-8")
    path.with_suffix(".map.json").write_text(module.source_map, encoding="utf-8")
    with scenarios_of_file(written, "module_under_test") as scenarios:
        return run_scenario(scenarios["cruise"], RunSettings())


def places(result: RunResult) -> set[str]:
    """Where its violations say that they are, with the column."""
    found = set()
    for each in result.violations:
        assert isinstance(each.source, SourcePlace)
        found.add(f"{each.source}:{each.source.column}")
    return found


@pytest.mark.parametrize(
    ("action", "line", "column"),
    [
        ("        ego.drive(duration: 2s) with:\n            speed(20mps)\n", ACTION + 1, 13),
        (
            "        ego.drive(duration: 2s) with:\n"
            "            keep_lane()\n            speed(20mps)\n",
            ACTION + 2,
            13,
        ),
        ("        ego.drive(duration: 2s) with:\n            calm()\n", 6, 5),
        ("        ego.follow_lane(offset: 1m, duration: 2s)\n", ACTION, 9),
    ],
    ids=["first", "second", "own modifier", "action"],
)
def test_a_warning(tmp_path: Path, action: str, line: int, column: int) -> None:
    result = run(tmp_path, action)
    assert places(result) == {f"cruise.osc:{line}:{column}"}
    lines = [json.loads(each) for each in result.trace_lines]
    assert {(e["source"], e["column"]) for e in lines if e["kind"] == "violation"} == {
        (f"cruise.osc:{line}", column)
    }
    (shown,) = read_run(result.trace_lines).as_json()["violations"]
    assert shown["place"] == f"cruise.osc:{line}:{column}"
    (row,) = map(reported, result.violations)
    assert row.startswith(f"OSC811 cruise.osc:{line}:{column}: ")
    printed = [*verdict("cruise", result, "cruise.osc")]
    assert printed[1].startswith(f"  cruise.osc:{line}:{column}: warning[OSC811]: ")


def test_a_failure(tmp_path: Path) -> None:
    """Its line is that of the run; the reason names the action."""
    result = run(
        tmp_path,
        "        ego.drive(duration: 2s) with:\n"
        "            physical_movement(must_be_physical)\n"
        "            speed(12mps)\n",
    )
    place = f"cruise.osc:{ACTION + 2}"
    assert (result.status, result.place) == ("failure", place)
    assert places(result) == {f"{place}:13"}
    assert f" (cruise.osc:{ACTION}) failed at 4.000 s: ego drive: `speed` " in result.reason
    head = next(iter(verdict("cruise", result, "cruise.osc")))
    assert head.startswith(f"{place}:13: error[OSC810]: cruise: failure after ")


def test_a_place_in_another_process() -> None:
    place = pickle.loads(pickle.dumps(SourcePlace("a:b.osc", 12, 5)))
    assert (place, place.column) == ("a:b.osc:12", 5)
