"""Types of a scenario's own that derive from a type of the library, for each that there is."""

from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
from osc2tx.semantics.declarations.library import shared_library
from osc2tx.semantics.symbols import ActorSymbol, StructSymbol
from osc2tx_runtime import RunSettings, Scenario
from osc2tx_runtime.errors import UnsupportedError

TEXT = """import osc.standard.all
namespace own use std, stdtypes

{word} own_kind inherits {base}:
    serial_number: uint

scenario holds_one:
    held: own_kind with:
        keep(it.serial_number == 3)
    ego: vehicle
    do ego.drive(duration: 1s)
"""
SCOPE = shared_library("2.2", "asam", "all").scope
SYMBOLS = [each for group in SCOPE.types.values() for each in group]
BASES = {each.name: each for each in SYMBOLS if isinstance(each, ActorSymbol | StructSymbol)}
INCOMPLETE = {"OSC501"}
"""No object of the type, or one of which too little is said; `held` says nothing of its base."""


@pytest.mark.parametrize("name", sorted(BASES))
def test_derived(
    tmp_path: Path, name: str, load: Callable[[GeneratedModule], type[Scenario]]
) -> None:
    word = "actor" if isinstance(BASES[name], ActorSymbol) else "struct"
    path = tmp_path / "holds_one.osc"
    path.write_text(TEXT.format(word=word, base=name), encoding="utf-8")
    compilation = Compilation(path, path.name, CompileOptions(standard="2.2"))
    if not compilation.check():
        errors = {each.code for each in compilation.diagnostics if each.severity == "error"}
        assert errors <= INCOMPLETE
        return
    assert compilation.ir is not None
    scenario_class = load(emit(compilation.ir))
    if name == "bm_engine":  # what drives is the world's own, not the scenario's
        with pytest.raises(UnsupportedError, match="name one of its models"):
            scenario_class(RunSettings())
        return
    assert vars(scenario_class(RunSettings()))["held"].serial_number == 3


DIALECT = """import osc.standard.all
{extension}
actor own_kind inherits {base}:
    serial_number: int

scenario holds_one:
    road: map with:
        keep(it.map_file == "highway.xodr")
    held: own_kind with:
        keep(it.serial_number == 3)
    do held.drive(duration: 1s)
"""


@pytest.mark.parametrize("base", ["Car", "Century"])
@pytest.mark.parametrize("extension", ["", "\nextend Car:\n    wheels: int = 4\n"])
def test_derived_from_a_type_of_a_dialect(
    tmp_path: Path,
    base: str,
    extension: str,
    load: Callable[[GeneratedModule], type[Scenario]],
) -> None:
    path = tmp_path / "holds_one.osc"
    path.write_text(DIALECT.format(extension=extension, base=base), encoding="utf-8")
    compilation = Compilation(path, path.name, CompileOptions(dialect="carla"))
    assert compilation.check(), compilation.diagnostics
    assert compilation.ir is not None
    held = load(emit(compilation.ir))(RunSettings()).held  # type: ignore[attr-defined]
    named = base if extension else "vehicle"
    assert held.kinds[:2] == ("own_kind", named)
    assert getattr(held, "wheels", None) == (4 if extension else None)
