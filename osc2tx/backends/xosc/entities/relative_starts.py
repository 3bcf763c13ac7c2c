"""Starts in or beside the lane of another actor, so far ahead of it or behind it."""

from __future__ import annotations

import math

from osc2tx.backends.xosc.actions.leaf import Arguments
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.entities.declared_roads import required_roads
from osc2tx.backends.xosc.entities.start_lanes import in_lane, lateral_of
from osc2tx.backends.xosc.entities.start_orientations import orientation_in_lane
from osc2tx.backends.xosc.entities.start_statements import Start, speed_at_start
from osc2tx.backends.xosc.facts.maps import LanePosition
from osc2tx.backends.xosc.facts.start_places import place_beside
from osc2tx.backends.xosc.report import Inexpressible
from osc2tx.backends.xosc.state import ActorState, known
from osc2tx.backends.xosc.xml.tree import Element, element

NEAR = 1e-3
"""Metres between two places that count as one."""


def beside(ctx: Context, start: Start) -> tuple[Element, ActorState]:
    """Return a place in or beside the lane of another actor, so far ahead of it or behind it."""
    lane, position = start.modifiers.get("lane"), start.modifiers.get("position")
    along, ahead_of = _along(ctx, start, position)
    lanes, in_lane_of = _lanes_beside(ctx, lane, ahead_of)
    reference = ahead_of or in_lane_of
    span = start.span
    if reference is None or (in_lane_of is not None and in_lane_of is not reference):
        raise Inexpressible("it starts relative to several actors", span)
    theirs = ctx.states[reference.name]
    ctx.init_gaps[start.member.name, reference.name] = -along
    mine = None
    if ctx.roads is not None and theirs.lane is not None:
        mine = place_beside(ctx.roads, theirs.lane, lanes, along)
        if not _is_where_tools_put_it(ctx, theirs.lane, lanes, along, mine):
            return in_lane(ctx, start, mine)
    offset = lateral_of(ctx, start, mine)
    state = ActorState(speed=known(0.0), offset=known(offset), lane=mine)
    turn = orientation_in_lane(ctx, start, mine)
    distance = {"ds" if ctx.version == "1.0" else "dsLane": along}
    name = reference.name
    relative = element(
        "RelativeLanePosition", turn, entityRef=name, dLane=lanes, **distance, offset=offset
    )
    return relative, state


def _is_where_tools_put_it(
    ctx: Context, theirs: LanePosition, lanes: int, along: float, mine: LanePosition
) -> bool:
    """Whether metres along the lane of a reference, then across, lead to a place.

    In a bend they do not: the world measures along the way between the two.
    """
    roads = required_roads(ctx)
    if ctx.version == "1.0":  # it counts along the reference line
        leads_along = roads.map.travel_direction(theirs.road, theirs.lane) > 0
        return leads_along and mine.road == theirs.road and abs(mine.s - theirs.s - along) < NEAR
    ahead = roads.ahead(theirs, along)
    place = None if ahead is None else roads.beside(ahead, lanes)
    if place is None:
        return False
    there, here = roads.pose(place), roads.pose(mine)
    return math.dist(there[:2], here[:2]) < NEAR


def _lanes_beside(
    ctx: Context, lane: Arguments | None, reference: CastMember | None
) -> tuple[int, CastMember | None]:
    if lane is None:
        return 0, None
    same = lane.entity("same_as")
    if same is not None:
        return 0, same
    beside = lane.entity("side_of")
    number = lane.number("lane")
    count = 1 if number is None else round(number)
    if beside is None and reference is not None:
        return _lanes_to_number(ctx, lane, reference, count), reference
    if beside is None:
        raise Inexpressible("a lane without a place along the road", lane.source.span)
    return (count if lane.member("side", "left") == "left" else -count), beside


def _lanes_to_number(ctx: Context, lane: Arguments, reference: CastMember, number: int) -> int:
    """Return how many lanes to the left of a reference the lane with a number is."""
    theirs = ctx.states[reference.name].lane
    if ctx.roads is None or theirs is None:
        raise Inexpressible(
            f"a numbered lane needs the map {ctx.map_file}, which is not at hand: give its folder"
            " with --map-path",
            lane.source.span,
        )
    target = ctx.roads.with_number(theirs, number, lane.member("from", "right"))
    between = None if target is None else ctx.roads.lanes_between(theirs, target)
    if between is None:
        raise Inexpressible(f"there is no lane {number} beside {reference.name}", lane.source.span)
    return between


def _along(
    ctx: Context, start: Start, position: Arguments | None
) -> tuple[float, CastMember | None]:
    """Return the distance (m, positive ahead) and from whom."""
    if position is None:
        return 0.0, None
    ahead, behind = position.entity("ahead_of"), position.entity("behind")
    reference = ahead or behind
    if reference is None:
        raise Inexpressible(
            "a distance along the road in the lane of an actor", position.source.span
        )
    distance = position.number("distance")
    if distance is None:
        time = position.number("time")
        if time is None:
            raise Inexpressible("it says no distance", position.source.span)
        theirs = ctx.states[reference.name].speed
        own = speed_at_start(ctx, start)
        distance = time * (own if behind else theirs.low if theirs is not None else 0.0)
    return (distance if ahead is not None else -distance), reference
