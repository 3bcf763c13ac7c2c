"""Distances where there is a way round."""

import pytest

from osc2tx_runtime.opendrive import LanePosition
from tests.runtime.opendrive.small_maps import LANES, make_map, road_text, shape


def test_distances_on_a_ring_road() -> None:
    link = (
        '<predecessor elementType="road" elementId="1" contactPoint="end"/>'
        '<successor elementType="road" elementId="1" contactPoint="start"/>'
    )
    own = '<link><predecessor id="-1"/><successor id="-1"/></link>'
    lanes = LANES.replace('<lane id="-1" type="driving">', f'<lane id="-1" type="driving">{own}')
    ring = make_map(road_text(shape('arc curvature="0.1"', 62.8), 62.8, link=link, lanes=lanes))
    length = ring.lane_length(ring.lane_key(LanePosition("1", -1, 0.0)))
    assert length == pytest.approx(62.8 * 1.15)  # 1.5 m right of a left circle of 10 m radius
    a, b = LanePosition("1", -1, 5.0), LanePosition("1", -1, 55.0)
    assert ring.route_distance(a, b) == pytest.approx(-12.8 * 1.15)
    assert ring.route_distance(b, a) == pytest.approx(12.8 * 1.15)
    assert ring.advance(a, 10.0 * length).position.s == pytest.approx(5.0, abs=1e-6)
    assert ring.advance(a, -length).position.s == pytest.approx(5.0, abs=1e-6)
    assert ring.route_distance(a, LanePosition("1", 1, 5.0)) is None
