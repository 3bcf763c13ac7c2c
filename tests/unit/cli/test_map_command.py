"""The command `map`, and what runs say of their maps."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pytest
from lxml import etree

import osc2tx_runtime
from tests.runtime.opendrive.small_maps import LANES, map_text, road_text, shape
from tests.unit.cli.shell import Shell

OWN = Path(osc2tx_runtime.__file__).parent / "maps" / "urban_crossing.xodr"
STEP = shape("line", 4.0) + shape("line", 96.0, s=4.0, x=4.0, y=0.25)


def test_what_is_in_a_map(shell: Shell) -> None:
    ended = shell("map", OWN)
    assert ended.code == 0, ended.err
    root = etree.parse(OWN).getroot()
    roads = root.findall("road")
    lines = dict(line.split(": ", 1) for line in ended.out.splitlines() if ": " in line)
    assert lines["urban_crossing"].startswith("OpenDRIVE 1.6, ")
    assert lines["roads"].startswith(f"{len(roads)}, ")
    length = sum(float(road.get("length", "")) for road in roads)
    assert lines["size"].endswith(f"{length / 1000:.3f} km of roads")
    lanes = Counter(e.get("type") for e in root.iter("lane") if e.get("id") != "0")
    assert lines["lanes"] == ", ".join(f"{lanes[kind]} {kind}" for kind in sorted(map(str, lanes)))
    marks = sum(1 for _ in root.iter("roadMark"))
    assert f"  roadMark: {marks}\n" in ended.out
    dynamic = sum(e.get("dynamic") == "yes" for e in root.iter("signal"))
    assert lines["signals"].startswith(f"{dynamic} traffic lights")


def test_what_scenarios_name_of_a_map(shell: Shell) -> None:
    """Ids of roads and lights, and the lanes that `lane(1)`, … are."""
    listed = shell("map", "urban_crossing").out
    assert "  road 1 east: 150.0 m\n    along s: lane(1) is -2, lane(2) is -1\n" in listed
    assert "    against s: lane(1) is 2, lane(2) is 1\n" in listed
    assert "  traffic light 101: road 1, s = 149.0 m, controller 1\n" in listed
    assert "along s: lane(1) is 1, lane(2) is 2\n" in shell("map", "left_hand.xodr").out
    assert "    from s = 300.0 m along s: lane(1) is -2" in shell("map", "merge").out


def test_maps_by_name(shell: Shell, monkeypatch: pytest.MonkeyPatch) -> None:
    """As scenarios name them: in the folders of the settings and of --map-path, and ours."""
    monkeypatch.chdir(shell.folder)
    shell.write("osc2tx.toml", 'map_paths = ["roads"]\n')
    shell.write("roads/step.xodr", map_text(road_text(STEP, 100.0, lanes=LANES)))
    names = shell("map").out.splitlines()
    assert {"step.xodr", "highway.xodr"} <= set(names)
    assert shell("map", "step").out.startswith("step: OpenDRIVE")
    ended = shell("map", "nowhere.xodr")
    assert (ended.code, "`nowhere.xodr` not found in" in ended.err) == (4, True)


@pytest.mark.parametrize("text", ["", "<OpenDRIVE/>", "<OpenSCENARIO/>"])
def test_what_is_no_map(shell: Shell, text: str) -> None:
    shell.write("bad.xodr", text)
    ended = shell("map", "bad.xodr")
    assert (ended.code, ended.out) == (4, "")
    assert ended.err.startswith("osc2tx: error: bad.xodr")


def test_a_run_says_once_what_is_wrong_with_its_map(shell: Shell) -> None:
    shell.write("step.xodr", map_text(road_text(STEP, 120.0, lanes=LANES)))
    path = shell.drive("a.osc")
    text = path.read_text().replace(
        "  ego:", '  m: map with:\n    keep(it.map_file == "step")\n  ego:'
    )
    path.write_text(text)
    listed = shell("map", "step.xodr").out
    assert "`road` 1 has no geometry from s = 100 m to 120 m: a straight line is assumed" in listed
    assert "  lane -1 of road 1 at s = 4.00 m: 0.250 m, 0.0°" in listed
    ended = shell("run", "a.osc", "--map-path", ".")
    assert ended.code == 0, ended.err
    assert ended.out.count("warning: map step: ") == 2
    assert ended.out.count("has no geometry from") == 1
    assert "lanes do not fit together at 2 places, worst lane -1 of road 1" in ended.out
