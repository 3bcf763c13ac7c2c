"""What the language means, in small scenarios: verdict and events, worked out from the standard.

A case in `language/*.txt` begins with `=== title | version | outcome`. The outcome is the verdict
with its time and the events `name@time` of the trace, the codes that refuse the scenario, or the
code of the error that ends the run.
Below stands the file; lines `--- name.osc` begin others that it imports. A file without imports
gets those of `PRELUDE`.
"""

import json
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
from osc2tx_runtime import RunSettings, Scenario, ScenarioError, run_scenario

FOLDER = Path(__file__).parent / "language"
PRELUDE = "import osc.standard.all\nnamespace null use std, stdtypes\n"


@dataclass(frozen=True)
class Case:
    """One scenario and its outcome."""

    title: str
    standard: str
    outcome: str
    files: dict[str, str]


def cases() -> list[Case]:
    found = []
    for path in sorted(FOLDER.glob("*.txt")):
        for chunk in re.split(r"^=== ", path.read_text(encoding="utf-8"), flags=re.M)[1:]:
            head, _, body = chunk.partition("\n")
            title, standard, outcome = (part.strip() for part in head.split("|"))
            main, *others = re.split(r"^--- ", body, flags=re.M)
            files = {name: text for name, _, text in (o.partition("\n") for o in others)}
            main = main if main.startswith("import") else PRELUDE + main
            found.append(
                Case(f"{path.stem}: {title}", standard, outcome, {"case.osc": main, **files})
            )
    return found


CASES = cases()


def test_titles_tell_cases_apart() -> None:
    assert len({case.title for case in CASES}) == len(CASES) > 100


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.title)
def test_outcome(
    case: Case, load: Callable[[GeneratedModule], type[Scenario]], tmp_path: Path
) -> None:
    for name, text in case.files.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text, encoding="utf-8")
    options = CompileOptions(standard=case.standard, target="py")
    compilation = Compilation(tmp_path / "case.osc", "case.osc", options)
    if compilation.ir is None or not compilation.is_supported:
        codes = {d.code for d in compilation.diagnostics if d.severity.name == "ERROR"}
        assert f"refused {' '.join(sorted(codes))}" == case.outcome
        return
    try:
        result = run_scenario(load(emit(compilation.ir)), RunSettings(max_time=20.0))
    except ScenarioError as error:
        assert f"error {error.code}" == case.outcome
        return
    lines = (json.loads(line) for line in result.trace_lines)
    events = [f"{line['name']}@{line['t']:g}" for line in lines if line["kind"] == "event"]
    assert " ".join([result.status, f"{result.time:g}", *events]) == case.outcome
