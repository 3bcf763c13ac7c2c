"""The page docs/how-to/ego.md: its scenario with its driver."""

from __future__ import annotations

import json
import math
import re
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx_runtime import RunResult, RunSettings, Scenario, run_scenario
from osc2tx_runtime.errors import CapabilityError
from tests.end_to_end.harness import asam

PAGE = Path(__file__).parents[2] / "docs/how-to/ego.md"
EGO = {"ego": {"hero": "drivers:LaneKeeper"}}


@pytest.fixture
def follow(
    load: Callable[[GeneratedModule], type[Scenario]],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
) -> type[Scenario]:
    """The scenario of the page; its driver can be imported."""
    blocks = re.findall(r"^```(python)?\n(.*?)^```$", PAGE.read_text(), re.MULTILINE | re.DOTALL)
    (driver,) = [text for language, text in blocks if language]
    module = ModuleType("drivers")
    exec(compile(driver, "drivers.py", "exec"), vars(module))
    monkeypatch.setitem(sys.modules, "drivers", module)
    return load(emit(asam(blocks[0][1], tmp_path)))


def run(follow: type[Scenario], expect: bool = True) -> RunResult:
    return run_scenario(follow, RunSettings(world_options=EGO, expect=expect))


def test_the_driver_of_the_page(follow: type[Scenario]) -> None:
    """It keeps its lane in the curve, and comes to the gap that its model has in closed form."""
    done = run(follow)
    assert done.status == "success", done.reason
    assert not done.collisions
    lines = [json.loads(line) for line in done.trace_lines]
    assert lines[0]["control"] == {"hero": "external", "npc": "exact"}
    states = [line for line in lines if line["kind"] == "state"]
    hero = [line for line in states if line["actor"] == "hero"]
    npc = [line for line in states if line["actor"] == "npc"]
    assert max(abs(line["offset"]) for line in hero) < 0.35
    ends = {e["name"]: e["t"] for e in lines if e["kind"] == "action" and e["status"] == "end"}
    assert ends["hero change_speed"] == next(e["t"] for e in hero if abs(e["v"] - 10.0) <= 0.5)
    length = lines[0]["actors"]["npc"]["length"]
    gap = math.hypot(npc[-1]["x"] - hero[-1]["x"], npc[-1]["y"] - hero[-1]["y"]) - length
    wanted = (2.0 + 1.5 * hero[-1]["v"]) / math.sqrt(1.0 - (hero[-1]["v"] / 14.0) ** 4)
    assert gap == pytest.approx(wanted, rel=0.05)


@pytest.mark.slow
def test_the_same_driver_gives_the_same_trace(follow: type[Scenario]) -> None:
    assert run(follow).trace_lines == run(follow).trace_lines


def test_without_expectations_its_actions_are_errors_with_lines(follow: type[Scenario]) -> None:
    with pytest.raises(CapabilityError) as caught:
        run(follow, expect=False)
    line = 1 + PAGE.read_text().split("# follow.osc")[1].partition("hero.change_speed")[0].count(
        "\n"
    )
    assert f"case.osc:{line}: hero change_speed: hero is under external control" in str(
        caught.value
    )
