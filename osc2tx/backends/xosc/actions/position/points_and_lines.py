"""Points, paths, trajectories and routes of the scenario: each may be made of the others."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from osc2tx.backends.xosc.actions.position.xml_positions import (
    UNKNOWN,
    XmlPosition,
    at_world,
    number_of,
    on_earth,
    on_road,
    parts_of,
    world_position,
)
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.declared_roads import required_roads, segment_of
from osc2tx.backends.xosc.facts.curves import Line, Waypoint, sample_curve
from osc2tx.backends.xosc.facts.map_search import (
    MapSegment,
    crossing_of,
    graph_of,
    points_of_route,
)
from osc2tx.backends.xosc.facts.maps import LanePosition, Pose
from osc2tx.backends.xosc.report import Inexpressible
from osc2tx.backends.xosc.values.constants import Constant, Member, MethodResult, Named
from osc2tx_shared.classes import replace

STRAIGHT = 0.01
"""Metres beside the straight line through its neighbours within which a point is left out."""


def xml_position(ctx: Context, point: Constant | None) -> XmlPosition:
    """Return the place of a point.

    Raises:
        Inexpressible: It is not known before the run.
    """
    kind, parts = parts_of(ctx, point)
    match kind:
        case "route_point":
            return _on_route(ctx, parts)
        case "position_3d" | "xyz":
            x, y, z = (number_of(parts.get(name)) for name in "xyz")
            return at_world(ctx, x, y, z)
        case "odr_point":
            return on_road(ctx, parts)
        case "geodetic_point" | "geodetic_position_2d":
            return on_earth(ctx, parts)
    raise Inexpressible(UNKNOWN)


def _on_route(ctx: Context, parts: dict[str, Constant]) -> XmlPosition:
    """Return a place along a route and beside it."""
    place = next(points_along(ctx, parts.get("route"), number_of(parts.get("s"))))
    left = number_of(parts.get("t"))
    if not isinstance(place, LanePosition):
        x, y = place.x - left * math.sin(place.h), place.y + left * math.cos(place.h)
        pose = Pose(x, y, place.z, place.h)
        return XmlPosition(world_position(pose), None, pose)
    assert ctx.roads is not None  # the route was found on it
    offset = left * ctx.roads.map.travel_direction(place.road, place.lane)
    where: dict[str, Constant] = {"road_id": place.road, "lane_id": str(place.lane)}
    return on_road(ctx, {**where, "s": place.s, "t": offset})


def points_along(
    ctx: Context, route: Constant | None, offset: float
) -> Iterator[LanePosition | Pose]:
    """Yield the places so far (m) along a path, or along each lane in which a route begins.

    Raises:
        Inexpressible: They are not known before the run, or it ends before.
    """
    roads = required_roads(ctx)
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
    points = points_of_route(required_roads(ctx), elements, kind)
    return Line(tuple(_thinned(points)))


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


def _thinned(points: Sequence[Waypoint]) -> list[Waypoint]:
    """Leave out points of a way that say nothing."""
    kept = list(points[:1])
    for index in range(1, len(points) - 1):
        between = points[points.index(kept[-1]) + 1 : index + 1]
        if any(_beside(kept[-1], points[index + 1], each) > STRAIGHT for each in between):
            kept.append(points[index])
    return [*kept, *points[len(points) - 1 :]] if len(points) > 1 else kept


def _beside(a: Waypoint, b: Waypoint, point: Waypoint) -> float:
    """Return how far (m) a point is from the straight line between two others."""
    length = math.hypot(b.x - a.x, b.y - a.y)
    if length == 0.0:
        return math.hypot(point.x - a.x, point.y - a.y)
    return abs((b.x - a.x) * (point.y - a.y) - (b.y - a.y) * (point.x - a.x)) / length


def line_of(ctx: Context, value: Constant | None) -> Line:
    """Return a path or trajectory.

    Raises:
        Inexpressible: It is not known before the run.
    """
    if isinstance(value, MethodResult):
        if value.method.startswith("resolve_relative_"):
            inner = value.get("relative_path") or value.get("relative_trajectory")
            return relative_line(ctx, inner, value.get("transform"), value.get("reference"))
        return _made_line(ctx, value)
    if not isinstance(value, Named):
        raise Inexpressible("the way is only known during the run")
    fields = (ctx.values.field(value.name, name) for name in ("points", "time_stamps"))
    points, times = fields
    joined = ctx.values.field(value.name, "interpolation")
    return Line(_posed(ctx, points, times), _is_smooth(joined), times is not None)


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


def _made_line(ctx: Context, made: MethodResult) -> Line:
    points, times = made.get("points"), made.get("time_stamps")
    smooth = _is_smooth(made.get("interpolation"))
    if made.method in ("create_path", "create_trajectory"):
        return Line(_posed(ctx, points, times), smooth, times is not None)
    if not isinstance(points, tuple):
        raise Inexpressible("the way is only known during the run")
    positions = [xml_position(ctx, point) for point in points]
    if made.get("on_road_network") is True:
        places = [position.lane for position in positions if position.lane is not None]
        if ctx.roads is None or len(places) != len(positions) or times is not None:
            raise Inexpressible("a way along lanes needs the map, and points on lanes")
        return Line(ctx.roads.along(places), is_smooth=True)
    poses = [position.pose for position in positions if position.pose is not None]
    if len(poses) != len(positions):
        raise Inexpressible("a point of the way needs the map, which is not at hand")
    stamps = _stamps(times, len(poses))
    found = (
        Waypoint(time, pose.x, pose.y, pose.z) for time, pose in zip(stamps, poses, strict=True)
    )
    return Line(tuple(found), smooth, times is not None)


def _posed(ctx: Context, points: Constant | None, times: Constant | None) -> tuple[Waypoint, ...]:
    if not isinstance(points, tuple):
        raise Inexpressible("the way is only known during the run")
    stamps = _stamps(times, len(points))
    return tuple(_pose(ctx, each, t) for each, t in zip(points, stamps, strict=True))


def _pose(ctx: Context, pose: Constant, time: float) -> Waypoint:
    if not isinstance(pose, Named) or ctx.values.type_of(pose.name) != "pose_3d":
        raise Inexpressible("a point of the way is no pose")
    position = ctx.values.field(pose.name, "position")
    owner, path = (position.name, ()) if isinstance(position, Named) else (pose.name, ("position",))
    x, y, z = (number_of(ctx.values.field(owner, *path, name)) for name in "xyz")
    turned = ctx.values.field(pose.name, "orientation")
    if isinstance(turned, Named):
        yaw = ctx.values.field(turned.name, "yaw")
    else:
        yaw = ctx.values.field(pose.name, "orientation", "yaw")
    return Waypoint(time, x, y, z, None if yaw is None else number_of(yaw))


def _stamps(times: Constant | None, count: int) -> tuple[float, ...]:
    if times is None:
        return (0.0,) * count
    if not isinstance(times, tuple) or len(times) != count:
        raise Inexpressible("points and time stamps of the trajectory do not fit each other")
    return tuple(number_of(time) for time in times)


def _is_smooth(joined: Constant | None) -> bool:
    return isinstance(joined, Member) and joined.name == "smooth"
