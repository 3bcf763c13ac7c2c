"""Places that the map does not have are losses with a reason."""

from pathlib import Path

from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions

TEXT = """import osc.standard.all
namespace null use std, stdtypes
scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    do ego.assign_position(
        odr_point: road.create_odr_point(road_id: "007", lane_id: "-3", s: 700m, t: 0m))
"""


def test_a_road_that_the_map_does_not_have(tmp_path: Path) -> None:
    path = tmp_path / "top.osc"
    path.write_text(TEXT, encoding="utf-8")
    (scenario,) = Compilation(path, path.name, CompileOptions()).xml
    assert scenario.xml is None
    assert "map highway: there is no road `007`" in (scenario.report_json or "")
