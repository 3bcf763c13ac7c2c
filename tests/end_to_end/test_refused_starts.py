"""What `run` refuses before its first step, `check` finds: the same code, place and message."""

from __future__ import annotations

import io
import re
import sys
from pathlib import Path

import pytest

from tests.own_actions import install
from tests.unit.cli.shell import Shell

HEAD = """import osc.standard.all

namespace null use std, stdtypes

"""
TOP = """scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    npc: vehicle
"""
HERE = """
            lane(2, at: start)
            position(50m, at: start)
            speed(10mps, at: start)"""
EGO = f"ego.drive() with:{HERE}"
POINTS = """    here: pose_3d with:
        keep(it.position.x == {0}m)
        keep(it.position.y == {1}m)
        keep(it.position.z == 0m)
    there: pose_3d with:
        keep(it.position.x == {2}m)
        keep(it.position.y == {3}m)
        keep(it.position.z == 0m)
"""


def both(*actions: str, how: str = "parallel(duration: 3s)") -> str:
    """Return the behavior of a scenario: actions side by side."""
    return f"    do {how}:" + "".join(f"\n        {action}" for action in actions) + "\n"


def beside(npc: str) -> str:
    """Return the same, of ego where it has room, and npc with modifiers."""
    return both(EGO, f"npc.drive() with:\n            {npc}")


CASES = {
    "beyond the road": both("ego.drive() with:\n            position(50km, at: start)"),
    "no such lane": both("ego.drive() with:\n            lane(9, at: start)"),
    "no such lane at the place": both(
        "ego.drive() with:\n            lane(9, at: start)\n            position(50m, at: start)"
    ),
    "two in one place": both(EGO, EGO.replace("ego", "npc")),
    "overlap": beside("position(2m, ahead_of: ego, at: start)\n            lane(same_as: ego)"),
    "before the begin of the road": beside(
        "position(500m, behind: ego, at: start)\n            lane(same_as: ego, at: start)"
    ),
    "beyond the end of the road": beside(
        "position(5km, ahead_of: ego, at: start)\n            lane(same_as: ego, at: start)"
    ),
    "no lane beside": beside(
        "position(0m, ahead_of: ego, at: start)\n"
        "            lane(7, side_of: ego, side: left, at: start)"
    ),
    "each relative to the other": both(
        "ego.drive() with:\n            position(10m, ahead_of: npc, at: start)",
        "npc.drive() with:\n            position(10m, ahead_of: ego, at: start)",
    ),
    "speed beyond what it can": both(
        "ego.drive() with:\n            speed(900kph, at: start)\n            speed(900kph)"
    ),
    "open speed": "    v: speed\n" + both("ego.drive() with:\n            speed(v)"),
    "open length in a place": "    d: length\n"
    + both("ego.drive() with:\n            position(d, at: start)"),
    "open number": "    n: int\n" + both("ego.drive() with:\n            lane(n, at: start)"),
    "open duration": "    t: time\n" + both("ego.drive()", how="parallel(duration: t)"),
    "nothing fits the range": "    d: length with:\n        keep(it in [20km..30km])\n"
    + both("ego.drive() with:\n            position(d, at: start)"),
    "two masters": both(
        "ego.drive() with:\n            speed(3mps)", "ego.drive() with:\n            speed(4mps)"
    ),
    "two masters of the lane": both(
        "ego.change_lane(num_of_lanes: 1, side: left)",
        "ego.change_lane(num_of_lanes: 1, side: right)",
        how="parallel",
    ),
    "two speeds": both("ego.assign_speed(3mps)", "ego.assign_speed(4mps)", how="parallel"),
    "no way in": both(
        f"ego.drive(duration: 2s) with:{HERE}",
        "npc.drive(duration: 2s) with:\n"
        "            position(9m, at: start)\n            lane(2)\n            speed(30mps)",
        how="serial",
    ),
    "enters where another stands": both(
        "ego.drive(duration: 2s) with:\n            lane(2, at: start)\n"
        "            position(50m, at: start)\n            speed(0mps)",
        "npc.drive(duration: 2s) with:\n"
        "            position(50m, at: start)\n            lane(2)\n            speed(3mps)",
        how="serial",
    ),
    "a path of one point": POINTS.format(100, -8.75, 100, -8.75)
    + "    way: path with:\n        keep(it.points == [here, there])\n"
    + both("ego.follow_path(absolute: way)"),
    "times that go back": POINTS.format(100, -8.75, 150, -8.75)
    + "    way: trajectory with:\n        keep(it.points == [here, there])\n"
    "        keep(it.time_stamps == [3s, 1s])\n" + both("ego.follow_trajectory(absolute: way)"),
    "no such road along": "    far: odr_point = "
    'road.create_odr_point(road_id: "77", lane_id: "-1", s: 3m, t: 0m)\n'
    + both("ego.change_position(target_odr: far)"),
    "declared road that the map lacks": "    r: road with:\n        keep(it.length >= 900km)\n"
    + both("ego.drive() with:\n            along(r)"),
    "crossing that the map lacks": "    c: crossing\n"
    + both("ego.drive() with:\n            along(c)"),
    "division by zero": "    var a: float = 1.0 / 0.0\n" + both("ego.drive()"),
    "an end before its begin": POINTS.format(100, -8.75, 150, -8.75)
    + "    way: path with:\n        keep(it.points == [here, there])\n"
    + both("ego.follow_path(absolute: way, start_offset: 30m, end_offset: 30m)"),
}
LINE = re.compile(r"^(\S+:\d+:\d+): (?:error|warning)\[(OSC8\d\d)\]: (.*)$", re.MULTILINE)


