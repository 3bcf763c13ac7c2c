"""`--spawn` says where an actor starts that the scenario leaves open, as in the embedded world."""

from pathlib import Path

import pytest

from osc2tx.options import XmlOptions
from osc2tx_runtime import RunSettings
from tests.unit.backends.xosc.documents import PLAIN, compiled, documents
from tests.xosc.parity import world

SCENARIO = """import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    there: position_3d with:
        keep(it.x == 90m)
        keep(it.y == -5.25m)
        keep(it.z == 0m)
    do ego.drive(duration: 1s) with:
        {modifier}
        speed(10mps)
"""
TAKEN = "the scenario states where it starts, so --spawn does not apply"


@pytest.mark.parametrize(
    ("modifier", "refused"),
    [
        ("lane(3, at: start)", ""),
        ("position(100m, at: start)", TAKEN),
        ("position(at_point: there, at: start)", TAKEN),
    ],
)
def test_both_refuse_a_second_place(modifier: str, refused: str, tmp_path: Path) -> None:
    path = tmp_path / "top.osc"
    path.write_text(SCENARIO.format(modifier=modifier), encoding="utf-8")
    (document,) = documents(compiled(path), XmlOptions(spawns=("ego=1,-2,50",)))
    assert [each.reason for each in document.report.obstacles] == [refused] * bool(refused)
    settings = RunSettings(dt=0.05, spawn={"ego": ("1", -2, 50.0)})
    if refused:
        with pytest.raises(Exception, match=refused):
            world(path, "top", settings, PLAIN)
    else:
        assert 'laneId="-2"' in (document.xml or "")
        assert world(path, "top", settings, PLAIN).track["ego"][0][1] == pytest.approx(50.0)
