"""Curves of trajectories against closed forms."""

import math
from itertools import pairwise

import pytest

from osc2tx.xosc import read
from osc2tx.xosc.element import Element
from osc2tx.xosc.player.bodies import Pose
from osc2tx.xosc.player.shapes import CHORD, Way, lengths_of, nearest_on, on_way, way_of

RADIUS = 20.0


def at_world(position: Element) -> Pose:
    """Return the pose of a `WorldPosition`."""
    inner = position.inner
    return Pose(*(float(inner.get(name) or 0.0) for name in ("x", "y", "h")))


def ways(text: str) -> Way:
    return way_of(read(f"<Shape>{text}</Shape>"), at_world)


def where(x: float, y: float, h: float = 0.0) -> str:
    return f'<Position><WorldPosition x="{x}" y="{y}" h="{h}"/></Position>'


def quarter() -> str:
    """Return a quarter of a circle as NURBS: exact with a middle weight of cos 45°."""
    poles = [(RADIUS, 0.0, 1.0), (RADIUS, RADIUS, math.sqrt(0.5)), (0.0, RADIUS, 1.0)]
    points = "".join(
        f'<ControlPoint weight="{w}" time="{t}">{where(x, y)}</ControlPoint>'
        for t, (x, y, w) in enumerate(poles)
    )
    knots = "".join(f'<Knot value="{value}"/>' for value in (0, 0, 0, 1, 1, 1))
    return f'<Nurbs order="3">{points}{knots}</Nurbs>'


def test_a_nurbs_is_a_circle() -> None:
    way = ways(quarter())
    assert (way[0][1][:2], way[-1][1][:2]) == (
        pytest.approx((RADIUS, 0.0)),
        pytest.approx((0.0, RADIUS)),
    )
    assert all(math.hypot(x, y) == pytest.approx(RADIUS) for _, (x, y, _) in way)
    chords = [math.dist(a[1][:2], b[1][:2]) for a, b in pairwise(way)]
    assert max(RADIUS - math.sqrt(RADIUS**2 - 0.25 * c * c) for c in chords) <= CHORD
    assert (way[0][0], way[-1][0]) == (0.0, 2.0)


@pytest.mark.parametrize("rate", [0.0, 0.002])
def test_a_clothoid_turns_by_the_integral_of_its_curvature(rate: float) -> None:
    """Its place is that of a sum over many small steps."""
    length, bend = 30.0, 0.01
    way = ways(
        f'<Clothoid curvature="{bend}" curvatureDot="{rate}" length="{length}" startTime="1"'
        f' stopTime="3">{where(5.0, 7.0, 0.3)}</Clothoid>'
    )
    count = 20_000
    x, y = 5.0, 7.0
    for index in range(count):
        s = (index + 0.5) * length / count
        h = 0.3 + bend * s + 0.5 * rate * s * s
        x, y = x + math.cos(h) * length / count, y + math.sin(h) * length / count
    assert way[-1][1][:2] == pytest.approx((x, y), abs=1e-6)
    assert way[-1][1].h == pytest.approx(0.3 + bend * length + 0.5 * rate * length**2)
    assert lengths_of(way)[-1] == pytest.approx(length, abs=CHORD)
    assert (way[0][0], way[-1][0]) == (1.0, 3.0)


def test_segments_of_a_spline_follow_each_other() -> None:
    """A line, then half a circle: it comes back beside where it began."""
    way = ways(
        '<ClothoidSpline><ClothoidSplineSegment length="10" curvatureStart="0" curvatureEnd="0">'
        '<PositionStart><WorldPosition x="0" y="0" h="0"/></PositionStart></ClothoidSplineSegment>'
        f'<ClothoidSplineSegment length="{math.pi * RADIUS}" curvatureStart="{1 / RADIUS}"'
        f' curvatureEnd="{1 / RADIUS}"/></ClothoidSpline>'
    )
    assert way[-1][1][:2] == pytest.approx((10.0, 2.0 * RADIUS))
    points = lengths_of(way)
    assert on_way(way, points, 4.0)[:2] == pytest.approx((4.0, 0.0))
    assert nearest_on(way, points, 4.0, -1.0) == pytest.approx(4.0)


@pytest.mark.parametrize("bend", [0.0, 0.11, -0.05])
def test_a_curve_ends_in_its_direction(bend: float) -> None:
    """Another one may begin there; a chord of the curve deviates by half of its angle."""
    way = ways(f'<Clothoid curvature="{bend}" curvatureDot="0" length="6">{where(1, 2)}</Clothoid>')
    lengths = lengths_of(way)
    assert on_way(way, lengths, 0.0).h == pytest.approx(0.0, abs=1e-4)
    assert on_way(way, lengths, lengths[-1]).h == pytest.approx(6.0 * bend, abs=1e-4)


def test_a_nurbs_ends_in_its_direction() -> None:
    way = ways(quarter())
    lengths = lengths_of(way)
    assert on_way(way, lengths, 0.0).h == pytest.approx(0.5 * math.pi, abs=1e-4)
    assert on_way(way, lengths, lengths[-1]).h == pytest.approx(math.pi, abs=1e-4)
