"""Bad input gives a `MapError` with file, line and element, never another exception."""

from pathlib import Path

import pytest

from osc2tx_runtime.errors import PlacementError
from osc2tx_runtime.opendrive import LanePosition, MapError, read_map, read_map_text
from tests.runtime.opendrive.small_maps import LANES, make_map, map_text, road_text, shape

GOOD = map_text(road_text(shape("line", 10.0), 10.0))
BAD = {
    "empty": "",
    "not xml": "hello",
    "cut off": GOOD[:150],
    "other root": "<OpenSCENARIO/>",
    "no roads": "<OpenDRIVE><header/></OpenDRIVE>",
    "no planView": map_text('<road id="1" length="5"><lanes/></road>'),
    "no geometry": map_text(road_text("", 10.0)),
    "no shape": map_text(road_text(shape("hello", 10.0), 10.0)),
    "no lanes": map_text(
        f'<road id="1" length="5"><planView>{shape("line", 5.0)}</planView></road>'
    ),
    "no laneSection": map_text(road_text(shape("line", 10.0), 10.0, lanes="")),
    "no road id": GOOD.replace('id="1" length', "length"),
    "no road length": GOOD.replace('length="10.0" junction', "junction"),
    "nan length": GOOD.replace('length="10.0"', 'length="NaN"'),
    "infinite x": GOOD.replace('x="0.0"', 'x="inf"'),
    "negative length": GOOD.replace('length="10.0"', 'length="-1"'),
    "absurd length": GOOD.replace('length="10.0"', 'length="1e300"'),
    "absurd width": GOOD.replace('a="3"', 'a="1e300"'),
    "text for a number": GOOD.replace('hdg="0.0"', 'hdg="north"'),
    "nan width": GOOD.replace('a="3"', 'a="nan"'),
    "width without a": GOOD.replace('a="3"', ""),
    "lane id not a number": GOOD.replace('lane id="1"', 'lane id="one"'),
    "lane without id": GOOD.replace('lane id="1"', "lane"),
    "lane twice": GOOD.replace('lane id="1"', 'lane id="-1"'),
    "road twice": map_text(*[road_text(shape("line", 10.0), 10.0)] * 2),
    "curve that stands still": map_text(
        road_text(
            shape(
                'paramPoly3 aU="0" bU="0" cU="0" dU="0" aV="0" bV="0" cV="0" dV="0"',
                10.0,
            ),
            10.0,
        )
    ),
    "junction without roads": map_text(
        road_text(shape("line", 10.0), 10.0),
        rest='<junction id="5"><connection id="0" incomingRoad="1"/></junction>',
    ),
    "signal without s": map_text(
        road_text(shape("line", 10.0), 10.0).replace(
            "</lanes>", '</lanes><signals><signal id="4" t="1"/></signals>'
        )
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_malformed_map_is_a_map_error(name: str, tmp_path: Path) -> None:
    path = tmp_path / "bad.xodr"
    path.write_text(BAD[name], encoding="utf-8")
    with pytest.raises(MapError) as caught:
        read_map(path)
    assert caught.value.file == str(path)
    assert str(path) in str(caught.value)
    assert len(caught.value.message) > 10


def test_message_names_line_and_element() -> None:
    text = GOOD.replace("<planView>", "<planView>\n\n").replace('hdg="0.0"', 'hdg="north"')
    with pytest.raises(MapError, match=r"some\.xodr:3: element `geometry`: .*`hdg`.*`north`"):
        read_map_text(text, "some.xodr")


def test_folder_and_missing_file(tmp_path: Path) -> None:
    with pytest.raises(MapError, match="folder"):
        read_map(tmp_path)
    with pytest.raises(MapError, match="cannot be read"):
        read_map(tmp_path / "absent.xodr")


def test_binary_file(tmp_path: Path) -> None:
    path = tmp_path / "binary.xodr"
    path.write_bytes(bytes(range(256)) * 20)
    with pytest.raises(MapError):
        read_map(path)


def test_entities_are_not_read(tmp_path: Path) -> None:
    secret = tmp_path / "secret.txt"
    secret.write_text("42", encoding="utf-8")
    head = f'<!DOCTYPE x [<!ENTITY e SYSTEM "{secret.as_uri()}">]>'
    text = head + GOOD.replace("<header/>", "<header>&e;</header>")
    assert read_map_text(text, "x").roads["1"].length == 10.0


def test_namespace_and_junk_are_ignored() -> None:
    text = GOOD.replace("<OpenDRIVE>", '<OpenDRIVE xmlns="http://example.org/odr">')
    text = text.replace(
        "<header/>", "<!-- c --><header><geoReference>+prj=%%</geoReference></header>"
    )
    assert list(read_map_text(text, "x").roads) == ["1"]


def test_links_to_nowhere_are_ignored() -> None:
    link = '<successor elementType="road" elementId="77" contactPoint="start"/>'
    rest = (
        '<junction id="5"><connection id="0" incomingRoad="1" connectingRoad="88">'
        '<laneLink from="-1" to="-1"/></connection></junction>'
    )
    lanes = LANES.replace(
        '<width sOffset="0"', '<link><successor id="-9"/></link><width sOffset="0"'
    )
    road = make_map(road_text(shape("line", 10.0), 10.0, link=link, lanes=lanes), rest=rest)
    moved = road.advance(LanePosition("1", -1, 5.0), 50.0)
    assert (moved.position.s, moved.travelled) == pytest.approx((10.0, 5.0))


def test_queries_for_absent_things_are_map_errors() -> None:
    road = make_map(road_text(shape("line", 10.0), 10.0))
    with pytest.raises(MapError, match="no road `9`"):
        road.pose(LanePosition("9", -1, 0.0))
    with pytest.raises(MapError, match=r"no lane 4 .* it has -1, 1"):
        road.pose(LanePosition("1", 4, 0.0))


def test_tiny_sections_survive() -> None:
    lanes = LANES
    for lane in (1, -1):
        link = f'<link><predecessor id="{lane}"/><successor id="{lane}"/></link>'
        start = f'<lane id="{lane}" type="driving">'
        lanes = lanes.replace(start, start + link)
    sections = "".join(lanes.replace('s="0">', f's="{s}">', 1) for s in (0, 4, 4, 4.0000001, 8))
    road = make_map(road_text(shape("line", 10.0), 10.0, lanes=sections))
    assert [section.begin for section in road.roads["1"].sections] == [0, 4, 4, 4.0000001, 8]
    forth = road.advance(LanePosition("1", -1, 1.0), 8.5)
    assert (forth.position.s, forth.travelled) == pytest.approx((9.5, 8.5))
    back = road.advance(forth.position, -8.5)
    assert back.position.s == pytest.approx(1.0)
    assert road.advance(LanePosition("1", 1, 9.0), 8.0).position.s == pytest.approx(1.0)
    # A place on a boundary belongs to the section that begins there.
    assert road.lane_key(road.advance(LanePosition("1", -1, 1.0), 7.0).position).section == 4
    assert road.lane_key(road.advance(LanePosition("1", 1, 9.0), 1.0 + 1e-9).position).section == 3


@pytest.mark.parametrize("distance", [float("nan"), float("inf"), float("-inf")])
def test_distance_that_is_not_finite(distance: float) -> None:
    road = make_map(road_text(shape("line", 10.0), 10.0))
    with pytest.raises(PlacementError, match="finite"):
        road.advance(LanePosition("1", -1, 1.0), distance)


def test_ring_road_without_length_ends() -> None:
    link = (
        '<predecessor elementType="road" elementId="1" contactPoint="end"/>'
        '<successor elementType="road" elementId="1" contactPoint="start"/>'
    )
    own = '<link><predecessor id="-1"/><successor id="-1"/></link>'
    lanes = LANES.replace('<lane id="-1" type="driving">', f'<lane id="-1" type="driving">{own}')
    road = make_map(road_text(shape("line", 0.0), 0.0, link=link, lanes=lanes))
    assert road.advance(LanePosition("1", -1, 0.0), 5.0).travelled == 0.0
