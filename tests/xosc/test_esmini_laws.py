"""Laws of esmini's own: what is written for it and how that is graded; tests/esmini plays it."""

from dataclasses import replace
from pathlib import Path

import pytest

from osc2tx.backends.py_trees import emit
from osc2tx.backends.xosc import XmlScenario
from osc2tx.compilation.driver import Compilation
from osc2tx.grading import Source, graded
from osc2tx.grading.grading import FORK
from osc2tx.options import CompileOptions, XmlOptions, XmlProfile
from osc2tx.xosc import elements as xml
from osc2tx.xosc import read
from osc2tx.xosc.element import Element
from osc2tx.xosc.player import Evaluator, Reading
from osc2tx_runtime.opendrive import read_map
from osc2tx_shared.map_files import SHIPPED
from tests.xosc.esmini_laws import (
    AFTER_AN_EVEN_CHANGE,
    BESIDE_IN_A_BEND,
    CHANGE_AT_A_FORK,
    FOLLOWS_IN_A_BEND,
    GAP,
    HEADWAY,
    LEFT_IN_A_JUNCTION,
    LOOKS_AT_A_GAP_IN_A_BEND,
    PULLS_OUT_FROM_STANDSTILL,
    PUT_AT_THE_START,
    WAITS_FOR_THE_SAME_INSTANT,
    WALKS_A_RELATIVE_WAY,
)

CURVATURE, WIDTH = 1.0 / 120.0, 3.5  # of the road "curve" between s = 150 m and 270 m


def built(
    folder: Path, text: str, profile: XmlProfile, *, allow_approx: bool = False
) -> XmlScenario:
    path = folder / "it.osc"
    path.write_text(text, encoding="utf-8")
    options = CompileOptions(xml=XmlOptions(profile=profile, allow_approx=allow_approx))
    compilation = Compilation(path, path.name, options)
    assert compilation.check(), compilation.diagnostics
    (found,) = compilation.graded_xml
    return found


def document(folder: Path, text: str, profile: XmlProfile) -> Element:
    found = built(folder, text, profile)
    assert found.xml is not None, [each.reason for each in found.report.losses]
    assert not found.report.losses
    return read(found.xml)


def test_a_start_beside_another_one_in_a_bend_is_a_place_on_the_road(tmp_path: Path) -> None:
    init = document(tmp_path, BESIDE_IN_A_BEND, "esmini").one(xml.Storyboard).one(xml.Init)
    ego, other = init.below(xml.LanePosition)
    assert not list(init.below(xml.RelativeLanePosition))
    assert (ego.laneId, other.laneId) == ("-1", "-2")
    outside = 1.0 + 0.5 * WIDTH * CURVATURE  # both are in the bend, `ego` in the inner lane
    assert other.s - ego.s == pytest.approx(55.0 / outside, abs=0.01)


def test_by_the_standard_it_stays_relative(tmp_path: Path) -> None:
    found = document(tmp_path, BESIDE_IN_A_BEND, "generic")
    (place,) = found.below(xml.RelativeLanePosition)
    assert place.dsLane == 55.0


def test_metres_along_the_road_are_more_on_the_outside(tmp_path: Path) -> None:
    """Both are in the bend: ways along lane and road are as their radii."""
    road_map = read_map(SHIPPED / "curve.xodr")
    root = document(tmp_path, BESIDE_IN_A_BEND, "generic")
    places = []
    for reading in (Reading(), Reading(counts_along_roads=True)):
        evaluator = Evaluator(root, road_map, 0.05, reading=reading)
        ego, other = (evaluator.bodies[name].place for name in ("ego", "other"))
        assert ego is not None and other is not None
        places.append(other.s - ego.s)
    along_lane, along_road = places
    assert along_road == pytest.approx(55.0)
    assert along_lane * (1.0 + 0.5 * WIDTH * CURVATURE) == pytest.approx(55.0, abs=0.01)


def test_after_an_even_change_speeds_are_points(tmp_path: Path) -> None:
    found = document(tmp_path, AFTER_AN_EVEN_CHANGE, "esmini")
    (profile,) = found.below(xml.SpeedProfileAction)
    assert profile.followingMode == "position"
    assert [each.speed for each in profile.below(xml.SpeedProfileEntry)][-1] == 10.0


def test_against_the_traffic_a_fork_is_up_to_esmini(tmp_path: Path) -> None:
    text = CHANGE_AT_A_FORK.replace("-40m", "-140m").replace("side: right", "side: left")
    text = text.replace("duration: 2s", "duration: 12s")
    assert built(tmp_path, text, "generic").xml is not None
    (loss,) = built(tmp_path, text, "esmini").report.losses
    assert loss.reason == FORK  # of the last action with an event


