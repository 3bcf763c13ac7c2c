"""Capabilities on maps of towns, with bends, junctions and seams, instead of the highway.

Each scenario runs as it is, but for its map and for where its cast starts: abreast and behind one
another as on the highway, from a place of the town on.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import emit
from osc2tx_runtime import RunSettings
from osc2tx_runtime.opendrive import LanePosition, RoadMap, read_map
from tests.capabilities.conftest import Load
from tests.capabilities.kit import CAPABILITIES, Line, Perform, Performance
from tests.end_to_end.harness import asam, run
from tests.runtime.world.motion_scan import scan_lines

TOWNS = {
    "town": ("carla-2020/Town01", LanePosition("8", -1, 230.0)),
    "downtown": ("carla-2020/Town10HD", LanePosition("1", -2, 60.0)),
    "hills": ("carla-2019/Town03", LanePosition("76", 3, 60.0)),
    "motorway": ("carla-2020/Town04", LanePosition("35", -4, 150.0)),
}
ROWS = [
    (name, key)
    for key, names in {
        "town": (
            "C04_duration C13_careful_following C13_time_gap "
            "C19_change_speed C20_acceleration_modifier "
        ),
        "downtown": (
            "C14_gap_in_time C15_headway C21_distance C21_position_modifier "
            "C22_lateral_speeds C24_temporal_modifiers C25_relative_modifiers C31_overlaps "
            "C37_rise "
        ),
        "hills": (
            "C01_action_lifecycle C03_composition C06_speed_control C13_careful_following "
            "C21_distance "
        ),
        "motorway": ("C16_fog C31_parallel C38_fall "),
    }.items()
    for name in names.split()
]

PLACE = re.compile(r" *(lane|position)\(.*at: start\)")

COURSE = math.radians(3.0)
JUMP = 0.05  # m
RATE = 12.0  # m/s^2, what scenarios may ask for


Town = Callable[[str], tuple[Path, RoadMap]]


@pytest.fixture(scope="module")
def town(test_data: Path) -> Town:
    """A map of a town by its path, with the path."""
    read: dict[Path, RoadMap] = {}

    def load(name: str) -> tuple[Path, RoadMap]:
        path = test_data / "maps" / f"{name}.xodr"
        if path not in read:
            read[path] = read_map(path)
        return path, read[path]

    return load


def starts(on_highway: Performance, road_map: RoadMap, base: LanePosition) -> dict[str, object]:
    """Where the cast starts in a town: its vehicles in the same order, as far apart."""
    first = [e for e in on_highway.of_kind("state") if e["t"] == 0.0 and "lane" in e]
    cars = [e for e in first if on_highway.box(e["actor"])["kind"] == "vehicle"]
    behind, right = min(e["s"] for e in cars), min(e["lane"] for e in cars)
    found = {}
    for each in cars:
        place = road_map.advance(base, each["s"] - behind).position
        for _ in range(each["lane"] - right):
            place = road_map.neighbour(place, "left") or place
        found[each["actor"]] = (place.road, place.lane, round(place.s, 3))
    return found


def without_places(text: str) -> str:
    """A scenario that leaves open where its cast starts."""
    lines = [line for line in text.splitlines() if not PLACE.fullmatch(line)]
    kept = []
    for line, after in zip(lines, [*lines[1:], ""], strict=True):
        indents = [len(each) - len(each.lstrip()) for each in (line, after)]
        is_empty = line.endswith(" with:") and indents[1] <= indents[0]
        kept.append(line.removesuffix(" with:") if is_empty else line)
    return "\n".join(kept) + "\n"


def in_town(
    name: str, key: str, town: Town, perform: Perform, load: Load, folder: Path
) -> Performance:
    place, base = TOWNS[key]
    path, road_map = town(place)
    text = (CAPABILITIES / f"{name}.osc").read_text(encoding="utf-8")
    module = asam(without_places(text).replace("highway.xodr", path.name), folder)
    settings = RunSettings(
        max_time=60.0, map_path=(path.parent,), spawn=starts(perform(name), road_map, base)
    )
    return Performance(run(load(emit(module)), settings))


def impossible(done: Performance) -> list[str]:
    """What the scan finds and nobody has named."""
    named: list[str] = done.result.get("warnings", [])
    found = []
    for actor, worst in scan_lines(done.lines).items():
        told = any(each.startswith(f"{actor}: ") and " exceeds the " in each for each in named)
        if worst.jump > JUMP or worst.course > COURSE or worst.along > RATE:
            found.append(f"{actor}: {worst}")
        if worst.across > 9.0 and not told:
            found.append(f"{actor}: {worst}, not named")
    return found


@pytest.mark.slow
@pytest.mark.parametrize(("name", "key"), ROWS)
def test_a_capability_in_a_town(
    name: str, key: str, town: Town, perform: Perform, load: Load, tmp_path: Path
) -> None:
    done = in_town(name, key, town, perform, load, tmp_path)
    assert (done.status, done.result["reason"]) == ("success", "")
    assert impossible(done) == []
    there: list[Line] = [e for e in done.of_kind("state") if "road" in e]
    assert len({e["road"] for e in there}) > 1  # it goes from road to road
