"""Axes of routes, along which `s` runs (DSL 8.5.9): length, direction, lane counts.

The axis of a lane is its centre line, that of a lane section the centre of its rightmost lane, that
of a road its reference line; that of a compound route runs along its lanes.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from osc2tx_runtime.domain.map.road_graph import RoadGraph
from osc2tx_runtime.domain.map.segments import MapSegment
from osc2tx_runtime.enums import Directionality


def axis_lanes(graph: RoadGraph, segment: MapSegment) -> tuple[MapSegment, ...]:
    """Lanes whose centre lines are the axis, in order; empty for roads, routes and crossings."""
    match segment.kind:
        case "lane":
            return (segment,)
        case "compound_lane":
            return segment.parts
        case "lane_section" | "path":
            return graph.lanes_of(segment)[:1]
        case _:
            return ()


def length_of(graph: RoadGraph, segment: MapSegment) -> float:
    """Length of the axis of a route (m)."""
    if segment.line is not None:
        return segment.line.length
    if segment.kind == "road":
        return graph.map.roads[segment.road].length
    lanes = axis_lanes(graph, segment)
    if lanes:
        return math.fsum(graph.map.lane_length(graph.key(lane)) for lane in lanes)
    along = graph.map.route_distance(graph.begin(segment), graph.end(segment))
    return along or math.fsum(length_of(graph, part) for part in segment.parts)


def directionality_of(graph: RoadGraph, segment: MapSegment) -> Directionality:
    """Directions in which the lanes of a route are used."""
    if segment.kind == "crossing":
        return "free"
    lanes = [lane for each in _sections(graph, segment) for lane in graph.lanes_of(each)]
    found = {graph.kind_of(lane).directionality for lane in lanes}
    one_way = found == {"uni_direction"}
    if one_way and segment.kind == "road" and len({lane.forwards for lane in lanes}) > 1:
        return "split"
    return found.pop() if len(found) == 1 else "other"


def widths_of(graph: RoadGraph, segment: MapSegment) -> list[int]:
    """Numbers of adjacent drivable lanes along a route."""
    if segment.kind == "crossing":
        return [0]
    return [
        sum(graph.kind_of(lane).type == "driving" for lane in graph.lanes_of(each))
        for each in _sections(graph, segment)
    ]


def _sections(graph: RoadGraph, segment: MapSegment) -> Iterator[MapSegment]:
    """Pieces of a route with the same adjacent lanes; of compound routes their direction."""
    if segment.kind == "compound_route":
        for part in segment.parts:
            yield from graph.sections_of_road(part.road, forwards=part.forwards)
    else:
        yield from graph.sections_of(segment)
