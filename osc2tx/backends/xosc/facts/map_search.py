"""Search of declared roads and lanes on the map, by the runtime's map solver."""

from __future__ import annotations

import inspect
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, TypeVar, cast

from osc2tx.backends.xosc.facts import refusing
from osc2tx.backends.xosc.facts.curves import Waypoint
from osc2tx.backends.xosc.facts.maps import LanePosition, Pose, Roads
from osc2tx.backends.xosc.values.constants import Bounds, Constant, Member, MethodResult, Named
from osc2tx.losses.entries import Inexpressible
from osc2tx_runtime.domain.map.crossings import Crossing, CrossingType
from osc2tx_runtime.domain.map.road_graph import graph_of
from osc2tx_runtime.domain.map.roads_and_lanes import (
    CompoundLane,
    CompoundRoute,
    Junction,
    Lane,
    LaneSection,
    Road,
    RoadPart,
    RoadPath,
    Route,
)
from osc2tx_runtime.domain.map.segments import MapSegment
from osc2tx_runtime.domain.modifiers import MODIFIERS, MapModifier
from osc2tx_runtime.domain.paths.path_values import Path as Way
from osc2tx_runtime.domain.placing.map_solver import MapSolver, Relation
from osc2tx_runtime.domain.points_and_poses import Pose as WayPose
from osc2tx_runtime.domain.routes.composed_routes import poses_of_route
from osc2tx_runtime.enums import ConnectRoutePoints
from osc2tx_runtime.language.values.parameters import Range

PARTS: Mapping[str, type[RoadPart]] = {
    "Path": RoadPath,
    "compound_lane": CompoundLane,
    "compound_route": CompoundRoute,
    "crossing": Crossing,
    "junction": Junction,
    "lane": Lane,
    "lane_section": LaneSection,
    "road": Road,
    "route": Route,
}
"""Type of the library (§8.12) or the dialect -> what is looked for."""


class MapQuery(NamedTuple):
    """A part, or a modifier of the map: its type or name, and what is said about it."""

    kind: str
    properties: Mapping[str, Constant | MapQuery]


@refusing()
def search_map(
    roads: Roads, parts: Mapping[str, MapQuery], relations: Sequence[MapQuery]
) -> dict[str, MapSegment]:
    """Return the segment of the map for each declared part, as the modifiers of the map want it.

    Raises:
        Inexpressible: The map has none, or cannot tell.
    """
    made: dict[str, RoadPart] = {}
    for name, query in parts.items():
        made[name] = _build(PARTS[query.kind], query, made)
    kinds = {n: each for n, each in MODIFIERS.items() if issubclass(each, MapModifier)}
    modifiers = [_build(kinds[query.kind], query, made) for query in relations]
    MapSolver(roads.map, list(made.values()), [Relation(m, None) for m in modifiers]).solve()
    return {name: part.found for name, part in made.items()}


BuiltT = TypeVar("BuiltT", RoadPart, MapModifier, CrossingType)


def _build(cls: type[BuiltT], query: MapQuery, made: Mapping[str, RoadPart]) -> BuiltT:
    """Return an object of the embedded world."""
    known = inspect.signature(cls).parameters
    unknown = [name for name in query.properties if name not in known]
    if unknown:
        raise Inexpressible(f"`{unknown[0]}` of a {query.kind} cannot be determined from the map")
    arguments: dict[str, Any] = {n: _resolved(value, made) for n, value in query.properties.items()}
    return cls(**arguments)


def _resolved(value: Constant | MapQuery, made: Mapping[str, RoadPart]) -> object:
    match value:
        case MapQuery():
            return _build(CrossingType, value, made)
        case Named(name=name):
            if name not in made:
                raise Inexpressible(f"`{name}` is used before it is declared")
            return made[name]
        case Member(name=name):
            return name
        case Bounds(lower=low, upper=high):
            return Range(low, high)
        case MethodResult():
            raise Inexpressible(f"what `{value.method}` makes is not looked for on the map")
        case tuple():
            return tuple(_resolved(each, made) for each in value)
    return value


# --- places on what was found -------------------------------------------------------------------


def crossing_of(segment: MapSegment) -> tuple[Waypoint, Waypoint] | None:
    """Return where a crossing begins and ends; `None` if a segment is none."""
    line = segment.line
    if line is None:
        return None
    begin, end = (Waypoint(0.0, *line.at(s), line.heading) for s in (0.0, line.length))
    return begin, end


@refusing()
def points_of_route(
    roads: Roads,
    elements: Sequence[LanePosition | Pose | MapSegment | Sequence[Waypoint]],
    connect_by: str,
) -> tuple[Waypoint, ...]:
    """Return the way that a route leads along which is put together; waypoints are a path."""
    parts = [_element(each) for each in elements]
    poses = poses_of_route(roads.map, parts, cast("ConnectRoutePoints", connect_by))
    return tuple(Waypoint(0.0, pose.x, pose.y, pose.z, pose.yaw) for pose in poses)


def _element(
    given: LanePosition | Pose | MapSegment | Sequence[Waypoint],
) -> LanePosition | Pose | MapSegment | Way:
    if isinstance(given, LanePosition | Pose | MapSegment):
        return given
    poses = tuple(WayPose(each.x, each.y, each.z, yaw=each.h) for each in given)
    return Way(poses, "straight_line")
