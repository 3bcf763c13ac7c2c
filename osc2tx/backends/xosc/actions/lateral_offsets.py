"""Lateral positions in a lane (§8.9.8), measured from edges and centers."""

from __future__ import annotations

from osc2tx.backends.xosc.actions.leaf import Arguments
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.facts.maps import LanePosition
from osc2tx.backends.xosc.report import Inexpressible

EDGES = {"left": 0.5, "center": 0.0, "right": -0.5}
"""Widths from the centre to what `lat_measure_by` names."""


def offset_in_lane(
    ctx: Context, arguments: Arguments, member: CastMember, place: LanePosition | None
) -> float:
    """Return how far (m) left of the centre of its lane `lateral` puts an actor.

    Raises:
        Inexpressible: It says no distance, or the width of the lane is not known.
    """
    width = None
    if ctx.roads is not None and place is not None:
        width = ctx.roads.map.lane_width(place.road, place.lane, place.s)
    return left_of(arguments, member.shape.width, width)


def left_of(arguments: Arguments, own: float, theirs: float | None) -> float:
    """Return how far (m) left of the centre of a lane or an actor `lateral` puts an actor.

    Args:
        arguments: Of the modifier.
        own: Width of the actor (m).
        theirs: That of the lane or the other actor; `None` if it is not known.

    Raises:
        Inexpressible: As of `offset_in_lane`.
    """
    distance = arguments.number("distance")
    if distance is None:
        distance = arguments.number("distance_range")
    if distance is None:
        raise Inexpressible("it says no distance", arguments.source.span)
    side = arguments.member("side", "left")
    left = -distance if side == "right" else distance
    measured = arguments.member("measure_by", "center_to_center")
    if measured == "center_to_center":
        return left
    if theirs is None:
        raise Inexpressible("how wide the lane is is only known during the run")
    if measured == "closest":
        reach = 0.5 * (own + theirs)
        return left + (reach if left > 0.0 or (left == 0.0 and side == "left") else -reach)
    edge, _, other_edge = measured.split("_")
    return round(left + EDGES[other_edge] * theirs - EDGES[edge] * own, 6)
