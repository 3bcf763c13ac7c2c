"""The lateral command of an action, from its modifiers."""

from __future__ import annotations

from typing import TYPE_CHECKING

from osc2tx_runtime.domain.map.road_graph import graph_of
from osc2tx_runtime.domain.map.roads_and_lanes import Route
from osc2tx_runtime.domain.modifiers import (
    Along,
    AlongTrajectory,
    Lane,
    Lateral,
    Orient,
    Speed,
    Yaw,
    value_of,
)
from osc2tx_runtime.domain.modifiers.base import now
from osc2tx_runtime.domain.placing.pose_resolution import one_of_kind
from osc2tx_runtime.domain.planning.orientation_planning import turn_command
from osc2tx_runtime.domain.planning.path_commands import path_command, trajectory_commands
from osc2tx_runtime.domain.routes.composed_routes import MadeRoute
from osc2tx_runtime.domain.routes.place_on_route import on_route
from osc2tx_runtime.language.actions.registry import LATERAL
from osc2tx_runtime.world.commands import Command, FollowRoute
from osc2tx_runtime.world.geometry.lane_neighbours import number_of_lane

from .lane_planning import beside_command, lane_command
from .lateral_speed_planning import lateral_speed_command

if TYPE_CHECKING:
    from osc2tx_runtime.domain.objects.physical_objects import PhysicalObject
    from osc2tx_runtime.domain.planning.motion_action import ModifiedMotion, MotionAction


def side_command(action: ModifiedMotion) -> Command | None:
    """The lateral command; None if no modifier requires one.

    Raises:
        Refused: It is not possible.
    """
    modifiers, exact = action.lasting, action.may_jump
    along, timed = one_of_kind(modifiers, Along), one_of_kind(modifiers, AlongTrajectory)
    if along is not None:
        offsets, route = (value_of(along.start_offset), value_of(along.end_offset)), along.way
        if isinstance(route, Route):
            if action.movable.lane_bound and route.found.kind != "crossing":
                return _along_route(action, along, route)
            route = MadeRoute((), route_elements=(route,))
        return path_command(action.world.map, action.here, route, offsets, exact=exact)
    if timed is not None:
        offsets = (value_of(timed.start_offset), value_of(timed.end_offset))
        commands = trajectory_commands(
            action.world.map, action.here, now(timed.trajectory), offsets, exact=exact
        )
        return commands[LATERAL]
    speeds = [m for m in action.commanding if isinstance(m, Speed) and m.direction == "lateral"]
    if any(speed in modifiers for speed in speeds) or (speeds and exact):
        return lateral_speed_command(action, speeds)
    turned = one_of_kind(modifiers, Yaw) or one_of_kind(modifiers, Orient)
    if turned is not None:
        return turn_command(action, turned)
    return _across(action)


def _across(action: ModifiedMotion) -> Command | None:
    """The command for a lane, an offset in it, or a position beside another actor.

    None without one.
    """
    lateral = one_of_kind(action.lasting, Lateral)
    if lateral is not None and lateral.side_of is not None:
        return beside_command(action, lateral)
    return lane_command(action, lateral)


def follow_reference(action: ModifiedMotion) -> object:
    """The property of a reference that determines the lateral target and may change.

    None without one. A lane beside another actor follows its lane changes up to the end of the
    action (§8.9.1.3), and a relative heading follows its turns.
    """
    for modifier in action.lasting:
        if getattr(modifier, "projected", False):
            continue
        if isinstance(modifier, Lane) and modifier.reference is not None:
            return lane_of(action, modifier.reference)
        if getattr(modifier, "at", "all") != "all":
            continue
        if isinstance(modifier, Yaw | Orient) and modifier.relative_to is not None:
            return action.world.state(modifier.relative_to.id).h
    return None


def lane_of(action: MotionAction, reference: PhysicalObject) -> int | None:
    """The number of the lane of an actor from the right; None off the lanes for driving."""
    place = action.world.state(reference.id).lane_position
    return None if place is None else number_of_lane(action.world.map, place, "right") or None


def _along_route(action: ModifiedMotion, along: Along, route: Route) -> FollowRoute:
    """The command along the lanes to the end of a route of the map."""
    graph = graph_of(action.world.map)
    end = graph.end(graph.seen_from(route.found, action.here.lane_position))
    goal = on_route(graph, route.found, end, -value_of(along.end_offset)).position
    aims = any(isinstance(m, Lane | Lateral) and m.at == "end" for m in action.lasting)
    return FollowRoute(goal, _across(action), ends=not aims)
