"""Golden files of the stages after the front end.

Each case is a folder with `input.osc` and `expected/`, found by walking.
"""

from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

from osc2tx.compilation.driver import Compilation
from osc2tx.ir.dump import dump_ir
from osc2tx.options import CompileOptions

HERE = Path(__file__).parent
REPOSITORY = HERE.parent.parent
SCENARIOS = sorted((REPOSITORY / "scenarios").glob("*.osc"))
Golden = Callable[[str, Path], None]


def cases(stage: str) -> list[Path]:
    return sorted(path.parent for path in (HERE / stage).rglob("input.osc"))


def case_id(folder: Path) -> str:
    return folder.relative_to(HERE).as_posix()


def options_for(case: Path) -> CompileOptions:
    """Cases whose folder name starts with `carla` use that dialect, `…_2_2` that standard."""
    return CompileOptions(
        standard="2.2" if case.name.endswith("_2_2") else "2.1",
        dialect="carla" if case.name.startswith("carla") else "asam",
    )


@cache
def compile_case(path: Path, options: CompileOptions) -> Compilation:
    compilation = Compilation(path, path.name, options)
    assert compilation.module is not None, compilation.diagnostics
    return compilation


@pytest.mark.parametrize("case", cases("ir"), ids=case_id)
def test_ir(case: Path, golden: Golden) -> None:
    compilation = compile_case(case / "input.osc", options_for(case))
    assert compilation.ir is not None
    golden(dump_ir(compilation.ir), case / "expected" / "ir.txt")


@pytest.mark.parametrize("case", cases("py_trees"), ids=case_id)
def test_py_trees(case: Path, golden: Golden) -> None:
    compilation = compile_case(case / "input.osc", options_for(case))
    assert compilation.module is not None
    golden(compilation.module.python, case / "expected" / f"{compilation.module.stem}.py")


@pytest.mark.parametrize("stage", ["ir", "py_trees"])
def test_there_are_cases(stage: str) -> None:
    assert len(cases(stage)) >= 5
