"""What breaks a rule of the library is refused in the same words, whatever is to be written."""

from pathlib import Path

import pytest

from osc2tx.compilation.driver import Compilation
from osc2tx.diagnostics import Severity
from osc2tx.options import CompileOptions, Target

HEAD = """import osc.standard.all
namespace null use std, stdtypes
scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    env: environment
    ego, other: vehicle
    walker: person
    first, second: pose_3d with:
        keep(it.position.y == -8.75m)
    keep(first.position.x == 60m)
    keep(second.position.x == 75m)
    way: path with:
        keep(it.points == [first, second])
    do serial:
        ego.drive(duration: 1s) with:
            speed(10mps, at: start)
        {statement}
"""
BROKEN = {
    "ego.change_position(on_road_network: true)": "OSC513",
    "ego.change_speed(14mps, rate_peak: -3mpss)": "OSC513",
    "ego.change_lane(0, left)": "OSC513",
    "ego.follow_path(way, start_offset: -1m)": "OSC513",
    "ego.drive() with:\n            along(way, end_offset: -1m)": "OSC513",
    "ego.drive() with:\n            distance(-20m)": "OSC513",
    "ego.drive() with:\n            lane(0, at: end)": "OSC513",
    "ego.drive(duration: -2s)": "OSC513",
    "ego.drive(duration: 2s) with:\n            lateral(1m, measure_by: closest)": "OSC513",
    "ego.drive(duration: 2s) with:\n            speed(5mps)\n            keep_speed()": "OSC508",
    "ego.drive(duration: 2s) with:\n            distance(5m, at: start)": "OSC509",
    "walker.walk(duration: 2s) with:\n            change_lane(1, left)": "OSC508",
    "wait elapsed(-1s)": "OSC513",
    "env.clouds(10)": "OSC513",
    "env.air(temperature: -5K)": "OSC513",
    "env.air(relative_humidity: 3.0)": "OSC513",
    "env.rain(intensity: -36mmph)": "OSC513",
    "env.wind(speed: -1mps)": "OSC513",
    "env.fog(visual_range: -1m)": "OSC513",
}


def refused(folder: Path, statement: str, target: Target) -> list[tuple[str, str, int]]:
    """Return code, message and place of the errors."""
    text = HEAD.format(statement=statement)
    options = CompileOptions(target=target)
    compilation = Compilation(folder / "top.osc", "top.osc", options, text=text)
    assert not compilation.check()
    errors = [each for each in compilation.diagnostics if each.severity is Severity.ERROR]
    return [(each.code, each.message, each.primary.start) for each in errors if each.primary]


@pytest.mark.parametrize("statement", BROKEN)
def test_each_target_says_the_same(statement: str, tmp_path: Path) -> None:
    found = refused(tmp_path, statement, "all")
    assert found and found[0][0] == BROKEN[statement]
    assert found == refused(tmp_path, statement, "py") == refused(tmp_path, statement, "xosc")
