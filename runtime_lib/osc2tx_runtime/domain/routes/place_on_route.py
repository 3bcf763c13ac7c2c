"""Distance of an actor along a route, and the length of the route (DSL 8.7.5.1.1)."""

from __future__ import annotations

import math

from osc2tx_runtime.domain.map.crossings import Crossing
from osc2tx_runtime.domain.map.road_graph import RoadGraph, graph_of
from osc2tx_runtime.domain.map.roads_and_lanes import RoadPart
from osc2tx_runtime.domain.map.route_axes import axis_lanes, length_of
from osc2tx_runtime.domain.map.segments import MapSegment
from osc2tx_runtime.domain.paths.path_values import Path
from osc2tx_runtime.errors import ScenarioError, UnsupportedError
from osc2tx_runtime.opendrive import Advance, LanePosition, RoadMap
from osc2tx_runtime.world.geometry.curve import Curve
from osc2tx_runtime.world.state import ActorState

_BESIDE = 2.0  # m from a path within which an actor is on it: about half a lane
_CORRECTIONS = 4  # of a distance along a lane, which differs by some per cent from s
_EDGE = 0.5  # m beyond the ends of a crossing


def place_on_route(
    road_map: RoadMap, route: Path | RoadPart, state: ActorState
) -> tuple[float, float]:
    """Metres from the start of a route to an actor, and length of the route.

    Raises:
        ScenarioError: The actor is not on it.
    """
    if isinstance(route, Path):
        return _on_path(route.curve, state)
    if isinstance(route, Crossing):
        return _on_crossing(route, state)
    found, graph = route.found, graph_of(road_map)
    place = state.lane_position
    if place is None:
        raise ScenarioError(f"the actor is off the road, so not on {found}")
    match found.kind:
        case "road":
            return _within(place, found, (place.s, length_of(graph, found)))
        case "lane_section":
            return _on_section(graph, place, found)
        case "lane" | "compound_lane":
            return _on_lanes(graph, place, found)
        case "compound_route":
            return _on_roads(graph, place, found)
    raise UnsupportedError(f"a distance cannot be measured along a {found.kind}")


def driven_on_route(
    road_map: RoadMap, route: Path | RoadPart, state: ActorState
) -> tuple[float, float]:
    """As `place_on_route`, for an actor that drives opposite to the road from its entry.

    Raises:
        ScenarioError: The actor is not on it.
    """
    along, length = place_on_route(road_map, route, state)
    place = state.lane_position
    if isinstance(route, Path) or route.found.kind != "road" or place is None:
        return along, length
    forwards = road_map.travel_direction(place.road, place.lane) > 0
    return (along if forwards else length - along), length


def on_route(graph: RoadGraph, route: MapSegment, end: LanePosition, distance: float) -> Advance:
    """Return the position at a distance (m) from one end of a route, backwards if negative."""
    step = graph.map.advance(end, distance)
    if route.kind != "road":
        return step
    direction = graph.map.travel_direction(end.road, end.lane)
    s = min(max(end.s + direction * distance, 0.0), graph.map.roads[end.road].length)
    place = step.position
    for _ in range(_CORRECTIONS):
        rest = direction * (s - place.s) if place.road == end.road else 0.0
        place = graph.map.advance(place, rest).position
    return Advance(place, math.copysign(abs(s - end.s), distance))


def _on_path(curve: Curve, state: ActorState) -> tuple[float, float]:
    here = state.x, state.y
    knots = curve.knots
    nearest = min(range(len(knots)), key=lambda i: math.dist(curve.point(knots[i])[:2], here))
    begin, end = knots[max(nearest - 1, 0)], knots[min(nearest + 1, len(knots) - 1)]
    begin, end = curve.length_at(begin), curve.length_at(end)
    along = curve.nearest(state.x, state.y, begin, end - begin)
    away = curve.distance_to(state.x, state.y, along)
    if away > _BESIDE:
        raise ScenarioError(f"the actor is {away:.1f} m from the path, so not on it")
    return along, curve.length


def _on_crossing(crossing: Crossing, state: ActorState) -> tuple[float, float]:
    line = crossing.line
    along, aside = line.place_of(state.x, state.y)
    half = _BESIDE if crossing.stated_width is None else 0.5 * crossing.stated_width
    if abs(aside) > half or not -_EDGE <= along <= line.length + _EDGE:
        raise ScenarioError(f"the actor is not on {crossing.found}")
    return along, line.length


def _on_section(graph: RoadGraph, place: LanePosition, found: MapSegment) -> tuple[float, float]:
    forwards = graph.map.travel_direction(place.road, place.lane) > 0
    if forwards != found.forwards:
        raise ScenarioError(f"the actor is on the other side of {found}")
    section = graph.map.roads[found.road].sections[found.section or 0]
    if place.road != found.road or not section.begin <= place.s <= section.end:
        raise ScenarioError(f"the actor is on road {place.road}, not on {found}")
    (axis,) = axis_lanes(graph, found)
    return graph.along(axis, place.s), length_of(graph, found)


def _on_lanes(graph: RoadGraph, place: LanePosition, found: MapSegment) -> tuple[float, float]:
    key, before = graph.map.lane_key(place), 0.0
    for lane in axis_lanes(graph, found):
        if graph.key(lane) == key:
            return before + graph.along(lane, place.s), length_of(graph, found)
        before += length_of(graph, lane)
    raise ScenarioError(f"the actor is on lane {place.lane} of road {place.road}, not on {found}")


def _on_roads(graph: RoadGraph, place: LanePosition, found: MapSegment) -> tuple[float, float]:
    along = graph.map.route_distance(graph.begin(found), place)
    if along is None or place.road not in {part.road for part in found.parts}:
        raise ScenarioError(f"the actor is on road {place.road}, not on {found}")
    return along, length_of(graph, found)


def _within(
    place: LanePosition, found: MapSegment, distances: tuple[float, float]
) -> tuple[float, float]:
    along, length = distances
    if place.road != found.road or not 0.0 <= along <= length:
        raise ScenarioError(f"the actor is on road {place.road}, not on {found}")
    return distances
