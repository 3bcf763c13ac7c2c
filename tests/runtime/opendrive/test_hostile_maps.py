"""Maps of strangers: numbers as XML Schema has them, widths that can be, and bounded work."""

from __future__ import annotations

import pytest

from osc2tx_runtime.opendrive import LanePosition, MapError, RoadMap
from osc2tx_runtime.opendrive.road_map import read_map_text
from tests.work import calls

ROAD = """<OpenDRIVE><header revMajor="1"/><road id="1" length="{length}" junction="-1">
<planView><geometry s="0" x="{x}" y="0" hdg="0" length="{length}">{shape}</geometry></planView>
<lanes><laneSection s="0"><center><lane id="0"/></center><right>
<lane id="{lane}" type="driving"><width sOffset="0" a="{a}" b="{b}" c="0" d="0"/></lane>
</right></laneSection></lanes></road></OpenDRIVE>"""
SOUND = {"length": "100", "x": "0", "shape": "<line/>", "lane": "-1", "a": "3.5", "b": "0"}
SPIRAL = '<spiral curvStart="0" curvEnd="0.1"/>'


def road_map(**given: str) -> RoadMap:
    return read_map_text(ROAD.format(**{**SOUND, **given}))


@pytest.mark.parametrize("number", ["1_0", "\uff11", "nan", "INF", "1e999", "0x1", "", "1,5"])
@pytest.mark.parametrize("place", ["length", "x", "a", "b"])
def test_what_is_no_number_in_xml(place: str, number: str) -> None:
    with pytest.raises(MapError, match="is not a finite number"):
        road_map(**{place: number})


@pytest.mark.parametrize("number", ["-1_0", "-\uff11", "1.0", "9" * 400, ""])
def test_what_is_no_whole_number_in_xml(number: str) -> None:
    with pytest.raises(MapError, match="is not a whole number"):
        road_map(lane=number)


@pytest.mark.parametrize(("a", "b"), [("-3.5", "0"), ("3.5", "-0.1"), ("-0.06", "1")])
def test_a_negative_width_is_named(a: str, b: str) -> None:
    with pytest.raises(MapError, match=r"element `lane`: is -[\d.]+ m wide at one place"):
        road_map(a=a, b=b)


def test_the_rounding_of_widths_is_none() -> None:
    assert road_map(a="-0.001", b="0.03")


@pytest.mark.slow
def test_the_work_for_a_long_spiral_is_bounded() -> None:
    def drive(length: str) -> int:
        made = road_map(length=length, shape=SPIRAL)
        return calls(lambda: made.advance(LanePosition("1", -1, 10.0), 5.0))

    assert drive("1000000") < 1.1 * drive("100000")


def test_more_roads_than_any_map_has() -> None:
    road = ROAD.format(**{**SOUND, "length": "1000000"})
    inner = road[road.index("<road") : road.index("</OpenDRIVE>")]
    many = "".join(inner.replace('id="1"', f'id="{i}"', 1) for i in range(1, 22))
    with pytest.raises(MapError, match="has 21000 km of roads"):
        read_map_text(f"<OpenDRIVE>{many}</OpenDRIVE>")
