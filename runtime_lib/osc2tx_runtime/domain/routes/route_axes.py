"""Axes of routes, along which `s` runs (DSL 8.5.9): length, direction, lane counts.

The axis of a lane is its centre line, that of a lane section the centre of its rightmost lane, that
of a road its reference line; a compound route is measured along its lanes from end to end.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from osc2tx_runtime.domain.routes.map_segments import Stretch
from osc2tx_runtime.domain.routes.road_graph import RoadGraph
from osc2tx_runtime.enums import Directionality

__all__ = ["axis_lanes", "directionality_of", "length_of", "widths_of"]


def axis_lanes(graph: RoadGraph, stretch: Stretch) -> tuple[Stretch, ...]:
    """Lanes whose centre lines are the axis, in order; none of roads, routes and crossings."""
    match stretch.kind:
        case "lane":
            return (stretch,)
        case "compound_lane":
            return stretch.parts
        case "lane_section" | "path":
            return graph.lanes_of(stretch)[:1]
        case _:
            return ()


def length_of(graph: RoadGraph, stretch: Stretch) -> float:
    """Length of the axis of a route (m)."""
    if stretch.line is not None:
        return stretch.line.length
    if stretch.kind == "road":
        return graph.map.roads[stretch.road].length
    lanes = axis_lanes(graph, stretch)
    if lanes:
        return math.fsum(graph.map.lane_length(graph.key(lane)) for lane in lanes)
    along = graph.map.route_distance(graph.begin(stretch), graph.end(stretch))
    return along or math.fsum(length_of(graph, part) for part in stretch.parts)


def directionality_of(graph: RoadGraph, stretch: Stretch) -> Directionality:
    """In which directions the lanes of a route are used."""
    if stretch.kind == "crossing":
        return "free"
    lanes = [lane for each in _sections(graph, stretch) for lane in graph.lanes_of(each)]
    found = {graph.kind_of(lane).directionality for lane in lanes}
    one_way = found == {"uni_direction"}
    if one_way and stretch.kind == "road" and len({lane.forwards for lane in lanes}) > 1:
        return "split"
    return found.pop() if len(found) == 1 else "other"


def widths_of(graph: RoadGraph, stretch: Stretch) -> list[int]:
    """How many drivable lanes there are side by side, along a route."""
    if stretch.kind == "crossing":
        return [0]
    return [
        sum(graph.kind_of(lane).type == "driving" for lane in graph.lanes_of(each))
        for each in _sections(graph, stretch)
    ]


def _sections(graph: RoadGraph, stretch: Stretch) -> Iterator[Stretch]:
    """Pieces of a route with the same lanes side by side; of compound routes their direction."""
    if stretch.kind == "compound_route":
        for part in stretch.parts:
            yield from graph.sections_of_road(part.road, forwards=part.forwards)
    else:
        yield from graph.sections_of(stretch)
