"""Starts in or beside the lane of another actor, so far ahead of it or behind it."""

from __future__ import annotations

import math

from osc2tx.backends.xosc.actions.position.xml_positions import relative_lane
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.entities.start_lanes import (
    goes_straight,
    in_lane,
    lane_number,
    lateral_of,
    orientation_in_lane,
)
from osc2tx.backends.xosc.entities.start_statements import Start, StartPlace, speed_at_start
from osc2tx.backends.xosc.facts.actors import ALIGNED
from osc2tx.backends.xosc.facts.maps import Lane, LanePosition, Roads, place_along_road
from osc2tx.backends.xosc.facts.start_places import place_at_distance
from osc2tx.backends.xosc.report import Inexpressible, NoPlace
from osc2tx.backends.xosc.state import ActorState, known
from osc2tx_shared.classes import dataclass

NEAR = 1e-3
"""Metres between two places that count as one."""


@dataclass(frozen=True, slots=True)
class Said:
    """What is said about a start beside others.

    Attributes:
        in_lane_of: In or beside whose lane it is.
        lanes: How many to the left of that one.
        ahead_of: Ahead of whom it is.
        along: So far (m), negative: behind; without a reference along the road, if at all.
    """

    in_lane_of: CastMember | None
    lanes: int
    ahead_of: CastMember | None
    along: float | None

    @property
    def reference(self) -> CastMember:
        """Who is beside."""
        reference = self.ahead_of or self.in_lane_of
        assert reference is not None
        return reference

    @property
    def is_of_one(self) -> bool:
        """Whether it is relative to one actor alone."""
        if self.ahead_of is None:
            return self.along is None
        return self.in_lane_of is None or self.in_lane_of.name == self.ahead_of.name


def beside(ctx: Context, start: Start) -> StartPlace:
    """Return a place in or beside the lane of another actor, so far ahead of it or behind it."""
    said, number = _said(ctx, start), lane_number(start)
    if said.is_of_one:
        ctx.init_gaps[start.id, said.reference.name] = -(said.along or 0.0)
    if ctx.roads is None and number is None and said.is_of_one:
        return _relative(ctx, start, said, said.lanes, None)
    roads = ctx.required_roads("its lane needs", start.span)
    mine = _place(ctx, roads, said, number)
    lanes = _lanes_for_tools(ctx, roads, said, mine, said.lanes if number is None else None)
    if lanes is None or goes_straight(ctx, start):
        return in_lane(ctx, start, mine)
    return _relative(ctx, start, said, lanes, mine)


def _relative(
    ctx: Context, start: Start, said: Said, lanes: int, mine: LanePosition | None
) -> StartPlace:
    offset = lateral_of(ctx, start, mine)
    turn = orientation_in_lane(ctx, start, mine)
    along = said.along or 0.0
    position = relative_lane(ctx, said.reference.name, lanes, along, offset, turn)
    return position, ActorState(speed=known(0.0), offset=known(offset), lane=mine)


def _place(ctx: Context, roads: Roads, said: Said, number: Lane | None) -> LanePosition:
    """Return where it is, as the embedded world finds it."""
    place = _centre(ctx, roads, said.in_lane_of or said.reference)
    if said.lanes:
        side = "left" if said.lanes > 0 else "right"
        missing = f"there is no lane {abs(said.lanes)} to the {side} of lane {place.lane}"
        place = _found(roads.beside(place, said.lanes), missing)
    if said.along is not None and said.ahead_of is not None:
        origin, way = _centre(ctx, roads, said.ahead_of), "ahead" if said.along >= 0.0 else "back"
        missing = f"the lane does not reach {abs(said.along):g} m {way}"
        place = _found(place_at_distance(roads.map, place, origin, said.along), missing)
    elif said.along is not None:
        missing = f"lane {place.lane} does not lead to {said.along:g} m along its road"
        place = _found(place_along_road(roads.map, place, said.along), missing)
    if number is None:
        return place
    missing = f"there is no lane {number.number} beside {said.reference.name}"
    return _found(roads.with_number(place, number), missing)


def _found(place: LanePosition | None, otherwise: str) -> LanePosition:
    if place is None:
        raise NoPlace(otherwise)
    return place


def _centre(ctx: Context, roads: Roads, member: CastMember) -> LanePosition:
    """Return the place of an actor, on the centre of its driving lane."""
    pose = ctx.start_poses.get(member.name)
    if pose is None:
        raise Inexpressible(f"where {member.name} starts is not known")
    lane = ctx.states[member.name].lane or roads.map.locate(*pose[:3])
    if lane is None:
        raise NoPlace(f"{member.name} is not on a road, so it has no lane")
    return lane._replace(offset=0.0)


def _lanes_for_tools(
    ctx: Context, roads: Roads, said: Said, mine: LanePosition, lanes: int | None
) -> int | None:
    """Return how many lanes to the left tools count to a place; `None` if they do not get there.

    They go metres along the lane of the reference as it looks, and then across; the world measures
    along the way between the two, which is another one in a bend. XML 1.0 counts along the road,
    and so do some tools.
    """
    if not said.is_of_one:
        return None
    theirs, pose = _centre(ctx, roads, said.reference), ctx.start_poses[said.reference.name]
    on = roads.locate(*pose[:3])
    turn = math.remainder(pose.h - roads.map.pose(theirs).h, math.tau)
    if on is None or (on.road, on.lane) != (theirs.road, theirs.lane) or abs(turn) > ALIGNED:
        return None
    lanes = roads.lanes_between(theirs, mine) if lanes is None else lanes
    if lanes is None:
        return None
    is_old, along = ctx.version == "1.0", said.along or 0.0
    if is_old or ctx.profile.counts_along_roads:
        travel = roads.map.travel_direction(theirs.road, theirs.lane)
        is_there = mine.road == theirs.road and abs((mine.s - theirs.s) * travel - along) < NEAR
        return lanes if is_there and (travel > 0 or not is_old) else None
    ahead = roads.ahead(theirs, along)
    place = None if ahead is None else roads.beside(ahead, lanes)
    if place is None:
        return None
    there, here = roads.map.pose(place), roads.map.pose(mine)
    return lanes if math.dist(there[:2], here[:2]) < NEAR else None


def _said(ctx: Context, start: Start) -> Said:
    lane, position = start.modifiers.get("lane"), start.modifiers.get("position")
    in_lane_of, lanes = (None, 0) if lane is None else lane.beside_lane()
    if position is None:
        return Said(in_lane_of, lanes, None, None)
    reference, is_behind = position.ahead_of()
    distance = position.number("distance")
    time = position.number("time") if distance is None and reference is not None else None
    if time is not None and reference is not None:  # that the one behind drives in it
        theirs = ctx.states[reference.name].speed
        speed = speed_at_start(ctx, start) if is_behind else theirs.low if theirs else 0.0
        distance = time * speed
    if distance is None:
        raise Inexpressible("no distance is stated", position.source.span)
    return Said(in_lane_of, lanes, reference, -distance if is_behind else distance)
