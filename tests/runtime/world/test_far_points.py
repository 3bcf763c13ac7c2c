"""The foot of a point on a path that comes from far away: found, and in few steps."""

from __future__ import annotations

import pytest

from osc2tx_runtime.world.geometry.curve import Curve, Knot
from tests.work import calls


@pytest.mark.parametrize("smooth", [False, True])
@pytest.mark.parametrize("length", [1e4, 1e6, 1e9])
def test_the_search_takes_few_steps(smooth: bool, length: float) -> None:
    places = ((0.0, length), (1.0, 0.0), (2.0, -9.0))
    curve = Curve([Knot(at, x, 0.0, 0.0) for at, x in places], smooth)
    found = curve.nearest(0.0, 3.0, 0.0, 5.0)
    assert curve.distance_to(0.0, 3.0, found) == pytest.approx(3.0, abs=0.05)
    assert calls(lambda: curve.nearest(0.0, 3.0, 0.0, 5.0)) < 200_000
