"""Search of declared roads and lanes on the map, by the runtime's map solver."""

from __future__ import annotations

import inspect
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias, TypeVar, get_args

from osc2tx.backends.xosc.facts.curves import Waypoint
from osc2tx.backends.xosc.facts.maps import LanePosition, Pose, Roads
from osc2tx.backends.xosc.facts.refusals import refusing
from osc2tx.backends.xosc.report import Inexpressible
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

__all__ = [
    "PARTS",
    "Between",
    "MapQuery",
    "MapSegment",
    "PartReference",
    "QueryValue",
    "begin_of",
    "beginnings_of",
    "crossing_of",
    "end_of",
    "points_of_route",
    "search_map",
]

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


class PartReference(NamedTuple):
    """Another part, by its name."""

    name: str


class Between(NamedTuple):
    """Any number from the lower bound to the upper one."""

    lower: float
    upper: float


QueryValue: TypeAlias = (
    "Between | bool | int | float | str | PartReference | MapQuery | tuple[QueryValue, ...]"
)


class MapQuery(NamedTuple):
    """A part, or a modifier of the map: its type or name, and what is said about it."""

    kind: str
    properties: Mapping[str, QueryValue]


@refusing()
def search_map(
    roads: Roads, parts: Mapping[str, MapQuery], relations: Sequence[MapQuery]
) -> dict[str, MapSegment]:
    """Return the segment of the map for each part.

    Args:
        roads: The map.
        parts: What is declared, by name.
        relations: Modifiers of the map.

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
    missing = [
        name
        for name, each in known.items()
        if each.default is each.empty
        and each.kind in (each.POSITIONAL_OR_KEYWORD, each.KEYWORD_ONLY)
        and name not in query.properties
    ]
    if missing:
        raise Inexpressible(f"`{missing[0]}` of a {query.kind} is not stated")
    arguments: dict[str, Any] = {n: _resolved(value, made) for n, value in query.properties.items()}
    return cls(**arguments)


def _resolved(value: QueryValue, made: Mapping[str, RoadPart]) -> object:
    if isinstance(value, PartReference):
        if value.name not in made:
            raise Inexpressible(f"`{value.name}` is used before it is declared")
        return made[value.name]
    if isinstance(value, MapQuery):
        return _build(CrossingType, value, made)
    if isinstance(value, Between):
        return Range(value.lower, value.upper)
    if isinstance(value, tuple):
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


def begin_of(roads: Roads, segment: MapSegment) -> LanePosition:
    """Return where a segment begins, in direction of travel."""
    return graph_of(roads.map).begin(segment)


def beginnings_of(roads: Roads, segment: MapSegment) -> Iterator[LanePosition]:
    """Return where the lanes begin in which a segment begins."""
    return graph_of(roads.map).beginnings(segment)


def end_of(roads: Roads, segment: MapSegment) -> LanePosition:
    """Return where a segment ends."""
    return graph_of(roads.map).end(segment)


@refusing()
def points_of_route(
    roads: Roads,
    elements: Sequence[LanePosition | Pose | MapSegment | Sequence[Waypoint]],
    connect_by: str,
) -> tuple[Waypoint, ...]:
    """Return the way that a route leads along.

    Args:
        roads: The map.
        elements: What it is put together from; waypoints are a path.
        connect_by: What points stand for (§8.12.29).

    Raises:
        Inexpressible: There is no such way.
    """
    parts = [_element(each) for each in elements]
    kind: ConnectRoutePoints | None = next(
        (known for known in CONNECT if known == connect_by), None
    )
    if kind is None:
        raise Inexpressible(f"`{connect_by}` is nothing that points can stand for")
    poses = poses_of_route(roads.map, parts, kind)
    return tuple(Waypoint(0.0, pose.x, pose.y, pose.z, pose.yaw) for pose in poses)


CONNECT: tuple[ConnectRoutePoints, ...] = get_args(ConnectRoutePoints)


def _element(
    given: LanePosition | Pose | MapSegment | Sequence[Waypoint],
) -> LanePosition | Pose | MapSegment | Way:
    if isinstance(given, LanePosition | Pose | MapSegment):
        return given
    poses = tuple(WayPose(each.x, each.y, each.z, yaw=each.h) for each in given)
    return Way(poses, "straight_line")
