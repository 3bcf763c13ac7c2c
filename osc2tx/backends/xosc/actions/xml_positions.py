"""Points, paths and trajectories of the scenario, as places of the XML."""

from __future__ import annotations

import math
from dataclasses import dataclass

from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.facts.curves import Waypoint
from osc2tx.backends.xosc.facts.maps import LanePosition, Pose
from osc2tx.backends.xosc.report import Inexpressible
from osc2tx.backends.xosc.values.constants import Constant, Made, Member, Named
from osc2tx.backends.xosc.xml.tree import Element, element

REACHED = 1.0
"""Metres from a place that count as being there; a step of a run is about as long."""

GLOBE = "GeoPosition"

UNKNOWN = "the point is only known during the run"


@dataclass(frozen=True, slots=True)
class Spot:
    """A place.

    Attributes:
        element: Below `Position`.
        lane: The lane it is on; `None` if unknown, or on none.
        pose: Where it is in the world, if that is known.
    """

    element: Element
    lane: LanePosition | None
    pose: Pose | None


def spot_of(ctx: Context, point: Constant | None) -> Spot:
    """Return the place of a point.

    Raises:
        Inexpressible: It is not known before the run.
    """
    kind, parts = _parts(ctx, point)
    match kind:
        case "route_point":
            return _on_route(ctx, parts)
        case "position_3d" | "xyz":
            x, y, z = (_number(parts.get(name)) for name in "xyz")
            return at_world(ctx, x, y, z)
        case "odr_point":
            return _on_road(ctx, parts)
        case "geodetic_point" | "geodetic_position_2d":
            return _on_earth(ctx, parts)
    raise Inexpressible(UNKNOWN)


def at_world(ctx: Context, x: float, y: float, z: float) -> Spot:
    """Return a place in the world; whoever is there looks along the road."""
    lane = None if ctx.roads is None else ctx.roads.locate(x, y, z)
    heading = 0.0 if ctx.roads is None else ctx.roads.direction_at(x, y, z)
    pose = Pose(x, y, z, heading)
    return Spot(world_position(pose), lane, pose)


def at_place(ctx: Context, place: Element) -> Element:
    """Return the condition to be at a place."""
    return element(
        "DistanceCondition",
        element("Position", place),
        value=REACHED,
        freespace=False,
        rule="lessThan",
        alongRoute=False if ctx.version == "1.0" else None,
    )


def world_position(pose: Pose) -> Element:
    """Return the element of a pose in the world."""
    return element(
        "WorldPosition",
        x=round(pose.x, 6),
        y=round(pose.y, 6),
        z=round(pose.z, 6),
        h=round(pose.h, 9),
        p=round(pose.pitch, 9) or None,
        r=round(pose.roll, 9) or None,
    )


def _on_road(ctx: Context, parts: dict[str, Constant]) -> Spot:
    road, lane = parts.get("road_id"), parts.get("lane_id")
    s, t = _number(parts.get("s")), _number(parts.get("t"))
    if not isinstance(road, str):
        raise Inexpressible("the point names no road")
    if not isinstance(lane, str) or lane == "":
        return Spot(element("RoadPosition", roadId=road, s=s, t=t), None, None)
    if not lane.removeprefix("-").isdecimal():
        raise Inexpressible(f"`{lane}` is no number of a lane")
    number = int(lane)
    place = element("LanePosition", roadId=road, laneId=number, s=s, offset=t or None)
    if ctx.roads is None:
        return Spot(place, None, None)
    left = t * ctx.roads.map.travel_direction(road, number)
    on = LanePosition(road, number, s, left)
    return Spot(place, on, ctx.roads.pose(on))


def _on_route(ctx: Context, parts: dict[str, Constant]) -> Spot:
    """Return a place along a route and beside it."""
    from osc2tx.backends.xosc.actions.routes import (
        start_of_way,  # routes are made of points themselves
    )

    place = start_of_way(ctx, parts.get("route"), _number(parts.get("s")))
    left = _number(parts.get("t"))
    if not isinstance(place, LanePosition):
        x, y = place.x - left * math.sin(place.h), place.y + left * math.cos(place.h)
        pose = Pose(x, y, place.z, place.h)
        return Spot(world_position(pose), None, pose)
    assert ctx.roads is not None  # the route was found on it
    offset = left * ctx.roads.map.travel_direction(place.road, place.lane)
    where: dict[str, Constant] = {"road_id": place.road, "lane_id": str(place.lane)}
    return _on_road(ctx, {**where, "s": place.s, "t": offset})


def _on_earth(ctx: Context, parts: dict[str, Constant]) -> Spot:
    """Return a place on the globe; where the map says where it lies, its place in the world too."""
    latitude, longitude = _number(parts.get("latitude")), _number(parts.get("longitude"))
    altitude = _number(parts.get("altitude"))
    pose = None if ctx.roads is None else ctx.roads.on_earth(latitude, longitude, altitude)
    if pose is not None and not ctx.can(GLOBE, "1.1"):
        return at_world(ctx, pose.x, pose.y, pose.z)
    ctx.require("a geodetic position", "1.1")
    ctx.require_support(GLOBE)
    lane = None
    if ctx.roads is not None and pose is not None:
        lane = ctx.roads.locate(pose.x, pose.y, pose.z)
    place = element(
        GLOBE,
        latitudeDeg=round(math.degrees(latitude), 9),
        longitudeDeg=round(math.degrees(longitude), 9),
        altitude=altitude or None,
    )
    if ctx.version == "1.1":
        place = element(GLOBE, latitude=latitude, longitude=longitude, height=altitude or None)
    return Spot(place, lane, pose)


