"""Two files of which one imports the other, and what their modules have of each other."""

from __future__ import annotations

import ast
import sys
from pathlib import Path

from osc2tx.backends.py_trees.emitter import emit
from osc2tx.building.jobs import compile_all
from osc2tx.compilation.driver import Compilation
from osc2tx.config import GivenOptions
from osc2tx_runtime import RunSettings, Scenario, run_scenario

LIBRARY = """\
import osc.standard

struct limits:
    low: speed = 20kph
    high: speed = 50kph
    def middle() -> speed is expression (it.low + it.high) / 2

# Drives for a while.
scenario approach:
    car: vehicle
    bounds: limits
    pause: time with:
        keep(it in [1s..3s])
    do serial:
        car.drive(duration: 1s) with:
            speed(bounds.middle())
        wait elapsed(pause)
"""

MAIN = """\
import osc.standard
import "LIBRARY"

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    hero: vehicle
    mine: limits with:
        keep(it.low == 30kph)
    do serial:
        approach(car: hero, bounds: mine)
        hero.drive(duration: 1s) with:
            speed(mine.high)
"""


def write(folder: Path, **texts: str) -> None:
    """Write files; `lib__b` is `lib/b.osc`."""
    (folder / "osc2tx.toml").touch()
    for name, text in texts.items():
        path = folder / f"{name.replace('__', '/')}.osc"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def compiled(path: Path) -> Compilation:
    (compilation,) = compile_all([path], GivenOptions())
    assert compilation.module is not None, compilation.diagnostics
    return compilation


def module_of(path: Path) -> str:
    """Return the module of a file."""
    (compilation,) = compile_all([path], GivenOptions())
    assert compilation.has_module and compilation.ir is not None, compilation.diagnostics
    return emit(compilation.ir, compilation.sharing).python


def imports_in(text: str) -> dict[str, list[str]]:
    """Return what a module imports of others than the runtime and the standard library."""
    statements = [each for each in ast.parse(text).body if isinstance(each, ast.ImportFrom)]
    return {
        str(each.module): [alias.name for alias in each.names]
        for each in statements
        if str(each.module).partition(".")[0] not in {"osc2tx_runtime", *sys.stdlib_module_names}
    }


def classes_in(text: str) -> list[str]:
    return [each.name for each in ast.parse(text).body if isinstance(each, ast.ClassDef)]


def trace_of(scenario: type[Scenario]) -> list[str]:
    return list(run_scenario(scenario, RunSettings(seed=3)).trace_lines)
