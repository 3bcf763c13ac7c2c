"""What monitors find in our own scenarios: the table `own_findings.txt`, and nothing else.

A line of the table is `file:line | modifier | at | reason`; the reasons stand in `REASONS`. A
finding without a line is a bug of the planner or of the scenario, and so is a line without its
finding.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule
from osc2tx.compilation.driver import Compilation
from osc2tx.config import ConfigFiles, GivenOptions
from osc2tx.options import CompileOptions
from osc2tx_runtime import RunSettings, Scenario, ScenarioError, run_scenario
from osc2tx_runtime.domain.monitoring.phase import Violation
from tests.end_to_end.harness import REPOSITORY
from tests.golden.test_stages import options_for

FOLDERS = ("scenarios", "tests/golden/ir", "tests/golden/py_trees", "tests/golden/xosc")
FILES = sorted(path for folder in FOLDERS for path in (REPOSITORY / folder).rglob("*.osc"))
TABLE = Path(__file__).with_name("own_findings.txt")

REASONS = {
    "approach": "the phase begins with another value, and changing it takes time: no statement of"
    " `physical_movement`, so physics comes first (8.9.17)",
    "late": "the first action of the actor begins after the run has: it stands until then (ADR 10)",
    "avoids": "`avoid_collisions` holds, which slows the actor down (8.9.18)",
    "stands": "the actor has come to a stop, and a negative acceleration does not reverse it",
    "cut": "an `until` ends the action before its target is reached (8.8.2.2)",
    "path": "the path begins elsewhere, or turns faster than the actor can at its speed (8.8.2.2)",
}
AT_ONCE = ("approach", "late")
"""Reasons of what does not hold from the start of its phase on."""


def read_table() -> dict[str, dict[tuple[str, str, str], str]]:
    """The expected findings: line, modifier and `at`, with the reason, by file."""
    found: dict[str, dict[tuple[str, str, str], str]] = {}
    for entry in TABLE.read_text(encoding="utf-8").splitlines():
        place, modifier, at, reason = entry.split(" | ")
        file, _, line = place.rpartition(":")
        found.setdefault(file, {})[line, modifier, at] = reason
    return found


EXPECTED = read_table()


def settings_of(path: Path) -> CompileOptions:
    if path.is_relative_to(REPOSITORY / "scenarios"):
        return ConfigFiles().for_source(path).options_for(path, GivenOptions())
    return options_for(path.parent)


def name_of(path: Path) -> str:
    return path.relative_to(REPOSITORY).as_posix()


# These end before their first step: what they need is not there, or the error is what they show.
ENDS_BEFORE = {
    "scenarios/hello_world.osc": "a map of CARLA",
    "scenarios/capabilities/C33_custom_action.osc": "a package",
    "scenarios/capabilities/C34_conflict_reported.osc": "two actions of one slot",
    "tests/golden/py_trees/calls/input.osc": "external code",
    "tests/golden/py_trees/constraints/input.osc": "a value",
    "tests/golden/py_trees/names/input.osc": "a map that is not there",
    "tests/golden/py_trees/own_actions/input.osc": "a package",
    "tests/golden/xosc/bound_from_what_is_unknown/input.osc": "a value",
    "tests/golden/xosc/command_of_the_tool/input.osc": "a package",
    "tests/golden/xosc/one_of_by_parameter/input.osc": "two actions of one slot",
    "tests/golden/xosc/own_actions/input.osc": "a package",
}
# These show diagnostics of the XML back end, and have errors.
WITHOUT_MODULE = {
    "tests/golden/xosc/axles_and_looks/input.osc",
    "tests/golden/xosc/place_of_the_box/input.osc",
    "tests/golden/xosc/relation_without_an_argument/input.osc",
    "tests/golden/xosc/road_asked_for/input.osc",
}


@pytest.mark.parametrize("path", FILES, ids=name_of)
def test_findings_are_those_of_the_table(
    path: Path, load: Callable[[GeneratedModule], type[Scenario]]
) -> None:
    compilation = Compilation(path, path.name, settings_of(path))
    if compilation.module is None:
        assert name_of(path) in WITHOUT_MODULE
        return
    try:
        result = run_scenario(load(compilation.module), RunSettings(max_time=60.0))
    except ScenarioError:
        assert name_of(path) in ENDS_BEFORE
        return
    assert name_of(path) not in ENDS_BEFORE
    expected = EXPECTED.get(name_of(path), {})
    found = {key_of(each): each for each in result.violations}
    assert {key: str(each) for key, each in found.items() if key not in expected} == {}
    assert [key for key in expected if key not in found] == []
    assert {each.severity for each in found.values()} <= {"warning"}
    starts = starts_of(result.trace_lines)
    for key, each in found.items():
        begun = max(time for time in starts[each.action] if time <= each.first)
        assert (each.first - begun <= 0.2) or expected[key] not in AT_ONCE, str(each)


def key_of(violation: Violation) -> tuple[str, str, str]:
    return violation.source.rpartition(":")[2], violation.modifier, violation.at


def starts_of(lines: tuple[str, ...]) -> dict[str, list[float]]:
    """The times at which actions start, by their name."""
    found: dict[str, list[float]] = {}
    for line in map(json.loads, lines):
        if line["kind"] == "action" and line["status"] == "start":
            found.setdefault(line["name"], []).append(line["t"])
    return found


def test_every_line_of_the_table_has_a_file_and_a_reason() -> None:
    assert EXPECTED.keys() <= {name_of(path) for path in FILES}
    reasons = {reason for lines in EXPECTED.values() for reason in lines.values()}
    assert reasons == REASONS.keys()
