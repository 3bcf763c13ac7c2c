"""Motion that the standard determines: times, places and speeds worked out by hand.

A case in `motion/closed_forms/*.txt` begins with `=== title | options | outcome`; below stand the
members of the scenario. Options are a map and a version of the standard, if they are not
`highway.xodr` and 2.2. An outcome is one of

- `success TIME`, then what actors have at a time (default: the end): `ego@2 s=80 v=15`, the
  events of the run: `events near@0 done@2`, and the modifiers that did not hold: `unmet speed`, or
  `unmet` alone for none,
- `failure` or `refused` by the run, with a part of the reason,
- the codes with which the compiler refuses the scenario.
"""

import json
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
from osc2tx_runtime import RunSettings, Scenario, run_scenario
from osc2tx_runtime.errors import ScenarioError

FOLDER = Path(__file__).parent / "motion" / "closed_forms"
HEAD = """import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "{}")
"""
TOLERANCES = {"s": 0.1, "x": 0.1, "y": 0.1, "v": 0.1, "offset": 0.05, "lane": 0.0, "h": 0.01}
"""How far a state may be off: m, m/s, rad."""


@dataclass(frozen=True)
class Case:
    """One scenario and its outcome."""

    title: str
    map_file: str
    standard: str
    outcome: tuple[str, ...]
    text: str


def cases() -> list[Case]:
    found = []
    for path in sorted(FOLDER.glob("*.txt")):
        for chunk in re.split(r"^=== ", path.read_text(encoding="utf-8"), flags=re.M)[1:]:
            head, _, body = chunk.partition("\n")
            title, options, outcome = (part.strip() for part in head.split("|"))
            words = options.split()
            road = next((word for word in words if word.endswith(".xodr")), "highway.xodr")
            version = next((word for word in words if word != road), "2.2")
            lines = (f"    {line}".rstrip() for line in body.splitlines())
            text = HEAD.format(road) + "\n".join(lines) + "\n"
            expected = tuple(part.strip() for part in outcome.split(";"))
            found.append(Case(f"{path.stem}: {title}", road, version, expected, text))
    return found


CASES = cases()


def check(expected: str, states: list[dict[str, Any]], end: float) -> None:
    """Compare the state of an actor with `ego@2 s=80 v=15`."""
    who, *values = expected.split()
    actor, _, time = who.partition("@")
    at = float(time) if time else end
    (state,) = (s for s in states if s["actor"] == actor and abs(s["t"] - at) < 1e-6)
    for value in values:
        name, _, number = value.partition("=")
        assert state[name] == pytest.approx(float(number), abs=TOLERANCES[name]), (expected, state)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.title)
def test_outcome(
    case: Case, load: Callable[[GeneratedModule], type[Scenario]], tmp_path: Path
) -> None:
    path = tmp_path / "case.osc"
    path.write_text(case.text, encoding="utf-8")
    compilation = Compilation(path, path.name, CompileOptions(standard=case.standard, target="py"))
    verdict, *states = case.outcome
    word, _, rest = verdict.partition(" ")
    if compilation.ir is None or not compilation.is_supported:
        codes = {d.code for d in compilation.diagnostics if d.severity.name == "ERROR"}
        assert " ".join(sorted(codes)) == verdict
        return
    try:
        result = run_scenario(load(emit(compilation.ir)), RunSettings(max_time=60.0))
    except ScenarioError as error:
        assert word == "refused" and rest in error.message, error.message
        return
    assert result.status == word, (result.time, result.reason)
    if word == "success":
        assert result.time == pytest.approx(float(rest), abs=1e-6)
    else:
        assert rest in result.reason
    lines = [json.loads(line) for line in result.trace_lines]
    found = [line for line in lines if line["kind"] == "state"]
    events = [f"{line['name']}@{line['t']:g}" for line in lines if line["kind"] == "event"]
    for expected in states:
        if expected.startswith("events"):
            assert events == expected.split()[1:]
        elif expected.startswith("unmet"):
            unmet = [line["modifier"] for line in lines if line["kind"] == "violation"]
            assert unmet == expected.split()[1:]
        else:
            check(expected, found, result.time)
