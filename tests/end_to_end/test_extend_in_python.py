"""The page "Extend a generated scenario in Python", and what happens by hand around modules."""

from __future__ import annotations

import contextlib
import io
import json
import re
import subprocess
import sys
from pathlib import Path

import py_trees
import pytest

from osc2tx_runtime import (
    Behaviour,
    RunSettings,
    Scenario,
    ScenarioError,
    Serial,
    Wait,
    elapsed,
    run_scenario,
)
from osc2tx_runtime.units import kph
from tests.end_to_end.harness import REPOSITORY
from tests.processes import HANGING

PAGE = REPOSITORY / "docs" / "how-to" / "extend-in-python.md"
GENERATED = REPOSITORY / "generated"

BROKEN = """
from cut_in import CutIn
from osc2tx_runtime import Call, Wait, main

class Broken(CutIn):
    def other_cuts_in(self):
        MISTAKE

raise SystemExit(main(Broken))
"""


@pytest.fixture
def cut_in(monkeypatch: pytest.MonkeyPatch) -> type[Scenario]:
    monkeypatch.syspath_prepend(GENERATED)
    from cut_in import CutIn

    return CutIn


def test_the_page_runs(cut_in: type[Scenario]) -> None:
    blocks = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    names: dict[str, object] = {"__name__": "page"}
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        for block in blocks:
            exec(block, names)
    assert said.getvalue().split() == ["success", "success", "90.0"]


def test_an_assigned_parameter_is_what_trace_and_world_have(cut_in: type[Scenario]) -> None:
    class FastEgo(cut_in):  # type: ignore[misc, valid-type]
        def declare(self) -> None:
            super().declare()
            self.v_ego = 90 * kph

    lines = [json.loads(line) for line in run_scenario(FastEgo, RunSettings()).trace_lines]
    assert lines[0]["parameters"]["v_ego"] == 90 * kph
    ego = next(line for line in lines if line.get("actor") == "ego")
    assert ego["v"] == 90 * kph


def test_the_same_of_a_parameter_whose_name_the_base_class_has() -> None:
    class Placed(Scenario):
        def declare(self) -> None:
            self.place_ = self.parameter("place", 3.0)
            self.from_ = self.parameter("from", 4.0)

    class Moved(Placed):
        def declare(self) -> None:
            super().declare()
            self.place_ = 5.0

    assert dict(Moved().parameters) == {"place": 5.0, "from": 4.0}


def test_a_tree_without_a_run_says_what_to_call(cut_in: type[Scenario]) -> None:
    tree = py_trees.trees.BehaviourTree(cut_in().create_tree())
    with pytest.raises(ScenarioError, match=r"call `run_scenario\(TheScenario\)`"):
        tree.setup()
    with pytest.raises(ScenarioError, match=r"call `run_scenario\(TheScenario\)`"):
        py_trees.trees.BehaviourTree(cut_in().create_tree()).root.tick_once()


MISTAKES = {
    "return self.other.drvie()": (4, "error: {script}:7: AttributeError: "),
    "return Wait(1, 2, 3)": (5, "{script}:7: error[OSC801]: `Wait(1, 2, 3)` cannot be computed"),
    "return Wait(lambda: self.other.sped > 3)": (4, "error: {script}:7: AttributeError: "),
    "return Wait(lambda: 1 / 0)": (5, "{script}:7: error[OSC801]: the condition has no value"),
    "return Call(lambda: self.nothing())": (5, "{script}:7: error[OSC801]: call nothing()"),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_mistakes_in_a_subclass_are_those_of_its_file(mistake: str, tmp_path: Path) -> None:
    script = tmp_path / "broken.py"
    script.write_text(BROKEN.replace("MISTAKE", mistake), encoding="utf-8")
    done = subprocess.run(
        [sys.executable, str(script)],
        capture_output=True,
        text=True,
        timeout=HANGING,
        env={"PYTHONPATH": f"{GENERATED}:{REPOSITORY / 'runtime_lib'}"},
    )
    code, message = MISTAKES[mistake]
    assert done.returncode == code
    last = done.stderr.splitlines()[-1]
    assert last.startswith(message.format(script=script)), done.stderr
    assert "bug" not in done.stderr


def test_an_overridden_behavior_may_hold_that_of_the_base(cut_in: type[Scenario]) -> None:
    class Waits(cut_in):  # type: ignore[misc, valid-type]
        name = "waits"

        def behavior(self) -> Behaviour:
            return Serial("first the base", super().behavior(), Wait("then", elapsed(1.0)))

    base, both = (run_scenario(each, RunSettings()) for each in (cut_in, Waits))
    assert (base.status, both.status) == ("success", "success")
    ends = [max(json.loads(x).get("t", 0.0) for x in r.trace_lines) for r in (base, both)]
    assert ends[1] == pytest.approx(ends[0] + 1.0)
