"""What the user's own Python code returns is of the declared type, or ends the run (§7.3.7.4)."""

import json
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
from osc2tx_runtime import RunSettings, Scenario, ScenarioError, run_scenario

TEXT = """import osc.standard.all

namespace null use std, stdtypes

enum hue: [red_, green_]

scenario top:
    v: vehicle
    event ok
    def f() -> {type} is external python(module: "results_of_test", name: "f")
    do serial:
        wait {condition}
        emit ok
"""


@pytest.mark.parametrize(
    ("type_", "returned", "condition", "outcome"),
    [
        ("int", "4", "f() == 4", "ok"),
        ("float", "4", "f() == 4.0", "ok"),
        ("int", "2.5", "f() != 7", "returns a float, not a int"),
        ("int", "True", "f() != 7", "returns a bool, not a int"),
        ("bool", "1", "f()", "returns a int, not a bool"),
        ("speed", "10.0", "f() == 36kph", "ok"),
        ("hue", "'green_'", "f() == green_", "ok"),
        ("hue", "'pink'", "f() != green_", "returns 'pink', which is not one of red_, green_"),
        ("hue", "1", "f() != green_", "returns 1, which is not one of red_, green_"),
        ("list of int", "[1, 2]", "f() == [1, 2]", "ok"),
        ("list of float", "[1, 2.5]", "f() == [1.0, 2.5]", "ok"),
        ("list of int", "[1, 'a']", "f() != [1, 2]", "returns a str, not a int"),
        ("list of int", "None", "f() != [1, 2]", "returns a NoneType, not a list"),
        ("list of hue", "['red_']", "f() == [red_]", "ok"),
        ("list of hue", "['pink']", "f() != [red_]", "returns 'pink'"),
    ],
)
def test_result(
    type_: str,
    returned: str,
    condition: str,
    outcome: str,
    load: Callable[[GeneratedModule], type[Scenario]],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    code = tmp_path / "results_of_test.py"
    code.write_text(f"def f():\n    return {returned}\n", encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, "results_of_test", raising=False)
    path = tmp_path / "case.osc"
    path.write_text(TEXT.format(type=type_, condition=condition), encoding="utf-8")
    compilation = Compilation(path, "case.osc", CompileOptions(standard="2.2", target="py"))
    assert compilation.ir is not None and compilation.is_supported, compilation.diagnostics
    scenario = load(emit(compilation.ir))
    settings = RunSettings(max_time=1.0, allow_external=("results_of_test.f",))
    if outcome != "ok":
        with pytest.raises(ScenarioError, match=outcome):
            run_scenario(scenario, settings)
        return
    lines = [json.loads(line) for line in run_scenario(scenario, settings).trace_lines]
    assert [line["name"] for line in lines if line["kind"] == "event"] == ["ok"]
