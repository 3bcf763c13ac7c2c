"""Start positions of actors: elements of `Init`, and the lane and pose they mean."""

from __future__ import annotations

import math

from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.actions.position.points_and_lines import points_along
from osc2tx.backends.xosc.actions.registry import at_start
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.declared_roads import segment_of
from osc2tx.backends.xosc.entities.relative_starts import beside
from osc2tx.backends.xosc.entities.start_lanes import at_pose, in_lane, lane_number, turned
from osc2tx.backends.xosc.entities.start_statements import Start, StartPlace, is_at_point
from osc2tx.backends.xosc.facts.maps import LanePosition, Pose
from osc2tx.backends.xosc.facts.start_places import TakenBy, given_place, open_place
from osc2tx.backends.xosc.report import Inexpressible, NoPlace
from osc2tx.backends.xosc.values.constants import Constant, Named

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
