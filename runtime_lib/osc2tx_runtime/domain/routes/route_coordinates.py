"""Position of an actor in coordinates of the road, lane section, lane or crossing under it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.map.crossings import Crossing
from osc2tx_runtime.domain.map.road_graph import RoadGraph, graph_of
from osc2tx_runtime.domain.map.roads_and_lanes import LaneSection
from osc2tx_runtime.domain.map.route_axes import axis_lanes
from osc2tx_runtime.domain.map.segments import CrossingLine, MapSegment
from osc2tx_runtime.domain.points_and_poses import RoadRoute, RoutePoint
from osc2tx_runtime.domain.routes.lane_coordinates import route_point_at
from osc2tx_runtime.enums import OnRouteType
from osc2tx_runtime.errors import ScenarioError, UnsupportedError
from osc2tx_runtime.opendrive import LanePosition, Pose
from osc2tx_runtime.world.state import ActorState

if TYPE_CHECKING:
    from osc2tx_runtime.language.context import ExecutionContext

_EDGE = 0.5  # m beyond the ends of a crossing
_UNKNOWN_WIDTH = 4.0  # m: of a crossing without a stated width


def place_in_route(
    context: ExecutionContext, state: ActorState, route_type: OnRouteType
) -> RoutePoint:
    """The position of an actor on the element under it.

    Raises:
        ScenarioError: There is no such route at its position.
    """
    if route_type == "on_crossing":
        return _on_crossing(context, state)
    place, road_map = state.lane_position, context.world.map
    if place is None:
        raise ScenarioError("it is not on a road")
    if route_type == "on_lane":
        return route_point_at(road_map, place)
    if route_type == "on_road":
        line = road_map.road_pose(place.road, place.s, 0.0)
        return RoutePoint(RoadRoute(place.road), place.s, _aside(line, state))
    return _on_section(context, place, state)


def _on_section(context: ExecutionContext, place: LanePosition, state: ActorState) -> RoutePoint:
    graph = graph_of(context.world.map)
    found, axis = _section_of(graph, place)
    section = LaneSection()
    section.bind(context)
    section.choose(found)
    return RoutePoint(section, *_from_axis(graph, axis, place, state))


def _section_of(graph: RoadGraph, place: LanePosition) -> tuple[MapSegment, MapSegment]:
    """The lane section of a place, and the lane that is its axis."""
    lane = graph.segment_of(graph.map.lane_key(place))
    found = MapSegment("lane_section", lane.road, lane.section, forwards=lane.forwards)
    axes = axis_lanes(graph, found)
    if not axes or axes[0].lane is None:
        raise ScenarioError("it is not on a lane section for vehicles")
    return found, axes[0]


def _from_axis(
    graph: RoadGraph, axis: MapSegment, place: LanePosition, state: ActorState
) -> tuple[float, float]:
    """Metres along and to the left of the axis of a lane section."""
    assert axis.lane is not None
    line = graph.map.pose(LanePosition(place.road, axis.lane, place.s))
    return graph.along(axis, place.s), _aside(line, state)


def between_on_section(
    context: ExecutionContext, here: ActorState, there: ActorState, *, ahead: bool
) -> float | None:
    """Distance (m) to another position along the lane section of a position, or to its left.

    None if the other position is beside another section.

    Raises:
        ScenarioError: The first position is not on a lane section.
    """
    place, other = here.lane_position, there.lane_position
    if place is None:
        raise ScenarioError("it is not on a road")
    graph = graph_of(context.world.map)
    if other is None or other.road != place.road:
        return None
    sections = graph.map.roads[place.road]
    if sections.section_at(other.s) is not sections.section_at(place.s):
        return None
    _, axis = _section_of(graph, place)
    s, t = _from_axis(graph, axis, place, here)
    far, aside = _from_axis(graph, axis, other, there)
    return far - s if ahead else aside - t


def _aside(line: Pose, state: ActorState) -> float:
    """Distance (m) of an actor to the left of a line, on the surface."""
    left = (state.y - line.y) * math.cos(line.h) - (state.x - line.x) * math.sin(line.h)
    return left / math.cos(line.roll)


# --- crossings --------------------------------------------------------------------------------


def _on_crossing(context: ExecutionContext, state: ActorState) -> RoutePoint:
    """On a crossing of the scenario, else on a crosswalk of the map."""
    declared = (each.found for each in context.objects if isinstance(each, Crossing))
    for found in (*declared, *graph_of(context.world.map).crossings):
        assert found.line is not None
        s, t = found.line.place_of(state.x, state.y)
        half = 0.5 * (found.line.width or _UNKNOWN_WIDTH)
        if -_EDGE <= s <= found.line.length + _EDGE and abs(t) <= half:
            crossing = Crossing()
            crossing.bind(context)
            crossing.choose(found)
            return RoutePoint(crossing, s, t)
    raise ScenarioError("it is not on a crossing")


def between_on_crossing(
    context: ExecutionContext, here: ActorState, there: ActorState, *, ahead: bool, mode: str
) -> float:
    """Distance (m) to another position along a crossing, or to its left.

    Raises:
        ScenarioError: The first position is not on a crossing.
        UnsupportedError: A measurement between boxes is requested.
    """
    if mode != "reference_points":
        raise UnsupportedError("along a crossing distances count between reference points only")
    point = _on_crossing(context, here)
    s, t = _line_of(point).place_of(there.x, there.y)
    return s - point.s if ahead else t - point.t


def _line_of(point: RoutePoint) -> CrossingLine:
    assert isinstance(point.route, Crossing)
    return point.route.line
