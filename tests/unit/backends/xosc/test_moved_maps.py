"""Maps that tools read unlike the world: moved on the globe, or with reversed lanes."""

from pathlib import Path

import pytest

import osc2tx_runtime
from osc2tx.options import CompileOptions, XmlOptions, XmlProfile
from tests.unit.backends.xosc.documents import compiled, documents

MAP = Path(osc2tx_runtime.__file__).parent / "maps" / "highway.xodr"
TEXT = """import osc.standard.all
namespace null use std, stdtypes
scenario top:
    road: map with:
        keep(it.map_file == "moved.xodr")
    ego: vehicle
    do ego.drive(duration: 2s) with:
        lane(1, at: start)
        position(50m, at: start)
        speed(10mps, at: start)
"""


@pytest.mark.parametrize(
    ("offset", "profile", "is_told"),
    [
        ('<offset x="500" y="0" z="0" hdg="0"/>', "esmini", True),
        ('<offset x="500" y="0" z="0" hdg="0"/>', "generic", False),
        ('<offset x="0" y="0" z="0" hdg="0"/>', "esmini", False),
        ("", "esmini", False),
    ],
)
def test_a_tool_that_moves_maps(
    tmp_path: Path, offset: str, profile: XmlProfile, is_told: bool
) -> None:
    text = MAP.read_text(encoding="utf-8")
    assert "</header>" in text
    moved = text.replace("</header>", f"{offset}</header>", 1)
    (tmp_path / "moved.xodr").write_text(moved, encoding="utf-8")
    (tmp_path / "top.osc").write_text(TEXT, encoding="utf-8")
    compilation = compiled(tmp_path / "top.osc", CompileOptions())
    (made,) = documents(compilation, XmlOptions(profile=profile))
    assert made.xml is not None
    assert ("--ignore_odr_offset" in (made.report_json or "")) == is_told


def test_lanes_that_are_driven_against_their_side(tmp_path: Path) -> None:
    text = MAP.read_text(encoding="utf-8")
    lane = '<lane id="-1" '
    assert lane in text
    reversed_ = text.replace(lane, f'{lane}direction="reversed" ')
    (tmp_path / "moved.xodr").write_text(reversed_, encoding="utf-8")
    (tmp_path / "top.osc").write_text(TEXT, encoding="utf-8")
    compilation = compiled(tmp_path / "top.osc", CompileOptions())
    (made,) = documents(compilation, XmlOptions(allow_approx=True))
    assert made.xml is None
    assert "map with reversed lanes" in (made.report_json or "")
