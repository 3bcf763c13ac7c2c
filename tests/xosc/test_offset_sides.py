"""Offsets are to the left of travel in a scenario, and along t of the road in a document.

Both hands of traffic, lanes that lead along the road and against it.
"""

from pathlib import Path

import pytest

from osc2tx.grading.runs import cached_map
from osc2tx.options import XmlOptions
from osc2tx_runtime import RunSettings
from osc2tx_runtime.opendrive import LanePosition
from osc2tx_shared.map_files import SHIPPED
from tests.xosc.case_texts import HEAD, SCENARIO, indented, point
from tests.xosc.parity import FINE, Given, check, is_exact, scenarios

LANES = [("highway", -3), ("highway", 2), ("left_hand", -2), ("left_hand", 2)]
"""Maps with right-hand and left-hand traffic, each with a lane of both directions."""

BODY = """\
ego: vehicle
{there}\
do serial:
    ego.drive(duration: 1s) with:
        position(at_point: there, at: start)
        speed(10mps)
{start}\
    {statement}
    ego.drive(duration: 2s)
"""
STATEMENTS = {
    "lateral": "ego.drive(duration: 4s) with:\n        lateral(distance: 0.5m, at: end)",
    "lateral_right": "ego.drive(duration: 4s) with:\n"
    "        lateral(distance: 0.5m, side: right, at: end)",
    "follow_lane": "ego.follow_lane(offset: 0.4m, duration: 8s)",
    "change_lane": "ego.change_lane(num_of_lanes: 1, side: inside, offset: 0.3m, duration: 3s)",
}


def written(folder: Path, map_name: str, lane: int, statement: str, start: str = "") -> Given:
    """Return a scenario that does something across a lane."""
    road_map = cached_map(SHIPPED / f"{map_name}.xodr")
    at = road_map.pose(LanePosition("1", lane, 300.0))
    there = point("there", round(at.x, 6), round(at.y, 6))
    body = BODY.format(there=there, statement=statement, start=start)
    text = HEAD + SCENARIO.format(name="across", map=map_name, body=indented(body, 1))
    path = folder / "across.osc"
    path.write_text(text, encoding="utf-8")
    return Given(path, RunSettings(dt=FINE), xml=XmlOptions(profile="esmini"))


@pytest.mark.parametrize("statement", STATEMENTS)
@pytest.mark.parametrize(("map_name", "lane"), LANES)
def test_offsets_in_motion(map_name: str, lane: int, statement: str, tmp_path: Path) -> None:
    given = written(tmp_path, map_name, lane, STATEMENTS[statement])
    (document,) = scenarios(given)
    assert is_exact(document), document.report.obstacles
    check(given, document)


@pytest.mark.parametrize(("map_name", "lane"), LANES)
def test_offsets_at_the_start(map_name: str, lane: int, tmp_path: Path) -> None:
    start = "        lateral(distance: 0.5m, at: start)\n        keep_lane()\n"
    given = written(tmp_path, map_name, lane, "ego.drive(duration: 1s)", start)
    (document,) = scenarios(given)
    assert document.xml is not None, document.report.obstacles
    check(given, document)
