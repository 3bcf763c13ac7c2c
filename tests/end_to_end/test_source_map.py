"""The module alone decides a run: its source map only adds lines."""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from osc2tx.cli.module_loading import scenarios_of_file
from osc2tx_runtime import RunSettings, Scenario, ScenarioError, run_scenario
from tests.end_to_end.harness import REPOSITORY as ROOT

MODULES = sorted((ROOT / "generated").rglob("*.py"))
LINE = re.compile(r"(?<=\.osc):\d+")


def without_line(place: str) -> str:
    """Drop the line of `cut_in.osc:30`."""
    return LINE.sub("", place)


def traces(path: Path) -> dict[str, list[dict[str, Any]]]:
    with scenarios_of_file(path, "module_under_test") as scenarios:
        return {name: trace(scenario) for name, scenario in sorted(scenarios.items())}


def trace(scenario: type[Scenario]) -> list[dict[str, Any]]:
    """Return the lines of the first seconds of a run, without the numbers of lines in them."""
    try:
        result = run_scenario(scenario, RunSettings(max_time=3.0, seed=7))
    except ScenarioError as error:
        return [{"error": without_line(str(error))}]
    lines = [json.loads(line) for line in result.trace_lines]
    for line in lines:
        for key in ("source", "reason"):
            if key in line:
                line[key] = without_line(line[key])
    return lines


def garbled(path: Path) -> Mapping[str, str]:
    """Return contents of maps: nothing readable, other lines, one of another module."""
    own = json.loads(path.with_suffix(".map.json").read_text(encoding="utf-8"))
    for entry in own["scenarios"].values():
        for key in ("constraints", "placements", "nodes"):
            entry[key] = [1000 - line for line in entry[key]]
        entry["names"] = entry["draws"] = ["x"] * 20
    other = ROOT / "generated" / "follow_leader.map.json"
    return {
        "not JSON": "{",
        "a list": "[1, 2]",
        "other lines": json.dumps(own),
        "of another module": other.read_text(encoding="utf-8"),
    }


@pytest.mark.parametrize("path", MODULES, ids=[path.stem for path in MODULES])
def test_the_map_changes_lines_alone(path: Path, tmp_path: Path) -> None:
    copy = Path(shutil.copy(path, tmp_path))
    sidecar = copy.with_suffix(".map.json")
    expected = traces(path)
    assert traces(copy) == expected, "without a map"
    for what, text in garbled(path).items():
        sidecar.write_text(text, encoding="utf-8")
        assert traces(copy) == expected, what


def test_lines_come_from_the_map() -> None:
    with scenarios_of_file(ROOT / "generated" / "cut_in.py", "cut_in_with_map") as scenarios:
        result = run_scenario(scenarios["cut_in"], RunSettings(max_time=0.1))
    sources = [json.loads(line).get("source", "") for line in result.trace_lines]
    assert any(LINE.search(source) for source in sources)
