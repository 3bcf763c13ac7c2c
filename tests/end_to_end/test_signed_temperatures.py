"""The sign of a number belongs to the literal: -3celsius is 270.15 K, not minus 276.15 K."""

from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import emit
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
from tests.capabilities.conftest import Load
from tests.capabilities.conftest import load as load  # the fixture
from tests.end_to_end.harness import asam, run

HEAD = """import osc.standard.all

namespace null use std, stdtypes

scenario cold:
    road: map with:
        keep(it.map_file == "highway.xodr")
    env: environment
"""


@pytest.mark.parametrize(
    ("text", "kelvin"),
    [
        ("-3celsius", 270.15),
        ("- 3celsius + 6celsius", 3.0),  # a minus by itself: the difference of two temperatures
        ("-40fahrenheit", 233.15),
        ("3celsius", 276.15),
    ],
)
def test_what_the_world_gets(text: str, kelvin: float, load: Load, tmp_path: Path) -> None:
    scenario = load(emit(asam(f"{HEAD}    do env.air(temperature: {text})\n", tmp_path)))
    (line,) = [each for each in run(scenario).lines if each["kind"] == "environment"]
    assert line["temperature"] == pytest.approx(kelvin)


@pytest.mark.parametrize(("bound", "holds"), [("270K", True), ("271K", False)])
def test_what_constraints_make_of_it(bound: str, holds: bool, tmp_path: Path) -> None:
    path = tmp_path / "case.osc"
    members = f"    t: temperature\n    keep(t == -3celsius)\n    keep(t > {bound})\n"
    path.write_text(f"{HEAD}{members}    do env.air(temperature: t)\n", encoding="utf-8")
    compilation = Compilation(path, path.name, CompileOptions())
    assert (compilation.module is not None) == holds, compilation.diagnostics
