"""Phases that are called the same get numbers; fields of the runtime get an underscore."""

from pathlib import Path

from osc2tx.backends.py_trees import emit
from tests.end_to_end.harness import asam

TEXT = """import osc.standard.all

namespace null use std, stdtypes

scenario phases:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    do serial:
        serial:
            ego.drive(duration: 1s)
            wait elapsed(1s)
        serial:
            ego.keep_speed(duration: 1s)
            wait elapsed(1s)
        arguments: serial:
            ego.drive(duration: 1s)
            wait elapsed(1s)
"""


def test_equal_names_are_numbered(tmp_path: Path) -> None:
    python = emit(asam(TEXT, tmp_path)).python
    names = [line.split("(")[0].split()[-1] for line in python.splitlines() if "    def " in line]
    assert names == ["declare", "behavior", "ego_serial", "ego_serial_2", "arguments_"]
