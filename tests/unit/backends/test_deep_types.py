"""The work for types that inherit from each other grows with their lineages, no faster."""

from pathlib import Path

from osc2tx.backends.py_trees.emitter import emit
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
from osc2tx.semantics.declarations.inheritance import MOST_LEVELS
from tests.work import calls

TEXT = """import osc.standard.all
namespace null use std, stdtypes
{structs}struct s{last}

scenario top:
    ego: vehicle
    do ego.drive(duration: 1s)
"""


def work(folder: Path, depth: int) -> int:
    path = folder / f"deep{depth}.osc"
    structs = "".join(f"struct s{i} inherits s{i + 1}\n" for i in range(depth))
    path.write_text(TEXT.format(structs=structs, last=depth), encoding="utf-8")
    module = Compilation(path, path.name, CompileOptions(target="py")).ir
    assert module is not None
    return calls(lambda: emit(module))


def test_long_lineages(tmp_path: Path) -> None:
    work(tmp_path, 3)  # what is loaded with the first module
    assert work(tmp_path, MOST_LEVELS) < 3 * work(tmp_path, MOST_LEVELS // 2)
