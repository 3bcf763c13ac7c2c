"""What scenarios for ScenarioRunner mean by names: actors, speeds, types without objects."""

from collections.abc import Callable
from pathlib import Path

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
from osc2tx_runtime import RunSettings, Scenario
from tests.end_to_end.harness import run

TEXT = """
struct maths:
    def minus(x: int, y: int) -> int is expression x - y
    def sine(x: float) -> float is external python(module: "math", name: "sin", param: x)

scenario dut.follow:
    do serial:
        npc.drive(duration: 1s) with:
            speed(10mps)
        wait own > 9mps
        first.drive(duration: 3s) with:
            speed(10mps + gain)
    first: vehicle = npc
    own: velocity = "npc_speed"
    gain: speed = 2mps

scenario dut.twice:
    gain: float
    do dut.follow(gain: gain * 4mps)

scenario top:
    path: Path
    path.set_map("highway.xodr")
    npc: Model3
    maths.minus(x: 3, y: 1)
    gain: float = maths.sine(1.5)
    do dut.twice(gain: gain)
"""


def test_names_mean_what_they_mean_there(
    load: Callable[[GeneratedModule], type[Scenario]], tmp_path: Path
) -> None:
    path = tmp_path / "top.osc"
    path.write_text(TEXT, encoding="utf-8")
    compiled = Compilation(path, path.name, CompileOptions("2.1", "carla"))
    assert compiled.ir is not None, compiled.diagnostics
    trace = run(load(emit(compiled.ir)), RunSettings(allow_external=("math.sin",)))
    assert trace.status == "success"
    states = trace.of_kind("state")
    assert len({line["actor"] for line in states}) == 1
    # sin(1.5) is 0.997, so the second drive is 4 m/s faster than 10.
    assert max(line["v"] for line in states) > 13.9
