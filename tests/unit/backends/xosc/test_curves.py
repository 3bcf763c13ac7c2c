"""Curves become polylines with few corners, which stay near them."""

import itertools
import math

import pytest

from osc2tx.backends.xosc.facts.curves import TOLERANCE, Waypoint, thinned


def arc(radius: float, length: float, count: int = 1000) -> list[Waypoint]:
    """Return points of an arc that begins at the origin along x, at 10 m/s."""
    steps = (index * length / (count - 1) for index in range(count))
    return [
        Waypoint(
            s / 10.0, radius * math.sin(s / radius), radius * (1.0 - math.cos(s / radius)), 0.0
        )
        for s in steps
    ]


def distance(point: Waypoint, a: Waypoint, b: Waypoint) -> float:
    """Return how far a point is from a segment."""
    way = (b.x - a.x, b.y - a.y)
    part = ((point.x - a.x) * way[0] + (point.y - a.y) * way[1]) / (way[0] ** 2 + way[1] ** 2)
    part = min(1.0, max(0.0, part))
    return math.dist((point.x, point.y), (a.x + part * way[0], a.y + part * way[1]))


@pytest.mark.parametrize("radius", [20.0, 60.0, 500.0])
def test_an_arc_keeps_as_few_corners_as_its_bend_needs(radius: float) -> None:
    points, length = arc(radius, 50.0), 50.0
    kept = thinned(points, is_timed=False)
    assert (kept[0], kept[-1]) == (points[0], points[-1])
    farthest = max(min(distance(p, a, b) for a, b in itertools.pairwise(kept)) for p in points)
    assert farthest <= TOLERANCE + 1e-9
    longest = math.sqrt(8.0 * radius * TOLERANCE)  # of a chord with that sagitta
    assert length / longest <= len(kept) - 1 <= 1.1 * length / longest + 1


def test_a_straight_way_has_two_ends() -> None:
    line = [Waypoint(0.0, float(x), 2.0 * x, 0.0) for x in range(100)]
    assert thinned(line, is_timed=False) == (line[0], line[-1])


def test_times_count_where_there_are_some() -> None:
    """Who speeds up on a straight way is between the ends later than one who does not."""
    speeding = [Waypoint(t, 0.5 * t * t, 0.0, 0.0) for t in (index / 50 for index in range(101))]
    assert len(thinned(speeding, is_timed=False)) == 2
    kept = thinned(speeding, is_timed=True)
    for a, b in itertools.pairwise(kept):
        for point in speeding:
            if a.time <= point.time <= b.time:
                x = a.x + (b.x - a.x) * (point.time - a.time) / (b.time - a.time)
                assert abs(x - point.x) <= TOLERANCE + 1e-9
    assert len(kept) <= 7