def _parts(ctx: Context, point: Constant | None) -> tuple[str, dict[str, Constant]]:
    """Return the kind of a point and its coordinates."""
    if isinstance(point, Made):
        given = dict(point.arguments)
        if point.method in ("create_odr_point", "odr_to_route_point"):
            return "odr_point", given
        if point.method == "create_route_point":
            return "route_point", given
        if point.method == "create_xyz_point":
            return "xyz", given
        raise Inexpressible(f"`{point.method}` makes no place that is known before the run")
    if not isinstance(point, Named):
        raise Inexpressible(UNKNOWN)
    kind = ctx.values.type_of(point.name)
    names = {
        "position_3d": "xyz",
        "odr_point": ("road_id", "lane_id", "s", "t"),
        "route_point": ("route", "s", "t"),
        "geodetic_point": ("latitude", "longitude", "altitude"),
        "geodetic_position_2d": ("latitude", "longitude"),
    }
    if kind == "xyz_point":
        inner = ctx.values.field(point.name, ("position",))
        if inner is not None:
            return _parts(ctx, inner)
        found = {name: ctx.values.field(point.name, ("position", name)) for name in "xyz"}
        return "xyz", {name: value for name, value in found.items() if value is not None}
    if kind not in names:
        raise Inexpressible(f"a `{kind}` is no place that the map alone gives")
    fields = {name: ctx.values.field(point.name, (name,)) for name in names[kind]}
    return kind, {name: value for name, value in fields.items() if value is not None}


def _number(value: Constant | None) -> float:
    if value is None:
        return 0.0
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise Inexpressible(UNKNOWN)
    return float(value)


# --- paths and trajectories ---------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Line:
    """A path or a trajectory.

    Attributes:
        points: Its points, in the world or relative to a reference.
        is_smooth: It has no corners.
        is_timed: It is a trajectory.
        frame: `None`: the world; else how its points are relative.
        reference: Relative to whom.
    """

    points: tuple[Waypoint, ...]
    is_smooth: bool
    is_timed: bool
    frame: str | None = None
    reference: str | None = None


def line_of(ctx: Context, value: Constant | None) -> Line:
    """Return a path or trajectory.

    Raises:
        Inexpressible: It is not known before the run.
    """
    if isinstance(value, Made):
        if value.method.startswith("resolve_relative_"):
            inner = value.get("relative_path") or value.get("relative_trajectory")
            return relative_line(ctx, inner, value.get("transform"), value.get("reference"))
        return _made_line(ctx, value)
    if not isinstance(value, Named):
        raise Inexpressible("the way is only known during the run")
    fields = (ctx.values.field(value.name, (name,)) for name in ("points", "time_stamps"))
    points, times = fields
    joined = ctx.values.field(value.name, ("interpolation",))
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
    return Line(line.points, line.is_smooth, line.is_timed, frame, name)


def _made_line(ctx: Context, made: Made) -> Line:
    points, times = made.get("points"), made.get("time_stamps")
    smooth = _is_smooth(made.get("interpolation"))
    if made.method in ("create_path", "create_trajectory"):
        return Line(_posed(ctx, points, times), smooth, times is not None)
    if not isinstance(points, tuple):
        raise Inexpressible("the way is only known during the run")
    spots = [spot_of(ctx, point) for point in points]
    if made.get("on_road_network") is True:
        places = [spot.lane for spot in spots if spot.lane is not None]
        if ctx.roads is None or len(places) != len(spots) or times is not None:
            raise Inexpressible("a way along lanes needs the map, and points on lanes")
        return Line(ctx.roads.along(places), True, False)
    poses = [spot.pose for spot in spots if spot.pose is not None]
    if len(poses) != len(spots):
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
    position = ctx.values.field(pose.name, ("position",))
    owner, path = (position.name, ()) if isinstance(position, Named) else (pose.name, ("position",))
    x, y, z = (_number(ctx.values.field(owner, (*path, name))) for name in "xyz")
    turned = ctx.values.field(pose.name, ("orientation",))
    if isinstance(turned, Named):
        yaw = ctx.values.field(turned.name, ("yaw",))
    else:
        yaw = ctx.values.field(pose.name, ("orientation", "yaw"))
    return Waypoint(time, x, y, z, None if yaw is None else _number(yaw))


def _stamps(times: Constant | None, count: int) -> tuple[float, ...]:
    if times is None:
        return (0.0,) * count
    if not isinstance(times, tuple) or len(times) != count:
        raise Inexpressible("points and time stamps of the trajectory do not fit each other")
    return tuple(_number(time) for time in times)


def _is_smooth(joined: Constant | None) -> bool:
    return isinstance(joined, Member) and joined.name == "smooth"
