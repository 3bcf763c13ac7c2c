"""How far actors that steer are from the corners of a line, however long its stretches are."""

from __future__ import annotations

import math

import pytest

from osc2tx.backends.xosc.facts.curves import Line, Waypoint, off_the_line
from osc2tx_runtime.opendrive import Pose
from osc2tx_runtime.world.actor_dimensions import limits_of, shape_of
from tests.work import calls

CAR = shape_of("vehicle", "car"), limits_of("vehicle", "car")


def off(*corners: tuple[float, float], aside: float = 0.0, smooth: bool = False) -> float:
    points = tuple(Waypoint(0.0, x, y, 0.0) for x, y in corners)
    (x, y), (there, on) = corners[:2]
    start = Pose(x, y + aside, 0.0, math.atan2(on - y, there - x))
    from_here = points if not aside else (Waypoint(0.0, x, y + aside, 0.0), *points)
    return off_the_line(Line(points, is_smooth=smooth), from_here, start, 20.0, CAR)


@pytest.mark.slow
@pytest.mark.parametrize("far", [1000.0, 20000.0])
def test_the_length_of_straight_stretches_does_not_matter(far: float) -> None:
    bend = 150.0
    near = off((0.0, 0.0), (500.0, 0.0), (500.0 + bend, bend), (1000.0 + bend, bend))
    assert near > 0.5
    there = off((0.0, 0.0), (far, 0.0), (far + bend, bend), (2 * far + bend, bend))
    assert there == pytest.approx(near, rel=0.05)
    assert off((0.0, 0.0), (far, 0.0)) == pytest.approx(0.0, abs=1e-6)
    assert off((0.0, 0.0), (far, 0.0), aside=1.0) == pytest.approx(
        off((0.0, 0.0), (500.0, 0.0), aside=1.0)
    )


@pytest.mark.slow
@pytest.mark.parametrize("smooth", [False, True])
def test_the_work_for_a_far_way_is_bounded(smooth: bool) -> None:
    def work(far: float) -> int:
        way = [(0.0, 0.0), (far, 0.0), (2.0 * far, 0.3 * far), (3.0 * far, 0.3 * far)]
        return calls(lambda: off(*way, smooth=smooth))

    assert work(100_000.0) < 1.2 * work(2_000.0)
