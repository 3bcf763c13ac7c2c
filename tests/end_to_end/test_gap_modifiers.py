"""Modifiers of gap actions: `check` refuses what a run refuses, by the direction of the gap."""

from pathlib import Path

import pytest

from osc2tx.api import compile_file
from osc2tx.testing import run_scenario

SCENARIO = """\
import osc.standard.all

namespace null use std, stdtypes

scenario gaps:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego, npc: vehicle
    do parallel(duration: 3s):
        npc.drive() with:
            lane(2, at: start)
            position(100m, at: start)
            speed(15mps)
        serial:
            ego.drive(duration: 1s) with:
                lane(2, at: start)
                position(60m, at: start)
                speed(15mps)
            ego.{action} with:
                {modifier}
"""
BEHIND = "change_space_gap(target: 20m, direction: behind, reference: npc)"
RIGHT = "change_space_gap(target: 4m, direction: right, reference: npc)"
HEADWAY = "change_time_headway(target: 2s, direction: behind, reference: npc)"
KEPT = "keep_space_gap(reference: npc)"
KEPT_ASIDE = "keep_space_gap(reference: npc, direction: lateral)"
KEPT_HEADWAY = "keep_time_headway(reference: npc)"


def codes(action: str, modifier: str, folder: Path) -> tuple[set[str], Path]:
    path = folder / "gaps.osc"
    path.write_text(SCENARIO.format(action=action, modifier=modifier), encoding="utf-8")
    return {each.code for each in compile_file(path).diagnostics}, path


@pytest.mark.parametrize("action", [BEHIND, HEADWAY, KEPT, KEPT_HEADWAY])
@pytest.mark.parametrize(
    "modifier", ["acceleration(1.5mpss)", "speed(15mps)", "keep_speed()", "speed(15mps, at: start)"]
)
def test_along_the_road_the_speed_is_the_actions(
    action: str, modifier: str, tmp_path: Path
) -> None:
    assert "OSC508" in codes(action, modifier, tmp_path)[0]


@pytest.mark.parametrize("action", [RIGHT, KEPT_ASIDE])
@pytest.mark.parametrize("modifier", ["lane(3)", "keep_lane()", "lateral(distance: 0.2m)"])
def test_across_the_road_the_lane_is_the_actions(
    action: str, modifier: str, tmp_path: Path
) -> None:
    assert "OSC508" in codes(action, modifier, tmp_path)[0]


@pytest.mark.parametrize("action", [RIGHT, KEPT_ASIDE])
def test_the_other_direction_is_free(action: str, tmp_path: Path) -> None:
    assert "OSC508" not in codes(action, "acceleration(1.5mpss)", tmp_path)[0]


@pytest.mark.parametrize("action", [KEPT, KEPT_HEADWAY])
def test_what_check_allows_runs(action: str, tmp_path: Path) -> None:
    found, path = codes(action, "keep_lane()", tmp_path)
    assert "OSC508" not in found
    assert run_scenario(path).status == "success"
