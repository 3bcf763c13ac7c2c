"""Routes that actors are given (§8.5.7, §8.12)."""

from __future__ import annotations

from osc2tx.backends.xosc.actions.leaf import Leaf
from osc2tx.backends.xosc.entities.declared_roads import required_roads
from osc2tx.backends.xosc.facts.map_search import (
    MapSegment,
    begin_of,
    end_of,
)
from osc2tx.backends.xosc.facts.maps import LanePosition
from osc2tx.backends.xosc.xml.tree import Element, element


def assign_route(leaf: Leaf, segment: MapSegment) -> tuple[Element, LanePosition]:
    """Return the action that gives an actor a route, and the place of its end."""
    roads = required_roads(leaf.ctx)
    begin, end = begin_of(roads, segment), end_of(roads, segment)
    lane = leaf.state.lane
    if lane is not None and lane.road == end.road:  # it keeps its own lane
        begin, end = (
            LanePosition(each.road, lane.lane, each.s) if each.road == lane.road else each
            for each in (begin, end)
        )
    waypoints = (
        element("Waypoint", element("Position", place), routeStrategy="shortest")
        for place in (lane_position(begin), lane_position(end))
    )
    route = element(
        "Route", *waypoints, name=leaf.ctx.names.new(f"route_{leaf.event}"), closed=False
    )
    assign = element("RoutingAction", element("AssignRouteAction", route))
    return element("PrivateAction", assign), end


def lane_position(place: LanePosition) -> Element:
    """Return the element of the middle of a lane at a place."""
    return element(
        "LanePosition", roadId=place.road, laneId=place.lane, s=round(place.s, 6), offset=0.0
    )
