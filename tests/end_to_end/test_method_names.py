"""Methods of labelled phases are public, those of others private and named by what they hold."""

from __future__ import annotations

import re
from pathlib import Path

from osc2tx.backends.py_trees import emit
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
from osc2tx_runtime import Scenario
from tests.end_to_end.harness import asam

HEAD = """import osc.standard.all

namespace null use std, stdtypes

scenario phases:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    other: vehicle
"""
TEXT = f"""{HEAD}
    do serial:
        serial:
            ego.drive(duration: 1s)
            wait elapsed(1s)
        serial:
            ego.keep_speed(duration: 1s)
            wait elapsed(1s)
        serial:
            ego.keep_speed(duration: 2s)
            wait elapsed(1s)
        parallel:
            ego.drive(duration: 1s)
            first: other.drive(duration: 1s)
        serial:
            wait elapsed(1s)
            wait elapsed(2s)
        arguments: serial:
            ego.drive(duration: 1s)
            wait elapsed(1s)
"""
REPEATED = f"""{HEAD}
    do serial:
        swerve: serial:
            ego.drive(duration: 1s)
        swerve: serial:
            ego.drive(duration: 2s)
        fast: ego.drive(duration: 1s)
        fast: ego.drive(duration: 2s)
"""


def methods(python: str) -> list[str]:
    return re.findall(r"    def (\w+)\(self", python)


def test_what_they_are_called(tmp_path: Path) -> None:
    assert methods(emit(asam(TEXT, tmp_path)).python) == [
        *("declare", "behavior"),
        *("_ego_drive_serial", "_ego_keep_speed_serial", "_ego_keep_speed_serial_2"),
        *("_ego_and_first", "_wait_serial", "arguments_"),
    ]


def test_a_new_branch_renames_no_override(tmp_path: Path) -> None:
    """An override in a subclass stays with its phase, whatever comes before."""
    before = emit(asam(TEXT, tmp_path)).python
    branch = "        serial:\n            other.drive(duration: 1s)\n"
    after = emit(asam(TEXT.replace("do serial:\n", f"do serial:\n{branch}"), tmp_path)).python
    public = [name for name in methods(before) if not name.startswith("_")]
    assert public == [name for name in methods(after) if not name.startswith("_")]
    removed = set(before.splitlines()) - set(after.splitlines())
    assert removed == set()


def test_private_names_hide_nothing_of_the_runtime() -> None:
    """The names of methods have a word of their kind, or two topics."""
    own = [name for name in dir(Scenario) if name.startswith("_")]
    joints = ("_then_", "_and_", "_or_", "_serial", "_parallel", "_one_of")
    assert [name for name in own if any(joint in name for joint in joints)] == []


def test_labels_that_repeat_are_numbered(tmp_path: Path) -> None:
    """Dialect `carla` lets labels repeat; `@swerve.end` means the first one."""
    path = tmp_path / "repeated.osc"
    path.write_text(REPEATED, encoding="utf-8")
    compilation = Compilation(path, path.name, CompileOptions(dialect="carla"))
    assert compilation.ir is not None, compilation.diagnostics
    python = emit(compilation.ir).python
    assert methods(python) == ["declare", "behavior", "swerve", "swerve_2"]
    assert 'self.ego.drive("fast", ' in python
    assert 'self.ego.drive("fast_2", ' in python
