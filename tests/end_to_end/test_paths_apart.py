"""Paths of the dialect `carla` that begin or end elsewhere than each other."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
from osc2tx_runtime import Scenario
from tests.end_to_end.harness import run

Load = Callable[[GeneratedModule], type[Scenario]]

APART = """import basic.osc

scenario top:
    first: Path
    second: Path
    first.set_map("urban_crossing")
    second.DIFFERENCE(first)
    npc: Model3
    ego_vehicle: Rubicon

    do parallel(duration: 1s):
        npc.drive(first) with:
            speed(30kph)
        ego_vehicle.drive(second) with:
            speed(30kph)
"""


@pytest.mark.parametrize("difference", ["path_different_dest", "path_different_origin"])
def test_two_cars_on_paths_apart(load: Load, tmp_path: Path, difference: str) -> None:
    """On the arms of a crossing: a lane section that ends elsewhere also begins elsewhere."""
    source = tmp_path / "case.osc"
    source.write_text(APART.replace("DIFFERENCE", difference), encoding="utf-8")
    compilation = Compilation(source, source.name, CompileOptions(dialect="carla"))
    assert compilation.ir is not None, compilation.diagnostics
    module = emit(compilation.ir)
    assert f"{difference.removeprefix('path_')}=self.first" in module.python
    trace = run(load(module))
    assert trace.status == "success"
    one, other = trace.state("npc", 0.0), trace.state("ego_vehicle", 0.0)
    assert math.cos(one["h"] - other["h"]) < 0.5 or one["road"] != other["road"]