@pytest.mark.parametrize("profile", ["generic", "esmini"])
def test_who_is_put_somewhere_first_begins_there(tmp_path: Path, profile: XmlProfile) -> None:
    found = document(tmp_path, PUT_AT_THE_START, profile)
    (private,) = found.below(xml.Private)
    (place,), (speed,) = private.below(xml.LanePosition), private.below(xml.AbsoluteTargetSpeed)
    assert (place.laneId, place.s, speed.value) == ("2", 350.0, 20.0)
    assert not list(found.one(xml.Storyboard).one(xml.Story).below(xml.PrivateAction))


def test_a_change_of_lane_at_a_fork_is_up_to_esmini(tmp_path: Path) -> None:
    assert built(tmp_path, CHANGE_AT_A_FORK, "generic").xml is not None
    found = built(tmp_path, CHANGE_AT_A_FORK, "esmini")
    assert found.xml is None
    (loss,) = found.report.losses
    assert loss.construct == "action change_lane"
    assert loss.reason == FORK


def test_speeds_are_compared_as_commanded(tmp_path: Path) -> None:
    path = tmp_path / "it.osc"
    path.write_text(PULLS_OUT_FROM_STANDSTILL, encoding="utf-8")
    directions = {}
    for profile in ("generic", "esmini"):
        xml_options = XmlOptions(profile=profile, version="1.3", allow_approx=True)
        options = CompileOptions(xml=xml_options)
        (found,) = Compilation(path, path.name, options).xml
        assert found.xml is not None
        (condition,) = read(found.xml).below(xml.SpeedCondition)
        directions[profile] = condition.direction
    assert directions == {"generic": "longitudinal", "esmini": None}


def test_an_event_is_looked_at_before_what_it_waits_for(tmp_path: Path) -> None:
    found = document(tmp_path, WAITS_FOR_THE_SAME_INSTANT, "esmini")
    groups = [list(group.all(xml.Condition)) for group in found.below(xml.ConditionGroup)]
    edges = [[each.conditionEdge for each in group] for group in groups]
    assert ["rising", "none"] in edges and ["none", "rising"] not in edges


def test_a_document_that_never_ends_is_no_document(tmp_path: Path) -> None:
    """In the order of the standard esmini misses the event, and waits forever."""
    path = tmp_path / "it.osc"
    path.write_text(WAITS_FOR_THE_SAME_INSTANT, encoding="utf-8")
    options = CompileOptions(xml=XmlOptions(profile="esmini"))
    compilation = Compilation(path, path.name, options)
    (found,) = compilation.xml
    (by_the_standard,) = Compilation(path, path.name, CompileOptions()).xml
    assert found.xml is not None and by_the_standard.xml is not None and compilation.ir is not None
    source = Source(compilation.ir, options, tmp_path, lambda: emit(compilation.ir))
    (result,) = graded([replace(found, xml=by_the_standard.xml)], source, compilation.sink)
    assert result.xml is None
    assert "measured: " in str(result.report.losses[0].bound)


@pytest.mark.parametrize("action", ["keep_space_gap", "keep_time_gap"])
def test_gaps_in_a_bend_are_as_far_off_as_measured(action: str, tmp_path: Path) -> None:
    text = FOLLOWS_IN_A_BEND.format(action=action)
    found = built(tmp_path, text, "esmini", allow_approx=True)
    (loss,) = found.report.losses
    assert loss.construct == f"action {action}" and "boxes that turn" in loss.reason
    assert found.report.measured is not None and 0.1 < found.report.measured.place < 5.0
    assert not built(tmp_path, text, "generic").report.losses


@pytest.mark.parametrize("measure", ["time_headway(reference: lead) > 1.2s", GAP, HEADWAY])
def test_gaps_are_counted_along_lanes_but_by_esmini(measure: str, tmp_path: Path) -> None:
    text = LOOKS_AT_A_GAP_IN_A_BEND.format(measure=measure)
    found = document(tmp_path, text, "generic")
    systems = {each.get("coordinateSystem") for each in found.walk()} - {None, "entity"}
    assert systems == {"lane"}
    (loss,) = built(tmp_path, text, "esmini", allow_approx=True).report.losses
    assert loss.reason == "esmini counts along the road, not the lane"


def test_a_way_that_is_left_in_a_junction_is_played(tmp_path: Path) -> None:
    """It is left by a change to the own lane, which is looked for from the place on the way."""
    (loss,) = built(tmp_path, LEFT_IN_A_JUNCTION, "esmini").report.losses
    assert loss.reason == FORK


@pytest.mark.parametrize("end", ["", " " * 12 + "until elapsed(2s)"], ids=["its_end", "cut"])
def test_walkers_are_sent_along_the_lane_by_esmini(end: str, tmp_path: Path) -> None:
    """Where a relative way ends is only known during the run, so that no way leads on."""
    text = WALKS_A_RELATIVE_WAY.replace("END", end)
    found = built(tmp_path, text, "esmini", allow_approx=True)
    assert found.report.measured is not None and found.report.measured.place > 5.0
    uncut = WALKS_A_RELATIVE_WAY.replace("END", "")
    by_the_standard = built(tmp_path, uncut, "generic", allow_approx=True)
    assert by_the_standard.report.measured is not None
    assert by_the_standard.report.measured.place < 0.2
