"""What a map says is read as it is meant, or named."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from osc2tx_runtime.opendrive import LaneKey, LanePosition, MapError, RoadMap
from osc2tx_runtime.running.runner import map_warnings
from tests.runtime.opendrive.small_maps import LANES, WIDTH, make_map, road_text, shape

LINE = shape("line", 100.0)


def lane(number: int, *, inner: str = WIDTH, link: str = "", kind: str = "driving") -> str:
    return f'<lane id="{number}" type="{kind}"><link>{link}</link>{inner}</lane>'


def links(before: int, after: int) -> str:
    return f'<predecessor id="{before}"/><successor id="{after}"/>'


def section(s: float, left: str = "", right: str = "", more: str = "") -> str:
    sides = [f"<left>{left}</left>" if left else "", '<center><lane id="0"/></center>']
    sides += [f"<right>{right}</right>" if right else ""]
    return f'<laneSection s="{s}" {more}>{"".join(sides)}</laneSection>'


def test_sections_of_one_side_leave_the_other_as_it_is() -> None:
    narrowing = '<width sOffset="0" a="4" b="-0.01" c="0" d="0"/>'
    lanes = (
        section(0, lane(1), lane(-1, inner=narrowing))
        + section(40, lane(2) + lane(1, link=links(1, 1)), more='singleSide="true"')
        + section(60, right=lane(-1, link=links(-1, -1)), more='singleSide="true"')
        + section(80, lane(1), lane(-1))
    )
    road = make_map(road_text(LINE, 100.0, lanes=lanes))
    assert [sorted(each.lanes) for each in road.roads["1"].sections] == [
        [-1, 1],
        [-1, 1, 2],
        [-1, 1, 2],
        [-1, 1],
    ]
    # The right side of the first element goes on up to 60 m, with its width over s.
    assert [road.lane_width("1", -1, s) for s in (20.0, 50.0, 70.0)] == pytest.approx([3.8, 3.5, 3])
    assert road.successors(LaneKey("1", 0, -1)) == (LaneKey("1", 1, -1),)
    assert road.successors(LaneKey("1", 1, -1)) == ()  # its element names none
    assert road.successors(LaneKey("1", 2, 2)) == (LaneKey("1", 1, 2),)
    assert road.pose(LanePosition("1", 2, 70.0)).y == pytest.approx(4.5)


@pytest.mark.parametrize(
    ("profile", "lanes"),
    [
        ('<elevationProfile><elevation s="50" a="5" b="0" c="0" d="0"/></elevationProfile>', LANES),
        (
            '<lateralProfile><superelevation s="50" a="0.1" b="0" c="0" d="0"/></lateralProfile>',
            LANES,
        ),
        ("", f'<laneOffset s="50" a="2" b="0" c="0" d="0"/>{LANES}'),
    ],
)
def test_profiles_are_zero_before_their_first_record(profile: str, lanes: str) -> None:
    road = make_map(road_text(LINE, 100.0, lanes=lanes, extra=profile))
    plain = make_map(road_text(LINE, 100.0))
    assert road.pose(LanePosition("1", -1, 49.0)) == plain.pose(LanePosition("1", -1, 49.0))
    assert road.pose(LanePosition("1", -1, 51.0)) != plain.pose(LanePosition("1", -1, 51.0))


def test_lanes_have_heights() -> None:
    first = '<height sOffset="10" inner="0.1" outer="0.3"/>'
    heights = first + '<height sOffset="20" inner="0.2" outer="0.2"/>'
    walk = lane(-2, inner=WIDTH + heights, kind="sidewalk")
    banked = '<elevationProfile><elevation s="0" a="5" b="0" c="0" d="0"/></elevationProfile>'
    for extra, ground in (("", 0.0), (banked, 5.0)):
        text = road_text(LINE, 100.0, lanes=section(0, "", lane(-1) + walk), extra=extra)
        road = make_map(text)
        assert road.pose(LanePosition("1", -1, 12.0)).z == ground
        # From -3 m (inner edge) to -6 m: even between the edges, and from record to record.
        for s, offset, height in [
            (10.0, 0.0, 0.2),
            (10.0, 1.5, 0.1),
            (10.0, -1.5, 0.3),
            (15.0, 1.5, 0.15),
            (90.0, 1.0, 0.2),
        ]:
            z = road.pose(LanePosition("1", -2, s, offset)).z
            assert z == pytest.approx(ground + height), (s, offset)


def test_people_stand_on_the_sidewalks_of_a_town(load: Callable[[str], RoadMap]) -> None:
    town = load("esmini/fabriksgatan")
    heights = {
        round(town.pose(LanePosition(road.id, lane.id, 0.5 * road.length)).z, 3)
        for road in town.roads.values()
        for lane in road.section_at(0.5 * road.length).lanes.values()
        if lane.type == "sidewalk"
    }
    assert heights == {0.12}


def test_a_width_below_nothing_between_its_ends() -> None:
    # 1 - 0.2 u + 0.002 u^2: 1 m wide at both ends, -4 m in the middle
    dip = '<width sOffset="0" a="1" b="-0.2" c="0.002" d="0"/>'
    with pytest.raises(MapError, match=r"element `lane`: is -4 m wide at one place"):
        make_map(road_text(LINE, 100.0, lanes=section(0, "", lane(-1, inner=dip))))


@pytest.mark.parametrize(("number", "a"), [(-1, 3.0), (1, -3.0)])
def test_a_border_on_the_other_side(number: int, a: float) -> None:
    border = f'<border sOffset="0" a="{a}" b="0" c="0" d="0"/>'
    sides = ("", lane(number, inner=border)) if number < 0 else (lane(number, inner=border), "")
    with pytest.raises(MapError, match=r"its border 3 m to the (left|right) of the centre"):
        make_map(road_text(LINE, 100.0, lanes=section(0, *sides)))


def test_a_road_that_is_longer_than_its_geometry() -> None:
    """Where there is no geometry the road is the tangent of what stands before."""
    arc = '<geometry s="0" x="0" y="0" hdg="0" length="50"><arc curvature="0.02"/></geometry>'
    road_map = make_map(road_text(arc, 100.0))
    (remark,) = road_map.remarks
    told = "has no geometry from s = 50 m to 100 m: a straight line is assumed"
    assert remark == f"line 1: `road` 1 {told}"
    x, y, h, curvature = road_map.roads["1"].reference.at(80.0)
    assert (h, curvature) == (pytest.approx(1.0), 0.0)
    assert x == pytest.approx(50.0 * math.sin(1.0) + 30.0 * math.cos(1.0))
    assert y == pytest.approx(50.0 * (1.0 - math.cos(1.0)) + 30.0 * math.sin(1.0))
    assert not make_map(road_text(LINE, 100.0)).remarks


def test_a_road_that_is_shorter_than_its_geometry() -> None:
    (remark,) = make_map(road_text(LINE, 90.0)).remarks
    assert remark == "line 1: `road` 1 is 90 m long, its geometry 100 m"


def test_what_is_read_otherwise_than_it_is_meant_is_named() -> None:
    shapes = '<shape s="0" t="-3" a="0.1" b="0" c="0" d="0"/>'
    bank = '<superelevation s="0" a="0.1" b="0" c="0" d="0"/>'
    road = make_map(
        road_text(LINE, 100.0, extra=f"<lateralProfile>{bank}{shapes}</lateralProfile>"),
        rest='<junction id="7" type="virtual" mainRoad="1" sStart="1" sEnd="2" orientation="+">'
        '<connection id="0" type="virtual"/></junction>',
    )
    assert road.remarks == (
        "line 1: `road` 1 has a cross-section and superelevation: their heights are added up",
        "line 1: `junction` 7 has 1 connections without a road, which are ignored",
    )
    both = LANES.replace('id="-1" type', 'id="-1" direction="both" type')
    (remark,) = make_map(road_text(LINE, 100.0, lanes=both)).remarks
    assert (
        remark
        == "line 1: `lane` -1 has direction `both`: traffic runs as in the other lanes of its side"
    )
    assert map_warnings(make_map(road_text(LINE, 100.0, lanes=both)))[0] == f"map small: {remark}"


def kinked(dx: float, dy: float, turn: float) -> RoadMap:
    """Two roads that should meet at (100, 0)."""
    after = '<successor elementType="road" elementId="2" contactPoint="start"/>'
    before = '<predecessor elementType="road" elementId="1" contactPoint="end"/>'
    linked = section(0, "", lane(-1, link=links(-1, -1)))
    second = shape("line", 50.0, x=100.0 + dx, y=dy, h=turn)
    return make_map(
        road_text(LINE, 100.0, lanes=linked, link=after),
        road_text(second, 50.0, identity="2", lanes=linked, link=before),
    )


def test_seams_between_roads() -> None:
    assert kinked(0.0, 0.0, 0.0).seams() == ()
    assert kinked(0.005, 0.0, math.radians(0.1)).seams() == ()
    (step,) = kinked(0.0, 0.2, 0.0).seams()
    assert (step.road, step.lane, step.onto) == ("1", -1, ("2", -1))
    assert (step.s, step.gap, step.turn) == pytest.approx((100.0, 0.2, 0.0), abs=1e-4)
    (kink,) = kinked(0.0, 0.0, 0.5 * math.pi).seams()
    assert kink.turn == pytest.approx(0.5 * math.pi)
    (warning,) = map_warnings(kinked(0.0, 0.2, 0.0))
    assert warning == (
        "map small: lanes do not fit together at 1 places, worst lane -1 of road 1 at s = 100.00 m"
        " to lane -1 of road 2: 0.200 m, 0.0°; `osc2tx map` lists them"
    )


def test_seams_within_a_road() -> None:
    pieces = shape("line", 40.0) + shape("line", 60.0, s=40.0, x=40.0, y=0.3)
    found = make_map(road_text(pieces, 100.0)).seams()
    assert [(seam.lane, seam.s) for seam in found] == [(-1, 40.0), (1, 40.0)]
    assert [seam.gap for seam in found] == pytest.approx([0.3, 0.3], abs=1e-4)
    steps = WIDTH + '<width sOffset="70" a="4" b="0" c="0" d="0"/>'
    found = make_map(road_text(LINE, 100.0, lanes=section(0, "", lane(-1, inner=steps)))).seams()
    assert [(seam.s, seam.gap) for seam in found] == [(70.0, pytest.approx(0.5, abs=1e-4))]


def test_our_own_maps_have_none(own: Callable[[str], RoadMap]) -> None:
    for name in ("crossing", "curve", "highway", "left_hand", "merge", "urban_crossing"):
        assert map_warnings(own(name)) == ()


def test_known_seams_of_maps_of_others(load: Callable[[str], RoadMap]) -> None:
    """A lane that ends beside its successor, and a step of half a metre."""
    (merging,) = load("esmini/soderleden").seams()
    assert (merging.road, merging.lane, merging.onto) == ("0", -3, ("0", -2))
    assert merging.gap == pytest.approx(1.75, abs=1e-3)
    assert ("505", 3) in {(seam.road, seam.lane) for seam in load("carla-2019/Town06").seams()}
