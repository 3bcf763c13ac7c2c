"""Numbers that no world has, and maps that are none: messages, and no internal errors."""

from __future__ import annotations

from pathlib import Path

import pytest

from osc2tx.compilation.driver import Compilation
from osc2tx.module_loading import scenarios_of_module
from osc2tx.options import CompileOptions
from osc2tx_runtime import run_scenario
from osc2tx_runtime.opendrive import RoadMap, read_map
from tests.unit.cli.shell import Shell

HEAD = """import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego, other: vehicle
"""


def source(folder: Path, body: str) -> str:
    place = folder / "top.osc"
    place.write_text(HEAD + body)
    return str(place)


LONG_PARALLEL = """    do parallel(overlap: any, end_to_end: {number}s):
        ego.drive(duration: 2s)
        other.drive(duration: {number}s)
"""
SLOW_CHANGE = """    do ego.change_lane(side: left, duration: {number}s)
"""
FAR_POINT = """    goal: position_3d with:
        keep(it.x == {number}m)
    do ego.change_position(target_xyz: goal, interpolation: straight_line, on_road_network: false)
"""
COMPUTED = """    gap: length
    keep(gap == {number} * other.bounding_box.length)
    do parallel:
        other.drive(duration: 1s)
        ego.drive(duration: 1s) with:
            position(gap, behind: other, at: start)
"""


@pytest.mark.parametrize(
    "number", ["0", "-1", "1e308", "-1e308", "1e-308", "1e15", "9223372036854775808.0"]
)
@pytest.mark.parametrize("body", [LONG_PARALLEL, SLOW_CHANGE, FAR_POINT, COMPUTED])
def test_extreme_numbers_are_no_internal_errors(
    shell: Shell, tmp_path: Path, body: str, number: str
) -> None:
    file = source(tmp_path, body.format(number=number))
    for words in (
        ("check", file),
        ("build", file, "-o", str(tmp_path / "out")),
        ("run", file, "--max-time", "4"),
    ):
        ended = shell(*words)
        assert ended.code != 70 and "Traceback" not in ended.err, (words, ended.err)
        if "e308" in number and body is not COMPUTED:
            assert (ended.code, "OSC516" in ended.err + ended.out) == (3, True)


OPEN = """    v: speed with:
        keep(it in [5mps..20mps])
    do ego.drive(duration: 1s) with:
        speed(v)
"""
BEHIND = """    do ego.drive(duration: 1s) with:
        position(20m, behind: {reference}, at: start)
"""


def test_a_map_that_cannot_be_read_is_told_in_the_report(shell: Shell, tmp_path: Path) -> None:
    """Also where a parameter is open: the module is written, the document is not."""
    (tmp_path / "highway.xodr").write_text("<OpenDRIVE/>")
    file, out = source(tmp_path, OPEN), tmp_path / "out"
    ended = shell("build", file, "-o", str(out), "--map-path", str(tmp_path / "highway.xodr"))
    assert ended.code == 0
    assert {path.name for path in out.glob("*.py")} == {"top.py"}
    assert not list(out.glob("*.xosc"))


@pytest.mark.parametrize("reference", ["actor", "it.actor", "ego"])
def test_an_actor_that_is_its_own_reference(shell: Shell, tmp_path: Path, reference: str) -> None:
    file = source(tmp_path, BEHIND.format(reference=reference))
    assert shell("build", file, "-o", str(tmp_path / "out")).code == 0
    ended = shell("run", file)
    assert ended.code in (3, 5)
    assert "depend on each other" in ended.err


def test_a_method_that_calls_itself_without_an_end(shell: Shell, tmp_path: Path) -> None:
    """The run ends with the line of the value, not with the recursion limit of Python."""
    method = "struct steps:\n    def after(n: int) -> int is expression after(n + 1)\n\n"
    body = "    step: steps\n    last: int = step.after(1)\n    do ego.drive(duration: 1s)\n"
    place = tmp_path / "top.osc"
    place.write_text(HEAD.replace("scenario top:", f"{method}scenario top:") + body)
    ended = shell("run", str(place))
    assert ended.code == 5
    line = place.read_text(encoding="utf-8").split("\n").index("    last: int = step.after(1)") + 1
    assert f"top.osc:{line}:5: error[OSC801]: " in ended.err
    assert "a method calls itself without an end" in ended.err


TWICE = (
    "    def doubled(n: int) -> int is expression n <= 0 ? 1 : doubled(n - 1) + doubled(n - 1)\n"
)
LEVELS = "    def level_0(n: int) -> int is expression n\n" + "".join(
    f"    def level_{k + 1}(n: int) -> int is expression level_{k}(n) + level_{k}(n)\n"
    for k in range(30)
)


@pytest.mark.parametrize("kind", ["struct steps", "scenario"])
@pytest.mark.parametrize(("methods", "call"), [(TWICE, "doubled(30)"), (LEVELS, "level_30(1)")])
def test_methods_that_multiply_their_calls(
    shell: Shell, tmp_path: Path, methods: str, call: str, kind: str
) -> None:
    """Whether they are of an object or of the scenario."""
    if kind == "scenario":
        text = HEAD + methods + f"    last: int = {call}\n    do ego.drive(duration: 1s)\n"
    else:
        text = HEAD.replace("scenario top:", f"{kind}:\n{methods}\nscenario top:")
        text += f"    step: steps\n    last: int = step.{call}\n    do ego.drive(duration: 1s)\n"
    place = tmp_path / "top.osc"
    place.write_text(text)
    ended = shell("run", str(place))
    assert ended.code == 5
    line = next(n for n, each in enumerate(text.split("\n"), 1) if "last: int" in each)
    assert f"top.osc:{line}:5: error[OSC801]: method `" in ended.err
    assert "leads to more than 100,000 calls for one value" in ended.err


BEYOND = """    v: speed with:
        keep(it in [5mps..20mps])
    do serial:
        ego.drive(duration: 1s) with:
            lane(1, at: start)
            position(20m, at: start)
            speed(v)
        ego.change_lane(num_of_lanes: 9, side: right)
"""


def test_other_draws_of_a_run_read_the_map_once(tmp_path: Path) -> None:
    compilation = Compilation(Path(source(tmp_path, BEYOND)), "top.osc", CompileOptions())
    module = compilation.module
    assert module is not None
    read: list[Path] = []

    def read_and_count(path: Path) -> RoadMap:
        read.append(path)
        return read_map(path)

    with scenarios_of_module(module) as scenarios:
        result = run_scenario(scenarios["top"], read=read_and_count)
    assert (result.status, len(read)) == ("failure", 1)
