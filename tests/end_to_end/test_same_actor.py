"""Constraints that say that an actor is another one: two names of a single actor."""

from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
from osc2tx_runtime import Scenario, ScenarioError
from tests.end_to_end.harness import asam, run

Load = Callable[[GeneratedModule], type[Scenario]]

HEAD = "import osc.standard.all\n\nnamespace null use std, stdtypes\n\n"
LEG = """scenario leg:
    first: vehicle
    second: vehicle
    keep(second == first)
    do second.drive(duration: 2s) with:
        speed(10mps)

"""
DEFAULT = LEG.replace("second: vehicle", "second: vehicle = first").replace(
    "    keep(second == first)\n", ""
)
TOP = """scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    ego.lane(2, at: start)
    ego.position(100m, at: start)
"""
DRIVE = """    do who.drive(duration: 2s) with:
        speed(10mps)
"""


@pytest.mark.parametrize(
    "text",
    [
        f"{TOP}    who: vehicle\n    keep(who == ego)\n{DRIVE}",
        f"{TOP}    who: vehicle\n    keep(ego == who)\n{DRIVE}",
        f"{TOP}    who: vehicle with:\n        keep(it == ego)\n{DRIVE}",
        f"{TOP}    mid, who: vehicle\n    keep(mid == ego)\n    keep(who == mid)\n{DRIVE}",
        f"actor bus inherits vehicle:\n    seats: int = 40\n\n"
        f"{TOP.replace('ego: vehicle', 'ego: bus')}    who: bus\n    keep(who == ego)\n{DRIVE}",
        f"{LEG}{TOP}    do leg(first: ego)\n",
        f"{LEG}{TOP}    do leg(first: ego, second: ego)\n",
        f"{DEFAULT}{TOP}    do leg(first: ego, second: ego)\n",
    ],
)
def test_it_is_that_actor(load: Load, tmp_path: Path, text: str) -> None:
    compilation = Compilation(_file(tmp_path, text), "case.osc", CompileOptions())
    assert compilation.analysis is not None
    assert "scenario top: concrete" in [str(each) for each in compilation.analysis.levels]
    trace = run(load(emit(asam(HEAD + text, tmp_path))))
    assert trace.status == "success"
    (header,) = trace.of_kind("header")
    assert set(header["actors"]) == {"ego"}
    start, end = (trace.state("ego", t) for t in (0.0, 2.0))
    assert end["x"] - start["x"] == pytest.approx(2 * 10.0, abs=1e-6)


def test_two_that_are_handed_in_are_checked(load: Load, tmp_path: Path) -> None:
    other = "    npc: vehicle\n    npc.lane(1, at: start)\n    npc.position(9m, at: start)\n"
    text = f"{LEG}{TOP}{other}    do leg(first: ego, second: npc)\n"
    with pytest.raises(ScenarioError, match="`second == first` does not hold"):
        run(load(emit(asam(HEAD + text, tmp_path))))


def test_of_two_equal_actors_the_more_special_one_is_declared(load: Load, tmp_path: Path) -> None:
    text = f"actor bus inherits vehicle\n\n{TOP}    who: bus\n    keep(who == ego)\n{DRIVE}"
    actors = run(load(emit(asam(HEAD + text, tmp_path)))).lines[0]["actors"]
    assert (actors["who"]["kind"], "ego" in actors) == ("bus", False)


def _file(folder: Path, text: str) -> Path:
    file = folder / "case.osc"
    file.write_text(HEAD + text, encoding="utf-8")
    return file
