"""Crosswalks of OpenDRIVE files, against their elements read by themselves."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import pytest
from lxml import etree

from osc2tx_runtime.opendrive import MapError, RoadMap
from tests.runtime.opendrive.small_maps import make_map, road_text, shape

OUTLINE = "<outlines><outline>{}</outline></outlines>"


def crosswalk_map(attributes: str, outline: str = "") -> RoadMap:
    """A road of 100 m along x with one object."""
    text = road_text(shape("line", 100.0), 100.0)
    found = f'<objects><object type="crosswalk" id="7" {attributes}>{outline}</object></objects>'
    return make_map(text.replace("</road>", f"{found}</road>"))


@pytest.mark.parametrize("turn", [0.0, 0.5 * math.pi, math.pi, -0.5 * math.pi])
def test_people_cross_the_road_however_the_box_is_turned(turn: float) -> None:
    """The longer side of the box lies across the road, whatever the file calls it."""
    sizes = 'length="3" width="8"' if abs(math.sin(turn)) < 0.5 else 'length="8" width="3"'
    (found,) = crosswalk_map(f's="40" t="0.5" hdg="{turn}" {sizes}').crosswalks()
    assert (found.x, found.y) == pytest.approx((40.0, 0.5))
    assert (found.length, found.width) == pytest.approx((8.0, 3.0))
    assert found.heading == pytest.approx(0.5 * math.pi)
    assert (found.id, found.road, found.s) == ("7", "1", 40.0)


def test_an_outline_says_more_than_the_box() -> None:
    corners = "".join(
        f'<cornerRoad s="{s}" t="{t}"/>' for s, t in ((20, -4), (23, -4), (23, 6), (20, 6))
    )
    (found,) = crosswalk_map(
        's="1" t="0" length="1" width="1"', OUTLINE.format(corners)
    ).crosswalks()
    assert (found.x, found.y, found.length, found.width) == pytest.approx((21.5, 1.0, 10.0, 3.0))
    local = "".join(
        f'<cornerLocal u="{u}" v="{v}"/>' for u, v in ((-5, -1), (5, -1), (5, 1), (-5, 1))
    )
    (found,) = crosswalk_map(
        's="30" t="0" hdg="1.570796326794897"', OUTLINE.format(local)
    ).crosswalks()
    assert (found.x, found.y, found.length, found.width) == pytest.approx((30.0, 0.0, 10.0, 2.0))


def test_a_crosswalk_without_extent() -> None:
    with pytest.raises(MapError, match="crosswalk without extent"):
        crosswalk_map('s="30" t="0"')


def test_other_objects_are_none(own: Callable[[str], RoadMap]) -> None:
    assert own("highway").crosswalks() == ()
    (found,) = own("crossing").crosswalks()
    assert (found.id, found.subtype, found.s, found.length, found.width) == (
        "100", "zebra", 250.0, 7.0, 4.0,
    )  # fmt: skip


@pytest.mark.parametrize("town", ["Town04", "Town06", "Town10HD"])
def test_crosswalks_of_towns(maps_folder: Path, load: Callable[[str], RoadMap], town: str) -> None:
    """As many as the file has, as long and wide as it says but for skewed corners."""
    root = etree.parse(maps_folder / "carla-2020" / f"{town}.xodr")
    written = {e.get("id"): e for e in root.iterfind(".//object[@type='crosswalk']")}
    found = load(f"carla-2020/{town}").crosswalks()
    assert {crosswalk.id for crosswalk in found} == set(written)
    for crosswalk in found:
        sizes = sorted(float(written[crosswalk.id].get(name, "0")) for name in ("length", "width"))
        assert sorted((crosswalk.length, crosswalk.width)) == pytest.approx(sizes, abs=0.02)
