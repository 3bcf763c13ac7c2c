"""What neither lowering nor the backend can carry out is refused at its line, all at once."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.compilation.driver import Compilation
from osc2tx.diagnostics import CODES
from osc2tx.diagnostics.render import render_text
from osc2tx.options import CompileOptions

FOLDER = Path(__file__).parents[2] / "golden" / "diagnostics"
CASES = sorted([*FOLDER.glob("lowering_*"), *FOLDER.glob("support_*")])
Golden = Callable[[str, Path], None]


def marks(path: Path) -> set[tuple[int, str]]:
    """Return the codes that comments `#! OSC203` announce, with their lines."""
    return {
        (number, code)
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        for code in re.findall(r"OSC\d{3}", line.partition("#!")[2])
    }


@pytest.mark.parametrize("case", CASES, ids=lambda path: path.name)
def test_refused_at_its_line(case: Path, golden: Golden) -> None:
    path = case / "input.osc"
    compilation = Compilation(path, path.name, CompileOptions())
    assert not compilation.check()
    ours = [d for d in compilation.diagnostics if d.code.startswith("OSC5")]
    assert {(d.primary.line, d.code) for d in ours if d.primary is not None} == marks(path)
    text = "\n".join(render_text(diagnostic) for diagnostic in ours)
    golden(text, case / "expected" / "diagnostics.txt")


def test_every_code_of_the_family_has_a_case() -> None:
    announced = {code for case in CASES for _, code in marks(case / "input.osc")}
    family = {code for code in CODES if code.startswith("OSC5")}
    of_xml = {code for code in family if CODES[code].slug.endswith("in-xml")}
    of_file_names = {code for code in family if CODES[code].slug == "renamed-module"}
    assert family - of_xml - of_file_names == announced


def test_a_struct_of_a_scenario_of_an_actor_is_left_to_the_files_that_invoke_it() -> None:
    text = """import osc.standard.all
namespace lib use std, stdtypes

export *

scenario vehicle.begin:
    at: odr_point

    do assign_position(odr_point: at)
"""
    compilation = Compilation(Path("lib.osc"), "lib.osc", CompileOptions(), text=text)
    assert compilation.module is not None
    assert list(compilation.diagnostics) == []
    other = text.replace("vehicle.begin", "begin").replace("do ", "ego: vehicle\n    do ego.")
    refused = Compilation(Path("lib.osc"), "lib.osc", CompileOptions(), text=other)
    assert refused.module is None
    assert [each.code for each in refused.diagnostics] == ["OSC501"]
