"""Start positions of actors: elements of `Init`, and the lane and pose they mean."""

from __future__ import annotations

import math

from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.actions.position.points_and_lines import points_along
from osc2tx.backends.xosc.actions.position.xml_positions import relative_lane
from osc2tx.backends.xosc.actions.registry import at_start
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.entities.declared_roads import segment_of
from osc2tx.backends.xosc.entities.start_lanes import (
    at_pose,
    goes_straight,
    in_lane,
    lane_number,
    lateral_of,
    orientation_in_lane,
    turned,
)
from osc2tx.backends.xosc.entities.start_statements import (
    Start,
    StartPlace,
    is_at_point,
    speed_at_start,
)
from osc2tx.backends.xosc.facts.actors import ALIGNED
from osc2tx.backends.xosc.facts.maps import Lane, LanePosition, Pose, Roads, place_along_road
from osc2tx.backends.xosc.facts.start_places import (
    TakenBy,
    given_place,
    open_place,
    place_at_distance,
)
from osc2tx.backends.xosc.state import ActorState, known
from osc2tx.backends.xosc.values.constants import Constant, Named
from osc2tx.losses.entries import Inexpressible, NoPlace
from osc2tx_shared.classes import dataclass

at_start("location", "position", "along", "lane", "lateral", "on_path")


def position_of(ctx: Context, start: Start, taken_by: TakenBy) -> StartPlace:
    """Return the position of an actor at the start, and what is known about the actor there.

    Raises:
        NoPlace: There is no such place.
        Inexpressible: The XML has no such position, or it is not known before the run.
    """
    location, position = start.modifiers.get("location"), start.modifiers.get("position")
    if start.spawn is not None and (
        start.is_beside or location is not None or position is not None
    ):
        raise Inexpressible(
            "the scenario states where it starts, so --spawn does not apply", start.span
        )
    path = start.modifiers.get("on_path")
    road = None if path is None else path.get("path")  # matters only to who has no other place
    if location is not None:
        return _at_pose(ctx, start, location)
    if position is not None and is_at_point(position):
        return _at_point(ctx, start, position)
    if start.is_beside:
        return beside(ctx, start)
    along = start.modifiers.get("along")
    if along is not None:
        return _on_route(ctx, start, along, taken_by)
    return _on_road(ctx, start, road, taken_by)


def _at_pose(ctx: Context, start: Start, location: Arguments) -> StartPlace:
    pose = location.get("pose")
    if not isinstance(pose, Named):
        raise Inexpressible("the pose is not known before the run", location.source.span)
    number_in = ctx.values.number_in
    x, y, z = (number_in(pose.name, "position", axis) or 0.0 for axis in "xyz")
    yaw, pitch, roll = (number_in(pose.name, "orientation", n) for n in ("yaw", "pitch", "roll"))
    return at_pose(Pose(x, y, z, yaw or 0.0), pitch, roll)


def _at_point(ctx: Context, start: Start, position: Arguments) -> StartPlace:
    if "at_point" in position:
        point = position.get("at_point")
        if not isinstance(point, Named):
            raise Inexpressible("the point is not known before the run", position.source.span)
        x, y, z = (ctx.values.number_in(point.name, axis) or 0.0 for axis in "xyz")
        if position.get("project_on_route") is not False:
            return _near_point(ctx, start, (x, y, z))
        said = None
    else:
        x, y, z = (position.number(name) or 0.0 for name in "xyz")
        said = position.number("h")
        if position.text("frame") == "carla":  # left-handed, and of the centre of the box
            said, back = -(said or 0.0), start.member.shape.centre
            x, y = x - back * math.cos(said), -y - back * math.sin(said)
    along = _heading_at(ctx, start, (x, y, z), said)
    heading, pitch, roll = turned(ctx, start, along)
    return at_pose(Pose(x, y, z, heading), pitch, roll)


def _heading_at(
    ctx: Context, start: Start, point: tuple[float, float, float], said: float | None
) -> float:
    """Return the heading (rad) of who is put to a point; a vehicle looks along the lane there."""
    if ctx.roads is None:
        return said or 0.0
    on = ctx.roads.locate(*point)
    along = ctx.roads.direction_at(*point) if on is None else ctx.roads.map.pose(on).h
    if said is None:
        return along
    is_in_lane = on is not None and not start.member.walks and math.cos(along - said) > 0.0
    return along if is_in_lane else said


def _near_point(ctx: Context, start: Start, point: tuple[float, float, float]) -> StartPlace:
    """Return the place in the lane that is nearest to a point, or in one of the same road."""
    near = ctx.required_roads().map.locate(*point)
    if near is None:
        raise Inexpressible(f"there is no lane near ({point[0]:g}, {point[1]:g})", start.span)
    return in_lane(ctx, start, _numbered(ctx, start, LanePosition(near.road, near.lane, near.s)))


def _numbered(ctx: Context, start: Start, place: LanePosition) -> LanePosition:
    """Return the lane that a modifier numbers, at a place."""
    lane = lane_number(start)
    if lane is None:
        return place
    numbered = ctx.required_roads().with_number(place, lane)
    if numbered is None:
        span = start.modifiers["lane"].source.span
        raise Inexpressible(f"there is no lane {lane.number} at that place", span)
    return numbered


def _on_route(ctx: Context, start: Start, along: Arguments, taken_by: TakenBy) -> StartPlace:
    """Return the place at which a route begins, or so far from there; in a free lane of it."""
    lane, position = start.modifiers.get("lane"), start.modifiers.get("position")
    offset = along.number("start_offset") or 0.0
    along.number("end_offset")
    offset += 0.0 if position is None else position.number("distance") or 0.0
    for place in points_along(ctx, along.get("route"), offset):
        if not isinstance(place, LanePosition):
            if lane is not None:
                raise Inexpressible("a lane of a way off the lanes", lane.source.span)
            return at_pose(place, None, None)
        if lane is not None or taken_by(place) is None:
            return in_lane(ctx, start, _numbered(ctx, start, place))
    raise NoPlace(f"the route has no free lane {offset:g} m along it")


def _on_road(ctx: Context, start: Start, road: Constant | None, taken_by: TakenBy) -> StartPlace:
    name, position, lane = start.id, start.modifiers.get("position"), lane_number(start)
    spawn = start.spawn
    if ctx.roads is None and spawn is not None:
        return in_lane(ctx, start, spawn)
    what = "its start" if lane is None else f"lane {lane.number}"
    what = f"the path of {name}" if road is not None else what
    otherwise = f", or the place with --spawn {name}=…"
    roads = ctx.required_roads(f"{what} needs", start.span, otherwise)
    if spawn is not None:
        return in_lane(ctx, start, given_place(roads, name, spawn, lane))
    distance = None if position is None else position.number("distance")
    segment = segment_of(ctx, road)
    return in_lane(ctx, start, open_place(roads, name, lane, distance, segment, taken_by))


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
