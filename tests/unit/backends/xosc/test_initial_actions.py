"""Actions that take no time are in `Init` where they begin with the run, and in no event again."""

from pathlib import Path

import pytest

from osc2tx.options import XmlOptions
from osc2tx.xosc import elements as xml
from osc2tx.xosc import read
from tests.unit.backends.xosc.documents import compiled, graded_documents

SCENARIO = """import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego, other: vehicle
    do {composition}:
        serial:
            ego.assign_position(
                odr_point: road.create_odr_point(road_id: "1", lane_id: "-3", s: 50m, t: 0m)
            )
            ego.drive({duration}) with:
                speed(10mps)
        serial:
            other.assign_position(
                odr_point: road.create_odr_point(road_id: "1", lane_id: "-2", s: 60m, t: 0m)
            )
            other.drive({duration}) with:
                speed(20mps)
"""


@pytest.mark.parametrize(
    ("composition", "duration"), [("parallel", "duration: 5s"), ("parallel(duration: 5s)", "")]
)
def test_who_is_put_at_the_start_begins_there(
    composition: str, duration: str, tmp_path: Path
) -> None:
    path = tmp_path / "top.osc"
    path.write_text(SCENARIO.format(composition=composition, duration=duration), encoding="utf-8")
    (found,) = graded_documents(compiled(path), XmlOptions())
    assert found.xml is not None
    board = read(found.xml).one(xml.Storyboard)
    assert sum(1 for _ in board.one(xml.Init).below(xml.TeleportAction)) == 2
    places = sorted(place.s for place in board.one(xml.Init).below(xml.LanePosition))
    assert places == [50.0, 60.0]
    assert not any(True for each in board.all(xml.Story) for _ in each.below(xml.TeleportAction))