@pytest.mark.parametrize("case", CASES)
def test_check_finds_what_run_refuses(shell: Shell, case: str) -> None:
    shell.write("top.osc", HEAD + TOP + CASES[case])
    ran = shell("run", "top.osc")
    refused = LINE.findall(ran.out + ran.err)
    assert len(refused) == 1, ran.out + ran.err
    checked = shell("check", "top.osc")
    assert LINE.findall(checked.err) == refused
    is_open = refused[0][1] == "OSC806"
    assert checked.code == (0 if is_open else 3)


MAP = """<OpenDRIVE><header revMajor="1" revMinor="6"/>
<road name="" length="{length}" id="1" junction="-1">
<planView><geometry s="0" x="0" y="0" hdg="0" length="{length}"><line/></geometry></planView>
<lanes><laneSection s="0"><right><lane id="-1" type="driving" level="false">
<width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane></right></laneSection></lanes></road>
</OpenDRIVE>"""
FAR = (
    HEAD
    + TOP.replace("highway", "own")
    + both(
        "ego.drive() with:\n            lane(1, at: start)\n            position(300m, at: start)"
    )
)


def test_the_answer_is_kept_as_long_as_the_map_is_the_same(shell: Shell) -> None:
    shell.write("top.osc", FAR)
    for length, code in ((200, 3), (200, 3), (500, 0), (200, 3)):
        shell.write("own.xodr", MAP.format(length=length))
        assert shell("check", "top.osc").code == code
    Path("own.xodr").unlink()
    assert "OSC443" in shell("check", "top.osc").err
    shell.write("maps/own.xodr", MAP.format(length=200))
    shell.write("osc2tx.toml", 'map_paths = ["maps"]\n')
    assert "OSC802" in shell("check", "top.osc").err


CYCLES = '[{{"group": "1", "phases": [{{"state": "{state}", "duration": 2}}]}}]'


def test_the_answer_is_kept_as_long_as_the_cycles_are_the_same(shell: Shell) -> None:
    named = '    road.set_traffic_lights_control_file("lights.json")\n'
    top = TOP.replace("highway", "urban_crossing")
    shell.write("top.osc", HEAD + top + named + both("ego.drive()"))
    for state, code in (("go", 0), ("purple", 3), ("purple", 3), ("go", 0)):
        shell.write("lights.json", CYCLES.format(state=state))
        checked = shell("check", "top.osc")
        assert (checked.code, "cannot be read" in checked.err) == (code, code == 3), checked.err


def test_a_build_before_does_not_hide_it(shell: Shell) -> None:
    shell.write("own.xodr", MAP.format(length=200))
    shell.write("top.osc", FAR)
    assert shell("build", "-o", "out", "top.osc").code == 0
    assert shell("check", "top.osc").code == 3


def test_values_of_the_settings_file_count(shell: Shell) -> None:
    shell.write("top.osc", HEAD + TOP + CASES["open speed"])
    assert "OSC806" in shell("check", "top.osc").err
    shell.write("osc2tx.toml", '[scenarios.top.run]\nset = ["v=3mps"]\n')
    assert "OSC8" not in shell("check", "top.osc").err
    shell.write("osc2tx.toml", '[scenarios.top.run]\nset = ["w=3mps"]\n')
    assert "OSC806" in shell("check", "top.osc").err


def test_an_open_value_can_be_meant(shell: Shell) -> None:
    text = HEAD + TOP + CASES["open speed"]
    shell.write("top.osc", text.replace("v: speed", "v: speed  #! allow OSC806: campaigns set it"))
    for _ in range(2):  # the second time from the cache
        assert "OSC" not in shell("check", "--strict", "top.osc").err.replace("OSC433", "")


