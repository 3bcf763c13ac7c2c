"""Points, paths, trajectories and routes of the scenario: each may be made of the others."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from osc2tx.backends.xosc.actions.position.xml_positions import (
    XmlPosition,
    at_world,
    number_of,
    on_earth,
    on_road,
    parts_of,
    world_position,
)
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.declared_roads import segment_of
from osc2tx.backends.xosc.facts.curves import Line, Waypoint, sample_curve, thinned
from osc2tx.backends.xosc.facts.map_search import MapSegment, crossing_of, graph_of, points_of_route
from osc2tx.backends.xosc.facts.maps import LanePosition, Pose
from osc2tx.backends.xosc.values.constants import Constant, Member, MethodResult, Named
from osc2tx.losses.entries import Inexpressible
from osc2tx_shared.classes import replace

MADE = {
    "create_odr_point": "odr_point",
    "odr_to_route_point": "odr_point",
    "create_route_point": "route_point",
    "create_xyz_point": "position_3d",
}
"""Methods -> the type of point that has parts like their parameters."""

GLOBAL = ("latitude", "longitude", "altitude")

STRAIGHT = 0.01
"""Metres beside the straight line through its neighbours within which a point is left out."""


def xml_position(ctx: Context, point: Constant | None) -> XmlPosition:
    """Return the place of a point."""
    part = parts_of(ctx, point, "point")
    if isinstance(point, MethodResult):
        if point.method not in MADE:
            raise Inexpressible(f"`{point.method}` makes no place that is known before the run")
        kind = MADE[point.method]
    else:
        assert isinstance(point, Named)
        kind = ctx.values.type_of(point.name)
    match kind:
        case "route_point":
            return _on_route(ctx, part("route"), number_of(part("s")), number_of(part("t")))
        case "position_3d":
            return at_world(ctx, *(number_of(part(name)) for name in "xyz"))
        case "xyz_point":
            return at_world(ctx, *(number_of(part("position", name)) for name in "xyz"))
        case "odr_point":
            s, t = number_of(part("s")), number_of(part("t"))
            return on_road(ctx, part("road_id"), part("lane_id"), s, t)
        case "geodetic_point" | "geodetic_position_2d":
            return on_earth(ctx, *(number_of(part(name)) for name in GLOBAL))
    raise Inexpressible(f"a `{kind}` is no place that the map alone gives")


def _on_route(ctx: Context, route: Constant | None, s: float, left: float) -> XmlPosition:
    """Return a place so far (m) along a route and beside it."""
    place = next(points_along(ctx, route, s))
    if not isinstance(place, LanePosition):
        x, y = place.x - left * math.sin(place.h), place.y + left * math.cos(place.h)
        pose = Pose(x, y, place.z, place.h)
        return XmlPosition(world_position(pose), None, pose)
    assert ctx.roads is not None  # the route was found on it
    offset = left * ctx.roads.map.travel_direction(place.road, place.lane)
    return on_road(ctx, place.road, str(place.lane), place.s, offset)


def points_along(
    ctx: Context, route: Constant | None, offset: float
) -> Iterator[LanePosition | Pose]:
    """Yield the places so far (m) along a path, or along each lane in which a route begins.

    Raises:
        Inexpressible: They are not known before the run, or it ends before.
    """
    roads = ctx.required_roads()
    segment = segment_of(ctx, route)
    if segment is not None and crossing_of(segment) is None:
        for begin in graph_of(roads.map).beginnings(segment):
            place = roads.ahead(begin, offset)
            if place is None:
                raise Inexpressible(f"the route ends before {offset:g} m")
            yield place
        return
    line = line_of_route(ctx, route)
    first = sample_curve(Line(line.points, offsets=(offset, 0.0)))[0]
    on = roads.locate(first.x, first.y, first.z)
    heading = 0.0 if first.h is None else round(first.h, 9)
    yield on or Pose(round(first.x, 6), round(first.y, 6), round(first.z, 6), heading)


def line_of_route(ctx: Context, route: Constant | None) -> Line:
    """Return a path, or the way that a route which is put together leads along."""
    segment = segment_of(ctx, route)
    ends = None if segment is None else crossing_of(segment)
    if ends is not None:
        return Line(ends)
    if not isinstance(route, MethodResult) or route.method != "create_route":
        return line_of(ctx, route)
    given, connect = route.get("routes"), route.get("connect_points_by")
    if not isinstance(given, tuple):
        raise Inexpressible("the route is only known during the run")
    elements = [_element(ctx, each) for each in given]
    kind = connect.name if isinstance(connect, Member) else "waypoint"
    points = points_of_route(ctx.required_roads(), elements, kind)
    return Line(thinned(points, is_timed=False, tolerance=STRAIGHT))


def _element(
    ctx: Context, value: Constant
) -> LanePosition | Pose | MapSegment | Sequence[Waypoint]:
    """Return what a route is put together from."""
    segment = segment_of(ctx, value)
    if segment is not None:
        return segment
    if isinstance(value, Named) and ctx.values.type_of(value.name) == "path":
        return line_of(ctx, value).points
    position = xml_position(ctx, value)
    place = position.pose if position.lane is None else position.lane
    if place is None:
        raise Inexpressible("a point of the route needs the map, which is not at hand")
    return place


def line_of(ctx: Context, value: Constant | None) -> Line:
    """Return a path or trajectory."""
    part = parts_of(ctx, value, "way")
    method = value.method if isinstance(value, MethodResult) else ""
    if method.startswith("resolve_relative_"):
        inner = part("relative_path") or part("relative_trajectory")
        return relative_line(ctx, inner, part("transform"), part("reference"))
    points, times, joined = part("points"), part("time_stamps"), part("interpolation")
    if not isinstance(points, tuple):
        raise Inexpressible("the way is only known during the run")
    if method in ("", "create_path", "create_trajectory"):
        found = [_pose(ctx, each) for each in points]
    else:
        positions = [xml_position(ctx, point) for point in points]
        if part("on_road_network") is True:
            places = [position.lane for position in positions if position.lane is not None]
            if ctx.roads is None or len(places) != len(positions) or times is not None:
                raise Inexpressible("a way along lanes needs the map, and points on lanes")
            return Line(ctx.roads.along(places), is_smooth=True)
        poses = [position.pose for position in positions if position.pose is not None]
        if len(poses) != len(positions):
            raise Inexpressible("a point of the way needs the map, which is not at hand")
        found = [Waypoint(0.0, pose.x, pose.y, pose.z) for pose in poses]
    if times is not None:
        if not isinstance(times, tuple) or len(times) != len(found):
            raise Inexpressible("points and time stamps of the trajectory do not fit each other")
        stamps = map(number_of, times)
        found = [point._replace(time=t) for point, t in zip(found, stamps, strict=True)]
    is_smooth = isinstance(joined, Member) and joined.name == "smooth"
    return Line(tuple(found), is_smooth, times is not None)


def _pose(ctx: Context, pose: Constant) -> Waypoint:
    if not isinstance(pose, Named) or ctx.values.type_of(pose.name) != "pose_3d":
        raise Inexpressible("a point of the way is no pose")
    x, y, z = (number_of(ctx.values.field(pose.name, "position", name)) for name in "xyz")
    yaw = ctx.values.field(pose.name, "orientation", "yaw")
    return Waypoint(0.0, x, y, z, None if yaw is None else number_of(yaw))


def relative_line(
    ctx: Context, value: Constant | None, transform: Constant | None, reference: Constant | None
) -> Line:
    """Return a path or trajectory relative to an actor."""
    line = line_of(ctx, value)
    frame = transform.name if isinstance(transform, Member) else "object_relative"
    if not isinstance(reference, Named) or reference.name not in ctx.cast:
        raise Inexpressible("the way is relative to something that is no entity of the XML")
    name = ctx.cast[reference.name].name
    return replace(line, frame=frame, reference=name)
