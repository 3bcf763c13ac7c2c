"""Actions along paths, trajectories (§8.8.2.8 to §8.8.2.17) and routes, and their modifiers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.actions.leaf import Change, Changes, Leaf, Performance
from osc2tx.backends.xosc.actions.position.points_and_lines import (
    line_of,
    line_of_route,
    relative_line,
)
from osc2tx.backends.xosc.actions.position.xml_positions import at_place, lane_place, relative_lane
from osc2tx.backends.xosc.actions.registry import action, modifier, to_goal
from osc2tx.backends.xosc.actions.speed.speed_changes import may_jump
from osc2tx.backends.xosc.entities.declared_roads import segment_of
from osc2tx.backends.xosc.facts.curves import Line, Waypoint, sample_curve
from osc2tx.backends.xosc.facts.map_search import MapSegment, crossing_of, graph_of
from osc2tx.backends.xosc.facts.maps import Pose
from osc2tx.backends.xosc.state import LATERAL, LONGITUDINAL, ActorState, known
from osc2tx.backends.xosc.values.constants import Constant, Named
from osc2tx.losses.entries import Inexpressible, Remedy
from osc2tx.xosc import elements as xml
from osc2tx_shared.classes import replace


@action("follow_path", "replay_path", "follow_trajectory", "replay_trajectory")
def _on_line(leaf: Leaf) -> Performance:
    arguments = leaf.arguments
    reference = arguments.get("reference")
    transform = arguments.get("transform")
    if "relative" in arguments:
        mine: Constant = Named(leaf.member.actor.name)
        line = relative_line(leaf.ctx, arguments.get("relative"), transform, reference or mine)
        if leaf.is_start and may_jump(leaf) and line.reference != leaf.member.name:
            raise Inexpressible("a run fails unless its actor starts where the replay begins")
    else:
        line = line_of(leaf.ctx, arguments.get("absolute"))
    if leaf.duration is not None:
        raise Inexpressible("a duration beside that of the way")
    return to_goal(leaf, *along_line(leaf, line, arguments))


# What says in which lane of a route, or where in it.
ACROSS = frozenset({"change_lane", "keep_lane", "lane", "lateral"})


@modifier("along_trajectory")
def _along_trajectory(leaf: Leaf, call: Arguments) -> Changes:
    return along_line(leaf, line_of(leaf.ctx, call.get("trajectory")), call)


@modifier("along")
def _along(leaf: Leaf, call: Arguments) -> Changes:
    route = call.get("route")
    segment = segment_of(leaf.ctx, route)
    if segment is not None and crossing_of(segment) is None:
        beside = [m for m in leaf.node.modifiers if m.name in ACROSS and m.at != "start"]
        if beside:
            raise Inexpressible(f"`{beside[0].name}` on a route of the map", beside[0].span)
        return _along_segment(leaf, segment, call)
    return along_line(leaf, line_of_route(leaf.ctx, route), call)


def _along_segment(leaf: Leaf, segment: MapSegment, call: Arguments) -> Changes:
    """Return the changes that a route of the map makes: it goes on in the lanes, from wherever."""
    if call.offsets()[1]:
        raise Inexpressible("a route of the map that is left before its end", leaf.node.span)
    roads, lane = leaf.ctx.required_roads(), leaf.state.lane
    graph = graph_of(roads.map)
    ends = [graph.begin(segment), graph.end(segment)]
    if lane is not None and lane.road == ends[1].road:  # it keeps its own lane
        ends = [each._replace(lane=lane.lane) if each.road == lane.road else each for each in ends]
    places = [lane_place(roads, each) for each in ends]
    if leaf.duration is None:
        leaf.reached = at_place(leaf.ctx, leaf.arguments, leaf.member.name, places[1], ends[1])
    waypoints = (xml.Waypoint(xml.Position(each), routeStrategy="shortest") for each in places)
    route = xml.Route(*waypoints, name=leaf.ctx.names.new(f"route_{leaf.event}"), closed=False)
    action = xml.PrivateAction(xml.RoutingAction(xml.AssignRouteAction(route)))
    after = replace(leaf.state, lane=None).finished(LATERAL)
    return (Change(LATERAL, (action,), None, after, after),)


def along_line(leaf: Leaf, line: Line, arguments: Arguments) -> Changes:
    """Return the changes of a path or a trajectory, without the parts that arguments leave out."""
    line, is_exact = replace(line, offsets=arguments.offsets()), may_jump(leaf)
    if leaf.enters and line.frame is None:
        raise Inexpressible("a run plans how the actor gets to the path by then")
    points = line.points
    if line.is_timed and points and points[0].time > 0.0:
        if line.frame is not None or any(line.offsets):
            raise Inexpressible("a trajectory that begins later, from wherever the actor is then")
        here = leaf.state.pose
        if here is None:
            raise Inexpressible("where it starts from is only known during the run")
        points = (Waypoint(0.0, here.x, here.y, here.z), *points)
    corners = sample_curve(replace(line, points=points))
    vertices = [_vertex(leaf, line, each) for each in corners]
    if not (line.is_timed or is_exact or _is_there(leaf, line, corners[0])):
        start = xml.RelativeObjectPosition(entityRef=leaf.member.name, dx=0.0, dy=0.0)
        vertices = [(0.0, start), *vertices]  # it goes to the path, it does not jump
    if not is_exact:
        note_steering(leaf, is_timed=line.is_timed)
    action = follow(leaf, vertices, line.is_timed, is_exact)
    if not line.is_timed:
        after = _at_end(leaf, line, corners, leaf.state)
        during = replace(after, lane=None, offset=None, pose=None)
        return (Change(LATERAL, (action,), _time(leaf, corners), during, after),)
    before, end = corners[-2:]
    speed = known(math.dist(end[1:3], before[1:3]) / (end.time - before.time))
    after = _at_end(leaf, line, corners, replace(leaf.state, speed=speed))
    during = replace(after, speed=None, lane=None, offset=None, pose=None)
    return (
        Change(LONGITUDINAL, (action,), end.time, during, after),
        Change(LATERAL, (), end.time, during, after),
    )


ON_THE_LINE = Remedy(
    instead="`replay_path`, `replay_trajectory` or `physical_movement(prefer_non_physical)` is on"
    " the line exactly",
    asks=("FollowTrajectoryAction/Vehicle",),
)


def note_steering(leaf: Leaf, *, is_timed: bool = False) -> None:
    """Report that an actor keeps to physics where the XML is on its line, or there in time."""
    reason = (
        "it gets to the first point, and from speed to speed, as physics allows; the XML is there"
        if is_timed
        else "it steers along the way as physics allows, through corners and into its lane at the"
        " end; the XML is on the line"
    )
    leaf.arguments.doubt(reason, ON_THE_LINE)


def _time(leaf: Leaf, corners: Sequence[Waypoint]) -> float | None:
    """Return how long a path takes at the present speed, if that is known."""
    speed = leaf.state.known_speed
    if speed is None or leaf.node.modifiers:
        return None
    if speed <= 0.0:
        raise Inexpressible("it is at standstill, and a path states no speed: give it one before")
    way = sum(math.hypot(b.x - a.x, b.y - a.y) for a, b in pairwise(corners))
    return way / speed


def _is_there(leaf: Leaf, line: Line, point: Waypoint) -> bool:
    """Whether an actor surely begins where a line does: tools set out on no line of no length."""
    if line.frame is not None:
        return line.reference != leaf.member.name or math.hypot(point.x, point.y) < 1e-3
    pose, lane, roads = leaf.state.pose, leaf.state.lane, leaf.ctx.roads
    if pose is None and leaf.is_start and lane is not None and roads is not None:
        pose = roads.map.pose(lane)
    return pose is not None and math.hypot(point.x - pose.x, point.y - pose.y) < 1e-3


def _at_end(leaf: Leaf, line: Line, way: Sequence[Waypoint], state: ActorState) -> ActorState:
    """Return what is known at the end of a way, from what is known of the speed there."""
    lane = pose = offset = None
    if line.frame is None:
        before, end = way[-2:]
        h = math.atan2(end.y - before.y, end.x - before.x) if end.h is None else end.h
        pose = None if leaf.state.pose is None else Pose(end.x, end.y, end.z, h)
        if pose is None and leaf.ctx.roads is not None:
            lane = leaf.ctx.roads.locate(end.x, end.y, end.z)
    if lane is not None:
        offset = known(round(lane.offset, 6))
    return replace(state, lane=lane, offset=offset, pose=pose).finished(LATERAL)


# --- elements -----------------------------------------------------------------------------------


def _vertex(leaf: Leaf, line: Line, point: Waypoint) -> tuple[float, xml.PositionPart]:
    x, y, z = round(point.x, 6), round(point.y, 6), round(point.z, 6)
    name = line.reference or ""
    place: xml.PositionPart
    match line.frame:
        case None:
            h = None if point.h is None else round(point.h, 9)
            place = xml.WorldPosition(x=x, y=y, z=z, h=h)
        case "road_relative":
            place = xml.RelativeRoadPosition(entityRef=name, ds=x, dt=y)
        case "lane_relative":
            place = relative_lane(leaf.ctx, name, 0, x, y)
        case "world_relative":
            place = xml.RelativeWorldPosition(entityRef=name, dx=x, dy=y, dz=z or None)
        case _:
            place = xml.RelativeObjectPosition(entityRef=name, dx=x, dy=y, dz=z or None)
    return point.time, place


def follow(
    leaf: Leaf, vertices: Sequence[tuple[float, xml.PositionPart]], is_timed: bool, is_exact: bool
) -> xml.PrivateAction:
    """Return the action along a polyline; a tool that ignores times cannot do a timed one."""
    if is_timed:
        leaf.ctx.require_support(f"FollowTrajectoryAction/{leaf.member.kind}")
    older = leaf.ctx.version == "1.0"
    trajectory = xml.Trajectory(
        xml.Shape(
            xml.Polyline(
                *(
                    xml.Vertex(
                        xml.Position(place),
                        # 1.0 asks for times even where nobody reads them.
                        time=round(time, 6) if is_timed else float(number) if older else None,
                    )
                    for number, (time, place) in enumerate(vertices)
                )
            )
        ),
        name=leaf.ctx.names.new(f"way_{leaf.event}"),
        closed=False,
    )
    timing = xml.Timing(domainAbsoluteRelative="relative", scale=1.0, offset=0.0)
    return xml.PrivateAction(
        xml.RoutingAction(
            xml.FollowTrajectoryAction(
                trajectory if older else xml.TrajectoryRef(trajectory),
                xml.TimeReference(timing if is_timed else xml.None_()),
                xml.TrajectoryFollowingMode(
                    # Between times tools that `follow` choose speeds of their own.
                    followingMode="position" if is_exact or is_timed else "follow"
                ),
            )
        )
    )
