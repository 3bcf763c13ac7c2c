"""The module alone decides a run: its source map only adds lines."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from osc2tx.module_loading import scenarios_of_file
from osc2tx_runtime import RunSettings, Scenario, ScenarioError, run_scenario
from tests.end_to_end.harness import SCENARIOS, generate

FILES = sorted(SCENARIOS.rglob("*.osc"))
TOP = sorted(SCENARIOS.glob("*.osc"))
OTHER = generate(SCENARIOS / "follow_leader.osc").source_map
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
    nodes = [node for line in lines if line["kind"] == "tree" for node in line["nodes"]]
    for line in (*lines, *nodes):
        for key in ("source", "reason"):
            if key in line:
                line[key] = without_line(line[key])
    return lines


def broken_maps(source_map: str) -> Mapping[str, str]:
    """Return contents of maps: nothing readable, other lines, one of another module."""
    own = json.loads(source_map)
    for entry in own["scenarios"].values():
        for key in ("constraints", "placements", "nodes"):
            entry[key] = [[1000 - line, column] for line, column in entry[key]]
        entry["names"] = entry["draws"] = ["x"] * 20
    return {
        "not JSON": "{",
        "a list": "[1, 2]",
        "other lines": json.dumps(own),
        "of another module": OTHER,
    }


@pytest.mark.parametrize(
    "file",
    [
        pytest.param(file, id=file.stem, marks=() if file in TOP else pytest.mark.slow)
        for file in FILES
    ],
)
def test_the_map_changes_lines_alone(file: Path, tmp_path: Path) -> None:
    """All maps of a few scenarios; of the others, the one that may do most harm."""
    module = generate(file)
    path = tmp_path / f"{module.stem}.py"
    path.write_text(module.python, encoding="utf-8")
    expected = traces(path)
    maps = {"its own": module.source_map, **broken_maps(module.source_map)}
    for what, text in maps.items():
        if file in TOP or what == "other lines":
            path.with_suffix(".map.json").write_text(text, encoding="utf-8")
            assert traces(path) == expected, what


def test_lines_come_from_the_map(tmp_path: Path) -> None:
    module = generate(SCENARIOS / "cut_in.osc")
    path = tmp_path / "cut_in.py"
    path.write_text(module.python, encoding="utf-8")
    path.with_suffix(".map.json").write_text(module.source_map, encoding="utf-8")
    with scenarios_of_file(path, "cut_in_with_map") as scenarios:
        result = run_scenario(scenarios["cut_in"], RunSettings(max_time=0.1))
    sources = [json.loads(line).get("source", "") for line in result.trace_lines]
    assert "cut_in.osc:19" in sources
