"""Whether lanes lead straight on from where an actor begins: then it holds its speed by itself."""

import pytest

from osc2tx.importing.ground import is_straight_ahead
from osc2tx.xosc.player.bodies import Body, Pose
from osc2tx_runtime.opendrive import LanePosition
from tests.runtime.opendrive.small_maps import WIDTH, make_map, road_text, shape


def lanes(at: float, *ids: int, leads_to: str = "") -> str:
    """Return a section with driving lanes on the right."""
    found = "".join(
        f'<lane id="{each}" type="driving"><link>{leads_to}</link>{WIDTH}</lane>' for each in ids
    )
    return (
        f'<laneSection s="{at}"><center><lane id="0" type="none"/></center>'
        f"<right>{found}</right></laneSection>"
    )


def link(road: int, lane: int) -> str:
    """Return a connection of a junction from road 1."""
    return (
        f'<connection id="{road}" incomingRoad="1" connectingRoad="{road}" contactPoint="start">'
        f'<laneLink from="{lane}" to="-1"/></connection>'
    )


FROM_1 = '<predecessor elementType="road" elementId="1" contactPoint="end"/>'
MAP = make_map(
    road_text(
        shape("line", 200.0),
        200.0,
        lanes=lanes(0.0, -1) + lanes(100.0, -1, -2),
        link='<successor elementType="junction" elementId="9"/>',
    ),
    road_text(
        shape("line", 80.0, x=200.0),
        80.0,
        identity="2",
        lanes=lanes(0.0, -1),
        link=FROM_1,
        junction="9",
    ),
    road_text(
        shape('arc curvature="-0.02"', 60.0, x=200.0, y=-3.0),
        60.0,
        identity="3",
        lanes=lanes(0.0, -1),
        link=FROM_1,
        junction="9",
    ),
    rest=f'<junction id="9">{link(2, -1)}{link(3, -2)}</junction>',
)


@pytest.mark.parametrize(
    ("s", "lane", "beside", "is_straight"),
    [
        (10.0, -1, False, True),
        (10.0, -1, True, False),  # the exit begins 90 m ahead
        (150.0, -1, True, False),
        (150.0, -2, False, False),
    ],
)
def test_an_exit_counts_for_an_actor_that_may_change_to_it(
    s: float, lane: int, *, beside: bool, is_straight: bool
) -> None:
    place = LanePosition("1", lane, s)
    at = MAP.pose(place)
    body = Body("it", "Vehicle", 3.0, 1.0, 2.0, {}, pose=Pose(at.x, at.y, at.h), place=place)
    assert is_straight_ahead(MAP, body, beside=beside) is is_straight