def test_code_of_the_user_is_not_run(shell: Shell) -> None:
    shell.write("own_code.py", "raise SystemExit('imported')\n")
    own = "    def f() -> speed is external own_code.f()\n    v: speed = f()\n"
    shell.write("top.osc", HEAD + TOP + own + CASES["beyond the road"])
    checked = shell("check", "top.osc")
    assert "OSC8" not in checked.err + checked.out, checked.err


OWN_ACTION = "action vehicle.creep\n\n"


def test_an_action_that_no_package_brings(shell: Shell) -> None:
    shell.write("top.osc", HEAD + OWN_ACTION + TOP + both("ego.creep()"))
    refused = LINE.findall(shell("run", "top.osc").err)
    assert [(place, code) for place, code, _ in refused] == [("top.osc:13:9", "OSC804")]
    checked = shell("check", "top.osc")
    assert (checked.code, LINE.findall(checked.err)) == (0, refused)
    assert "warning[OSC804]" in checked.err  # an installed package mends it
    assert shell("check", "--strict", "top.osc").code == 1


def test_it_is_found_in_a_scenario_that_another_invokes(shell: Shell) -> None:
    own = TOP.replace("top", "inner") + both("ego.creep()")
    outer = TOP + both("inner(road: road, ego: ego, npc: npc)", how="serial")
    shell.write("top.osc", HEAD + OWN_ACTION + own + "\n" + outer)
    refused = LINE.findall(shell("run", "--scenario", "top", "top.osc").err)
    assert [code for _, code, _ in refused] == ["OSC804"]
    assert LINE.findall(shell("check", "top.osc").err) == refused


def test_an_action_that_no_package_brings_can_be_meant(shell: Shell) -> None:
    allowed = both("ego.creep()  #! allow OSC804: installed on the bench")
    shell.write("top.osc", HEAD + OWN_ACTION + TOP + allowed)
    assert "OSC" not in shell("check", "--strict", "top.osc").err.replace("OSC433", "")


def test_where_packages_are_installed_they_decide(
    shell: Shell, tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A check does not load them; the answer is never that of other packages."""
    site = tmp_path_factory.mktemp("site")
    install(site, "raise SystemExit('imported')\n")
    own = TOP.replace("top", "second") + both("ego.creep()")
    shell.write("top.osc", HEAD + OWN_ACTION + TOP + CASES["beyond the road"] + "\n" + own)
    ran = LINE.findall(shell("run", "--scenario", "top", "top.osc").err)
    assert [code for _, code, _ in ran] == ["OSC802"]
    for path, codes in (([], ["OSC802", "OSC804"]), ([str(site)], ["OSC802"])) * 2:
        with monkeypatch.context() as patch:
            patch.setattr(sys, "path", [*path, *sys.path])
            refused = LINE.findall(shell("check", "top.osc").err)
        assert [code for _, code, _ in refused] == codes
        assert ran[0] in refused


def test_invoked_scenarios_do_not_run_alone(shell: Shell) -> None:
    inner = TOP.replace("top", "inner") + "    v: speed\n"
    text = HEAD + inner + CASES["open speed"].partition("\n")[2]
    outer = TOP + both("inner(road: road, ego: ego, npc: npc, v: 3mps)", how="serial")
    shell.write("top.osc", f"{text}\n{outer}")
    checked = shell("check", "top.osc")
    assert checked.code == 0 and "OSC8" not in checked.err, checked.err


def test_standard_input(shell: Shell, monkeypatch: pytest.MonkeyPatch) -> None:
    text = HEAD + TOP + CASES["no such lane"]
    monkeypatch.setattr("sys.stdin", io.TextIOWrapper(io.BytesIO(text.encode())))
    assert "OSC802" in shell("check", "-").err


def test_alternatives_that_start_apart_are_refused(shell: Shell) -> None:
    """Which of them runs is drawn, and an actor has one place at the start."""
    other = EGO.replace("lane(2,", "lane(3,")
    shell.write("top.osc", HEAD + TOP + both(EGO, other, how="one_of(duration: 2s)"))
    for command in ("check", "run"):
        said = shell(command, "top.osc")
        assert said.code == 3
        assert "error[OSC508]: `ego` has another start in another alternative" in said.err
    shell.write("top.osc", HEAD + TOP + both(EGO, EGO, how="one_of(duration: 2s)"))
    assert shell("run", "top.osc").code == 0
