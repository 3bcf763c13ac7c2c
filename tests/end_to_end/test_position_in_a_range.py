"""A position in a range all the time, beside a speed: the speed moves, the range is a condition."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
from osc2tx_runtime import RunSettings, Scenario, run_scenario

Load = Callable[[GeneratedModule], type[Scenario]]
TEXT = """import osc.standard.all
namespace null use std, stdtypes
scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    npc: vehicle
    do parallel(duration: 5s):
        npc.drive() with:
            position(80m, at: start)
            lane(2)
            speed(10mps)
        ego.drive() with:
            lane(2)
            speed({speed})
            position({place})
"""


def generated(folder: Path, **words: str) -> tuple[GeneratedModule | None, list[str]]:
    """Return the module of a scenario, and the codes of its errors."""
    path = folder / "top.osc"
    path.write_text(TEXT.format(**words), encoding="utf-8")
    options = CompileOptions(standard="2.2", target="py")
    compilation = Compilation(path, "top.osc", options)
    module = emit(compilation.ir) if compilation.ir and compilation.is_supported else None
    return module, [each.code for each in compilation.diagnostics if each.severity.name == "ERROR"]


@pytest.mark.parametrize(("place", "sign"), [("behind", 1.0), ("ahead_of", -1.0)])
def test_it_keeps_its_speed_somewhere_in_the_range(
    load: Load, tmp_path: Path, place: str, sign: float
) -> None:
    words = f"distance_range: [20m..40m], {place}: npc"
    module, _ = generated(tmp_path, speed="10mps", place=words)
    assert module is not None
    scenario = load(module)
    first = set()
    for seed in range(5):
        result = run_scenario(scenario, RunSettings(seed=seed))
        assert (result.status, result.violations) == ("success", ())
        lines = [json.loads(line) for line in result.trace_lines]
        states = [line for line in lines if line["kind"] == "state"]
        ego = {line["t"]: line for line in states if line["actor"] == "ego"}
        npc = {line["t"]: line for line in states if line["actor"] == "npc"}
        gaps = [sign * (npc[t]["x"] - ego[t]["x"]) for t in ego]
        assert len(gaps) > 90 and {line["v"] for line in ego.values()} == {10.0}
        assert gaps == pytest.approx([gaps[0]] * len(gaps), abs=1e-6)  # of equal speeds
        # From the front of one to the rear of the other, or between their reference points.
        assert 20.0 - 1e-6 <= gaps[0] <= 40.0 + 4.6
        first.add(gaps[0])
    assert len(first) == 5


def test_a_range_that_the_speed_leaves_is_told(load: Load, tmp_path: Path) -> None:
    module, _ = generated(tmp_path, speed="20mps", place="distance_range: [20m..40m], behind: npc")
    assert module is not None
    result = run_scenario(load(module), RunSettings())
    (violation,) = result.violations  # 50 m nearer in 5 s, where 20 m are allowed
    assert "position" in str(violation)


@pytest.mark.parametrize(
    ("speed", "place"),
    [
        ("10mps", "30m, behind: npc"),
        ("10mps, at: end", "distance_range: [20m..40m], behind: npc"),
        ("10mps", "distance_range: [20m..40m]"),
    ],
)
def test_a_place_that_moves_the_actor_leaves_no_room(
    tmp_path: Path, speed: str, place: str
) -> None:
    assert generated(tmp_path, speed=speed, place=place)[1] == ["OSC508"]
