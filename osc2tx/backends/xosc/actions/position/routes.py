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
from osc2tx.xosc import elements as xml


def assign_route(leaf: Leaf, segment: MapSegment) -> tuple[xml.PrivateAction, LanePosition]:
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
        xml.Waypoint(xml.Position(place), routeStrategy="shortest")
        for place in (lane_position(begin), lane_position(end))
    )
    route = xml.Route(*waypoints, name=leaf.ctx.names.new(f"route_{leaf.event}"), closed=False)
    assign = xml.RoutingAction(xml.AssignRouteAction(route))
    return xml.PrivateAction(assign), end


def lane_position(place: LanePosition) -> xml.LanePosition:
    """Return the element of the middle of a lane at a place."""
    return xml.LanePosition(roadId=place.road, laneId=place.lane, s=round(place.s, 6), offset=0.0)
