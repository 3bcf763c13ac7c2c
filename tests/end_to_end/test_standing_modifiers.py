"""Modifiers of all that an actor does: members of actors and scenarios, `with` of compositions."""

from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
from osc2tx_runtime import Scenario
from tests.end_to_end.harness import Trace, asam, run

Load = Callable[[GeneratedModule], type[Scenario]]

HEAD = "import osc.standard.all\n\nnamespace null use std, stdtypes\n\n"
CAST = """
scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    v: {type}
    v.lane(2, at: start)
    v.position(100m, at: start)
"""
TREE = """    do serial:
        v.drive(duration: 1s)
        v.drive(duration: 2s)
"""
OWN = "modifier vehicle.slow:\n    limit: speed\n    speed(limit)\n"


def case(types: str, actor: str, rest: str) -> str:
    """A scenario with declarations in front, an actor of a type, and members behind."""
    return HEAD + types + CAST.format(type=actor) + rest


def speeds(trace: Trace) -> set[float]:
    """The speeds (m/s) at the ends of both actions."""
    return {round(float(trace.state("v", t)["v"]), 6) for t in (1.0, 3.0)}


@pytest.mark.parametrize(
    ("types", "actor", "rest"),
    [
        ("actor bus inherits vehicle:\n    speed(10mps)\n", "bus", TREE),
        (f"{OWN}actor bus inherits vehicle:\n    slow(limit: 10mps)\n", "bus", TREE),
        ("extend vehicle:\n    speed(10mps)\n", "vehicle", TREE),
        (
            "actor bus inherits vehicle:\n    most: speed = 10mps\n    speed(most)\n",
            "bus",
            TREE,
        ),
        (
            "actor bus inherits vehicle(vehicle_category == bus):\n    speed(10mps)\n",
            "bus",
            TREE,
        ),
        (OWN, "vehicle", f"    v.slow(10mps)\n{TREE}"),
        (
            "modifier held:\n    who: vehicle\n    who.speed(10mps)\n",
            "vehicle",
            f"    held(who: v)\n{TREE}",
        ),
        ("", "vehicle", f"{TREE}    with:\n        v.speed(10mps)\n"),
        (OWN, "vehicle", f"{TREE}    with:\n        v.slow(limit: 10mps)\n"),
    ],
)
def test_they_hold_for_every_action(
    load: Load, tmp_path: Path, types: str, actor: str, rest: str
) -> None:
    trace = run(load(emit(asam(case(types, actor, rest), tmp_path))))
    assert trace.status == "success"
    assert speeds(trace) == {10.0}


def test_those_of_a_composition_end_with_it(load: Load, tmp_path: Path) -> None:
    rest = """    do serial:
        serial:
            v.drive(duration: 1s)
        with:
            v.speed(10mps)
        v.change_speed(target: 15mps, duration: 2s)
"""
    trace = run(load(emit(asam(case("", "vehicle", rest), tmp_path))))
    assert trace.status == "success"
    assert speeds(trace) == {10.0, 15.0}


def test_a_range_is_one_value_for_all(load: Load, tmp_path: Path) -> None:
    rest = f"    v.speed([5mps..15mps])\n{TREE}"
    module = asam(case("", "vehicle", rest), tmp_path)
    trace = run(load(emit(module)))
    assert trace.status == "success"
    (speed,) = speeds(trace)
    assert speed == pytest.approx(trace.lines[0]["parameters"]["v.speed"], abs=2e-6)


@pytest.mark.parametrize(
    ("rest", "message"),
    [
        (
            f"    u: vehicle\n{TREE}    with:\n        u.speed(10mps)\n",
            "no action in this composition is modified by `speed`",
        ),
        (
            f"    u: vehicle\n{TREE}    with:\n        u.speed(10mps, at: start)\n",
            "no action surely starts with this composition, to meet `speed`",
        ),
    ],
)
def test_what_modifies_nothing_is_refused(tmp_path: Path, rest: str, message: str) -> None:
    file = tmp_path / "case.osc"
    file.write_text(case("", "vehicle", rest), encoding="utf-8")
    compilation = Compilation(file, "case.osc", CompileOptions())
    assert compilation.module is None
    assert message in [each.message for each in compilation.diagnostics]


def test_a_scenario_that_is_handed_such_an_actor_is_refused(tmp_path: Path) -> None:
    types = """actor bus inherits vehicle:
    speed(10mps)
scenario vehicle.tour:
    do drive(duration: 1s)
"""
    file = tmp_path / "case.osc"
    file.write_text(case(types, "bus", "    do v.tour()\n"), encoding="utf-8")
    compilation = Compilation(file, "case.osc", CompileOptions())
    assert compilation.module is None
    (found,) = [each for each in compilation.diagnostics if each.code == "OSC508"]
    assert found.message == "`speed(10mps)` would modify what `vehicle.tour` does"
    assert found.primary.line == 6
