"""What a scenario declares hides nothing that its module has of the runtime or of Python."""

from __future__ import annotations

import ast
import builtins
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import pytest

import osc2tx_runtime
from osc2tx.backends.py_trees.emitter import emit
from osc2tx.backends.py_trees.own_names import PYTHON_NAMES
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
from tests.end_to_end.harness import REPOSITORY

TEXT = """import osc.standard.all
namespace null use std, stdtypes

unit |{unit}| of length is SI(m: 1, factor: 2.0)

modifier |{modifier}| of movable_object.action_for_movable_object:
    v: speed
    speed(v)

action vehicle.|{action}|:
    x: int

struct thing:
    a: list of int = [1, 2]
    def total() -> int is expression a.size()

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    t: thing
    gap: length = 3|{unit}|
    v: speed
    keep(v in [20kph..30kph])
    n: int = 5
    event go
    do serial:
        ego.drive(duration: 200ms) with:
            |{modifier}|(5mps)
        emit go
        wait rise([4, 3].filter(it > (n + 4)).size() == 1)
        wait fall(ego.speed > 3mps)
        wait elapsed(2s)
        ego.|{action}|(x: 3)
"""
OWN = {"unit": "own_unit", "modifier": "own_modifier", "action": "own_action"}
MODULES = [*REPOSITORY.glob("generated/**/*.py"), *REPOSITORY.glob("tests/golden/**/expected/*.py")]


def module_of(folder: Path, **names: str) -> ast.Module:
    path = folder / "a.osc"
    path.write_text(TEXT.format(**{**OWN, **names}), encoding="utf-8")
    compilation = Compilation(path, path.name, CompileOptions("2.2", target="py"))
    assert compilation.has_module and compilation.ir is not None, compilation.diagnostics
    return ast.parse(emit(compilation.ir, compilation.sharing).python)


def defined(tree: ast.Module) -> Iterator[str]:
    """Yield the names that a module gives something to, each as often as it does."""
    for node in tree.body:
        match node:
            case ast.ImportFrom(names=names) | ast.Import(names=names):
                yield from (alias.asname or alias.name for alias in names)
            case ast.FunctionDef(name=name) | ast.ClassDef(name=name):
                yield name
            case ast.Assign(targets=[ast.Name(id=name)]) | ast.AnnAssign(target=ast.Name(id=name)):
                yield name


def read(tree: ast.Module) -> set[str]:
    nodes = (node for node in ast.walk(tree) if isinstance(node, ast.Name))
    return {node.id for node in nodes if isinstance(node.ctx, ast.Load)}


@pytest.mark.slow
@pytest.mark.parametrize("kind", OWN)
def test_own_names_hide_no_other(tmp_path: Path, kind: str) -> None:
    harmless = module_of(tmp_path)
    needed = {*defined(harmless), *read(harmless)} - {*OWN.values(), "self", "it"}
    public = {*osc2tx_runtime.__all__, "create_root", "sys", "pathlib"}
    needed -= {"speed"}  # the modifier would apply itself
    if kind == "unit":  # those of the library cannot be declared again
        needed -= {"kph", "mps", "m", "ms", "s"}
    for name in sorted({*needed, *public}):
        tree = module_of(tmp_path, **{kind: name})
        twice = [each for each, count in Counter(defined(tree)).items() if count > 1]
        assert not twice, name
        assert not {*defined(tree)} & {*dir(builtins)} & read(harmless), name


def test_a_unit_may_have_the_name_of_a_modifier(tmp_path: Path) -> None:
    tree = module_of(tmp_path, unit="own", modifier="own")
    assert {"own", "own_unit"} <= {*defined(tree)}


def test_what_modules_have_of_python_is_known() -> None:
    used: set[str] = set()
    for path in MODULES:
        tree = ast.parse(path.read_bytes())
        used |= read(tree) & {*dir(builtins)}
        for node in tree.body:
            if isinstance(node, ast.ImportFrom) and node.module in ("typing", "dataclasses"):
                used |= {alias.name for alias in node.names}
    assert used - {"__name__", "__file__"} <= PYTHON_NAMES
    assert len(used) > 10
