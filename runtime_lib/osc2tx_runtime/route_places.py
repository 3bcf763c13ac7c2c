"""Where an actor is on a route (DSL 8.7.5.1.1): metres from its start, and how long it is."""

from __future__ import annotations

import math

from osc2tx_runtime.errors import ScenarioError, UnsupportedError
from osc2tx_runtime.in_world import path_in_world
from osc2tx_runtime.opendrive import LanePosition, RoadMap
from osc2tx_runtime.paths import curve_of_path
from osc2tx_runtime.road_graph import RoadGraph
from osc2tx_runtime.road_parts import RoadPart, Stretch
from osc2tx_runtime.values import Path
from osc2tx_runtime.world.state import ActorState

__all__ = ["place_on_route"]

_BESIDE = 2.0  # m from a path at which an actor still is on it: about half a lane


def place_on_route(
    road_map: RoadMap, route: Path | RoadPart, state: ActorState
) -> tuple[float, float]:
    """Metres from the start of a route to an actor, and length of the route.

    Raises:
        ScenarioError: The actor is not on it.
    """
    if isinstance(route, Path):
        return _on_path(road_map, route, state)
    found = route.found
    place = state.lane_position
    if place is None:
        raise ScenarioError(f"the actor is off the road, so not on {found}")
    match found.kind:
        case "road":
            return _within(place, found, (place.s, road_map.roads[found.road].length))
        case "lane_section":
            return _on_section(road_map, place, found)
        case "lane" | "compound_lane":
            return _on_lanes(road_map, place, found)
    raise UnsupportedError(f"a distance along a {found.kind} is not there yet")


def _on_path(road_map: RoadMap, path: Path, state: ActorState) -> tuple[float, float]:
    curve = curve_of_path(path_in_world(road_map, path))
    along = curve.nearest(state.x, state.y, 0.0, math.inf)
    away = curve.distance_to(state.x, state.y, along)
    if away > _BESIDE:
        raise ScenarioError(f"the actor is {away:.1f} m from the path, so not on it")
    return along, curve.length


def _on_section(road_map: RoadMap, place: LanePosition, found: Stretch) -> tuple[float, float]:
    assert found.section is not None
    section = road_map.roads[found.road].sections[found.section]
    along = place.s - section.begin if found.forwards else section.end - place.s
    forwards = road_map.travel_direction(place.road, place.lane) > 0
    if forwards != found.forwards:
        raise ScenarioError(f"the actor is on the other side of {found}")
    return _within(place, found, (along, section.end - section.begin))


def _on_lanes(road_map: RoadMap, place: LanePosition, found: Stretch) -> tuple[float, float]:
    graph = RoadGraph(road_map)
    key, before = road_map.lane_key(place), 0.0
    lanes = found.parts or (found,)
    lengths = [road_map.lane_length(graph.key(lane)) for lane in lanes]
    for lane, length in zip(lanes, lengths, strict=True):
        if graph.key(lane) == key:
            here = LanePosition(place.road, place.lane, place.s)
            along = road_map.route_distance(graph.begin(lane), here) or 0.0
            return before + along, sum(lengths)
        before += length
    raise ScenarioError(f"the actor is on lane {place.lane} of road {place.road}, not on {found}")


def _within(
    place: LanePosition, found: Stretch, distances: tuple[float, float]
) -> tuple[float, float]:
    along, length = distances
    if place.road != found.road or not 0.0 <= along <= length:
        raise ScenarioError(f"the actor is on road {place.road}, not on {found}")
    return distances
