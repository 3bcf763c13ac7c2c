"""Starts in a lane, and across it."""

from __future__ import annotations

from osc2tx.backends.xosc.actions.lateral_offsets import offset_in_lane
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.start_orientations import orientation_in_lane
from osc2tx.backends.xosc.entities.start_statements import Start
from osc2tx.backends.xosc.facts.maps import LanePosition
from osc2tx.backends.xosc.state import ActorState, known
from osc2tx.backends.xosc.xml.tree import Element, element


def in_lane(ctx: Context, start: Start, place: LanePosition) -> tuple[Element, ActorState]:
    """Return the place in a lane; where it is across the lane and turned to comes from others."""
    offset = lateral_of(ctx, start, place)
    sign = 1.0 if place.lane < 0 else -1.0
    element_ = element(
        "LanePosition",
        orientation_in_lane(ctx, start, place),
        roadId=place.road,
        laneId=place.lane,
        s=place.s,
        offset=round(sign * offset, 6),
    )
    known_lane = place if ctx.roads is not None else None
    return element_, ActorState(speed=known(0.0), offset=known(offset), lane=known_lane)


def lateral_of(ctx: Context, start: Start, place: LanePosition | None) -> float:
    """Return how far (m) left of the centre of its lane an actor starts."""
    lateral = start.modifiers.get("lateral")
    if lateral is None:
        return 0.0 if place is None else round(place.offset, 6)
    return offset_in_lane(ctx, lateral, start.member, place)
