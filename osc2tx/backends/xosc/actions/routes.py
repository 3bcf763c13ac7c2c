"""Routes: roads and lanes that the map is searched for, and those put together (§8.5.7, §8.12)."""

from __future__ import annotations

import math
from collections.abc import Sequence

from osc2tx.backends.xosc.actions.leaf import Leaf
from osc2tx.backends.xosc.actions.xml_positions import Line, line_of, spot_of
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.declared_roads import required_roads, stretch_of
from osc2tx.backends.xosc.facts.curves import Waypoint, drawn
from osc2tx.backends.xosc.facts.map_search import (
    Stretch,
    begin_of,
    crossing_of,
    end_of,
    way_of_route,
)
from osc2tx.backends.xosc.facts.maps import LanePosition, Pose
from osc2tx.backends.xosc.report import Inexpressible
from osc2tx.backends.xosc.values.constants import Constant, Made, Member, Named
from osc2tx.backends.xosc.xml.tree import Element, element

STRAIGHT = 0.01
"""Metres beside the straight line through its neighbours within which a point is left out."""


def start_of_way(ctx: Context, route: Constant | None, offset: float) -> LanePosition | Pose:
    """Return the place so far (m) along a route or a path.

    Raises:
        Inexpressible: It is not known before the run, or ends before.
    """
    roads = required_roads(ctx)
    stretch = stretch_of(ctx, route)
    if stretch is not None and crossing_of(stretch) is None:
        place = roads.ahead(begin_of(roads, stretch), offset)
        if place is None:
            raise Inexpressible(f"the route ends before {offset:g} m")
        return place
    line = line_of_way(ctx, route)
    first = drawn(line.points, is_timed=False, is_smooth=False, offsets=(offset, 0.0))[0]
    on = roads.locate(first.x, first.y, first.z)
    if on is not None:
        return on
    heading = 0.0 if first.h is None else round(first.h, 9)
    return Pose(round(first.x, 6), round(first.y, 6), round(first.z, 6), heading)


def line_of_way(ctx: Context, route: Constant | None) -> Line:
    """Return a path, or the way that a route which is put together leads along."""
    stretch = stretch_of(ctx, route)
    ends = None if stretch is None else crossing_of(stretch)
    if ends is not None:
        return Line(ends, False, False)
    if not isinstance(route, Made) or route.method != "create_route":
        return line_of(ctx, route)
    given, connect = route.get("routes"), route.get("connect_points_by")
    if not isinstance(given, tuple):
        raise Inexpressible("the route is only known during the run")
    elements = [_element(ctx, each) for each in given]
    kind = connect.name if isinstance(connect, Member) else "waypoint"
    points = way_of_route(required_roads(ctx), elements, kind)
    return Line(tuple(_thinned(points)), False, False)


def _element(ctx: Context, value: Constant) -> LanePosition | Pose | Stretch | Sequence[Waypoint]:
    """Return what a route is put together from."""
    stretch = stretch_of(ctx, value)
    if stretch is not None:
        return stretch
    if isinstance(value, Named) and ctx.values.type_of(value.name) == "path":
        return line_of(ctx, value).points
    spot = spot_of(ctx, value)
    place = spot.pose if spot.lane is None else spot.lane
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


# --- routes of the map --------------------------------------------------------------------------


def assign_route(leaf: Leaf, stretch: Stretch) -> tuple[Element, Element]:
    """Return the action that gives an actor a route, and the position of its end."""
    roads = required_roads(leaf.ctx)
    begin, end = begin_of(roads, stretch), end_of(roads, stretch)
    lane = leaf.state.lane
    if lane is not None and lane.road == end.road:  # it keeps its own lane
        begin, end = (
            LanePosition(each.road, lane.lane, each.s) if each.road == lane.road else each
            for each in (begin, end)
        )
    goal = _in_lane(end)
    waypoints = (
        element("Waypoint", element("Position", place), routeStrategy="shortest")
        for place in (_in_lane(begin), goal)
    )
    route = element(
        "Route", *waypoints, name=leaf.ctx.names.new(f"route_{leaf.event}"), closed=False
    )
    assign = element("RoutingAction", element("AssignRouteAction", route))
    return element("PrivateAction", assign), goal


def _in_lane(place: LanePosition) -> Element:
    return element("LanePosition", roadId=place.road, laneId=place.lane, s=round(place.s, 6))
