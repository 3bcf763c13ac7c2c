"""Modifiers defined by the user are functions of the module, and imported like classes."""

from __future__ import annotations

import ast
from pathlib import Path

from osc2tx.backends.py_trees.emitter import emit
from osc2tx.building.build import build
from osc2tx.compilation.needed_modules import sibling_modules
from osc2tx.config import GivenOptions
from osc2tx.module_loading import scenarios_of_module
from tests.end_to_end.importing_files import compiled, imports_in, module_of, trace_of, write

MODIFIERS = """\
import osc.standard

namespace null use std, stdtypes

# Slow, in the middle of the lane.
modifier vehicle.calm of vehicle.drive:
    speed: speed
    m: length = 0m
    # as told
    speed(speed)
    lateral(m)

modifier very_calm:
    factor: float = 2.0
    calm(speed: 3mps * factor)
    keep_lane()

modifier random:
    speed([2mps..3mps])

modifier settled:
    v: speed with:
        keep(it == 4mps)
    again(v)

modifier again:
    v: speed
    speed(v)
"""

USER = """\
import osc.standard
import "kinds.osc"

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    other: vehicle
    do serial:
        parallel(duration: 1s):
            ego.drive() with:
                lane(2, at: start)
                position(50m, at: start)
                speed(10mps, at: start)
            other.drive() with:
                lane(1, at: start)
                position(90m, at: start)
                speed(9mps)
        ego.drive(duration: 1s) with:
            calm(8mps)
        ego.drive(duration: 1s) with:
            # quietly
            very_calm()
        ego.drive(duration: 1s) with:
            calm(m: 0.5m, speed: other.speed)
        ego.drive(duration: 1s) with:
            random()
        ego.drive(duration: 1s) with:
            settled()
"""


def calls_in(text: str) -> list[str]:
    """Return the calls of `drive` that last a second, as Python writes them without comments."""
    calls = [node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Call)]
    calls.sort(key=lambda call: (call.lineno, call.col_offset))
    written = [ast.unparse(call) for call in calls if ast.unparse(call.func) == "self.ego.drive"]
    return [call for call in written if call.endswith("duration=1 * s)")]


def test_what_is_applied_is_called(tmp_path: Path) -> None:
    write(tmp_path, a=USER, kinds=MODIFIERS)
    text = module_of(tmp_path / "a.osc")
    assert imports_in(text) == {"kinds": ["calm", "settled", "very_calm"]}
    assert calls_in(text) == [
        "self.ego.drive(*calm(speed_=8 * mps), duration=1 * s)",
        "self.ego.drive(*very_calm(), duration=1 * s)",
        # A value that changes while the action runs is no argument of a function.
        "self.ego.drive(speed(lambda: self.other.speed), lateral(0.5 * m), duration=1 * s)",
        # Each application draws its own value.
        "self.ego.drive(speed(self.ego_drive_random_speed), duration=1 * s)",
        "self.ego.drive(*settled(v=4 * mps), duration=1 * s)",
    ]
    assert text.index("# quietly") < text.index("*very_calm(")


def test_bodies_are_in_terms_of_parameters(tmp_path: Path) -> None:
    """No parameter hides a unit or a modifier that its function speaks of."""
    write(tmp_path, kinds=MODIFIERS)
    text = module_of(tmp_path / "kinds.osc")
    functions = [ast.unparse(f) for f in ast.parse(text).body if isinstance(f, ast.FunctionDef)]
    assert functions == [
        "def calm(*, speed_: Speed, m_: Length=0 * m) -> list[speed | lateral]:\n"
        '    """Modifier `calm`.\n\n    Slow, in the middle of the lane.\n    """\n'
        "    return [speed(speed_), lateral(m_)]",
        "def very_calm(*, factor: float=2.0) -> list[speed | lateral | keep_lane]:\n"
        '    """Modifier `very_calm`."""\n'
        "    return [*calm(speed_=3 * mps * factor), keep_lane()]",
        "def settled(*, v: Speed) -> list[speed]:\n"
        '    """Modifier `settled`."""\n'
        "    return [*again(v=v)]",
        "def again(*, v: Speed) -> list[speed]:\n"
        '    """Modifier `again`."""\n'
        "    return [speed(v)]",
    ]


def test_runs_are_those_of_copies(tmp_path: Path) -> None:
    write(tmp_path, a=USER, kinds=MODIFIERS)
    compilation = compiled(tmp_path / "a.osc")
    assert compilation.ir is not None and compilation.module is not None
    with scenarios_of_module(emit(compilation.ir)) as copies:
        expected = trace_of(copies["top"])
    with scenarios_of_module(compilation.module, sibling_modules(compilation)) as scenarios:
        assert trace_of(scenarios["top"]) == expected
    assert '"status":"success"' in expected[-1]


def test_an_edit_of_a_body_changes_its_function(tmp_path: Path) -> None:
    write(tmp_path, a=USER, kinds=MODIFIERS)
    build([tmp_path], tmp_path / "out", GivenOptions())
    before = {p.name: p.read_text(encoding="utf-8") for p in (tmp_path / "out").glob("*.py")}
    write(tmp_path, kinds=MODIFIERS.replace("lateral(m)", "lateral(m + 0.1m)"))
    build([tmp_path], tmp_path / "out", GivenOptions())
    after = {p.name: p.read_text(encoding="utf-8") for p in (tmp_path / "out").glob("*.py")}
    lines = set(after["kinds.py"].splitlines()) - set(before["kinds.py"].splitlines())
    assert lines == {"        lateral(m_ + 0.1 * m),"}
    # Where it is written out, as a value of it changes, the new body stands.
    lines = set(after["a.py"].splitlines()) - set(before["a.py"].splitlines())
    (line,) = lines
    assert "lateral(0.5 * m + 0.1 * m)" in line


def test_files_that_import_each_other_have_copies(tmp_path: Path) -> None:
    write(tmp_path, a=USER, kinds=f'import "a.osc"\n{MODIFIERS}')
    text = module_of(tmp_path / "a.osc")
    assert imports_in(text) == {}
    functions = [f.name for f in ast.parse(text).body if isinstance(f, ast.FunctionDef)]
    assert functions == ["calm", "very_calm", "again", "settled", "create_root"]
    assert text.count("# A copy from kinds.osc: it imports this file as well\n") == 4


PLACED = """
scenario placed:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    do ego.drive(duration: 1s) with:
        starts(2)

modifier starts of vehicle.drive:
    at_lane: int
    lane(at_lane, at: start)
    position(50m, at: start)
    speed(9mps)
"""


def test_a_function_that_its_file_only_spells_out_is_not_written(tmp_path: Path) -> None:
    """The start of an actor stands in `placement`, so no call of `starts` is left."""
    write(tmp_path, kinds=f"{MODIFIERS}{PLACED}")
    functions = [
        node.name
        for node in ast.parse(module_of(tmp_path / "kinds.osc")).body
        if isinstance(node, ast.FunctionDef)
    ]
    assert functions == ["calm", "very_calm", "settled", "again", "create_root"]
