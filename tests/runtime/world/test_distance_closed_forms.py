"""Distances against closed forms and quadratures that do not use the geometry of the product."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from osc2tx_runtime.opendrive import LanePosition, RoadMap
from osc2tx_runtime.world import ActorSpec, ActorState, EmbeddedWorld
from osc2tx_runtime.world.measuring.distances import (
    across_road,
    along_lanes,
    along_road,
    lateral_on_road,
)
from tests.runtime.opendrive.small_maps import make_map, one_road, road_text, shape

MakeSpec = Callable[..., ActorSpec]
Curvature = Callable[[float], float]
ASIDE = 1.5  # m from the reference line to the centre of a lane
CLOSE = 1e-3  # m


def states(road_map: RoadMap, make_spec: MakeSpec, *places: LanePosition) -> list[ActorState]:
    world = EmbeddedWorld(road_map)
    names = [f"a{index}" for index in range(len(places))]
    for name, place in zip(names, places, strict=True):
        world.add(make_spec(name))
        world.place(name, place)
    return [world.state(name) for name in names]


def length_beside(curvature: Curvature, left: float, begin: float, end: float) -> float:
    """Length (m) of the line at an offset from a line that begins at s = 0, from its points.

    The heading is the integral of the curvature, the position that of the heading (midpoints).
    """
    count = 18_000  # a step ends at s = 10 m
    step = end / count
    x = y = h = length = 0.0
    before = (0.0, left)
    for index in range(count):
        middle = h + 0.5 * step * curvature((index + 0.25) * step)
        x, y = x + step * math.cos(middle), y + step * math.sin(middle)
        h += step * curvature((index + 0.5) * step)
        now = (x - left * math.sin(h), y + left * math.cos(h))
        if (index + 0.5) * step >= begin:
            length += math.dist(before, now)
        before = now
    return length


BENDS: dict[str, tuple[str, Curvature]] = {
    "line": ("line", lambda s: 0.0),
    "arc to the left": ('arc curvature="0.02"', lambda s: 0.02),
    "arc to the right": ('arc curvature="-0.02"', lambda s: -0.02),
    "spiral": ('spiral curvStart="0" curvEnd="0.03"', lambda s: 0.03 * s / 100.0),
    "spiral over a straight": (
        'spiral curvStart="-0.02" curvEnd="0.02"',
        lambda s: -0.02 + 0.04 * s / 100.0,
    ),
}


@pytest.mark.parametrize("lane", [-1, 1])
@pytest.mark.parametrize("bend", BENDS)
def test_along_a_lane(bend: str, lane: int, make_spec: MakeSpec) -> None:
    """Along the centre of the lane; on the road it is the difference of s."""
    kind, curvature = BENDS[bend]
    road_map = one_road(kind, 100.0)
    a, b = states(road_map, make_spec, LanePosition("1", lane, 10.0), LanePosition("1", lane, 90.0))
    sign = -1.0 if lane > 0 else 1.0  # lanes to the left are driven against s
    wanted = length_beside(curvature, -ASIDE * sign, 10.0, 90.0)
    assert along_lanes(road_map, a, b) == pytest.approx(sign * wanted, abs=CLOSE)
    assert along_lanes(road_map, b, a) == pytest.approx(-sign * wanted, abs=CLOSE)
    assert along_road(road_map, a, b) == pytest.approx(sign * 80.0, abs=CLOSE)
    assert across_road(road_map, a, b) == pytest.approx(0.0, abs=CLOSE)


@pytest.mark.parametrize("bend", BENDS)
def test_to_the_other_carriageway(bend: str, make_spec: MakeSpec) -> None:
    """By s and t of the road, from the side of the one who asks: each sees the other ahead left."""
    road_map = one_road(BENDS[bend][0], 100.0)
    a, b = states(road_map, make_spec, LanePosition("1", -1, 10.0), LanePosition("1", 1, 60.0, 0.5))
    for one, other in ((a, b), (b, a)):
        assert along_road(road_map, one, other) == pytest.approx(50.0, abs=CLOSE)
        assert across_road(road_map, one, other) == pytest.approx(2 * ASIDE - 0.5, abs=CLOSE)


@pytest.mark.parametrize("bend", BENDS)
def test_across_a_banked_road(bend: str, make_spec: MakeSpec) -> None:
    """In the surface, not seen from above."""
    bank = '<lateralProfile><superelevation s="0" a="0.3" b="0" c="0" d="0"/></lateralProfile>'
    road_map = one_road(BENDS[bend][0], 100.0, extra=bank)
    a, b = states(
        road_map, make_spec, LanePosition("1", -1, 30.0, 0.4), LanePosition("1", 1, 30.0, 0.6)
    )
    assert across_road(road_map, a, b) == pytest.approx(2 * ASIDE - 0.4 - 0.6, abs=CLOSE)
    apart = math.dist((a.x, a.y, a.z), (b.x, b.y, b.z))
    assert across_road(road_map, a, b) == pytest.approx(apart, abs=CLOSE)


def test_along_a_banked_arc(make_spec: MakeSpec) -> None:
    """The lane lies on a circle whose radius is that of the tilted offset."""
    bank = '<lateralProfile><superelevation s="0" a="0.3" b="0" c="0" d="0"/></lateralProfile>'
    road_map = one_road('arc curvature="0.02"', 100.0, extra=bank)
    a, b = states(road_map, make_spec, LanePosition("1", -1, 10.0), LanePosition("1", -1, 90.0))
    wanted = (50.0 + ASIDE * math.cos(0.3)) * 80.0 / 50.0
    assert along_lanes(road_map, a, b) == pytest.approx(wanted, abs=CLOSE)


def turning_map() -> RoadMap:
    """A road, a connecting road that turns left by 90 degrees, and a road north."""
    radius = 20.0
    arc = 0.5 * math.pi * radius
    one_lane = (
        '<laneSection s="0"><center><lane id="0" type="none"/></center><right>'
        '<lane id="-1" type="driving">{}<width sOffset="0" a="3" b="0" c="0" d="0"/></lane>'
        "</right></laneSection>"
    )
    through = '<link><predecessor id="-1"/><successor id="-1"/></link>'
    return make_map(
        road_text(
            shape("line", 50.0),
            50.0,
            identity="1",
            lanes=one_lane.format(""),
            link='<successor elementType="junction" elementId="9"/>',
        ),
        road_text(
            shape(f'arc curvature="{1.0 / radius!r}"', arc, x=50.0),
            arc,
            identity="2",
            lanes=one_lane.format(through),
            link='<predecessor elementType="road" elementId="1" contactPoint="end"/>'
            '<successor elementType="road" elementId="3" contactPoint="start"/>',
            junction="9",
        ),
        road_text(
            shape("line", 60.0, x=50.0 + radius, y=radius, h=0.5 * math.pi),
            60.0,
            identity="3",
            lanes=one_lane.format(""),
            link='<predecessor elementType="junction" elementId="9"/>',
        ),
        rest='<junction id="9" name="turn"><connection id="0" incomingRoad="1" connectingRoad="2"'
        ' contactPoint="start"><laneLink from="-1" to="-1"/></connection></junction>',
    )


def test_across_a_junction(make_spec: MakeSpec) -> None:
    """The rest of one road, the lane of the connecting road (an arc), and what is left."""
    road_map = turning_map()
    a, on, b = states(
        road_map,
        make_spec,
        LanePosition("1", -1, 30.0),
        LanePosition("2", -1, 0.25 * math.pi * 20.0),
        LanePosition("3", -1, 25.0),
    )
    turn = 0.5 * math.pi * (20.0 + ASIDE)
    assert along_lanes(road_map, a, b) == pytest.approx(20.0 + turn + 25.0, abs=CLOSE)
    assert along_lanes(road_map, b, a) == pytest.approx(-20.0 - turn - 25.0, abs=CLOSE)
    assert along_lanes(road_map, a, on) == pytest.approx(20.0 + 0.5 * turn, abs=CLOSE)
    assert along_road(road_map, a, b) is None  # no common s
    assert lateral_on_road(road_map, a, b) == pytest.approx(0.0, abs=CLOSE)
