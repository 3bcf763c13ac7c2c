"""From modifiers to the lateral command of an action."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Literal

from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.modifiers import (
    Along,
    AlongTrajectory,
    ChangeLane,
    Lane,
    Lateral,
    Orient,
    Speed,
    Yaw,
)
from osc2tx_runtime.modifiers.base import course_of, now
from osc2tx_runtime.opendrive import LanePosition
from osc2tx_runtime.poses import heading_of, one_of_kind
from osc2tx_runtime.registry import LATERAL
from osc2tx_runtime.road_graph import RoadGraph
from osc2tx_runtime.road_parts import RoadPart
from osc2tx_runtime.world.commands import (
    Beside,
    Command,
    FollowRoute,
    LaneChange,
    LaneOffset,
    Sideways,
    Slant,
    Turn,
)
from osc2tx_runtime.world.curve import turn_between
from osc2tx_runtime.world.lanes import lane_with_number, lanes_to_left, number_of_lane
from osc2tx_runtime.world.lateral import HEADING_LIMIT, excessive_shift

from .courses import path_command, trajectory_commands
from .support import Refused

if TYPE_CHECKING:
    from osc2tx_runtime.road_parts import RoadPart
    from osc2tx_runtime.world.profiles import DynamicProfile

    from .shaped import ShapedAction
    from .support import MotionAction

__all__ = [
    "check_shift",
    "follow_reference",
    "jump_aside",
    "lanes_to",
    "lanes_wanted",
    "side_command",
]


def side_command(action: ShapedAction) -> Command | None:
    """Where to go sideways; None if no modifier speaks of it.

    Raises:
        Refused: It cannot be.
    """
    modifiers, exact = action.lasting, action.may_jump
    along, timed = one_of_kind(modifiers, Along), one_of_kind(modifiers, AlongTrajectory)
    if along is not None:
        offsets, route = (along.start_offset, along.end_offset), along.route
        if isinstance(route, RoadPart):
            return _along_route(action, along, route)
        return path_command(action.world.map, action.here, now(route), offsets, exact=exact)
    if timed is not None:
        offsets = (timed.start_offset, timed.end_offset)
        commands = trajectory_commands(
            action.world.map, action.here, now(timed.trajectory), offsets, exact=exact
        )
        return commands[LATERAL]
    for modifier in modifiers:
        if isinstance(modifier, Speed) and modifier.direction == "lateral":
            low, high = modifier.difference()
            return Sideways(min(max(action.here.lateral_speed, low), high))
    heading = heading_of(action.world, action.movable, modifiers, action.here)
    if heading is not None:
        return _turn(action, heading)
    lateral = one_of_kind(modifiers, Lateral)
    if lateral is not None and lateral.side_of is not None:
        return _beside(action, lateral)
    return _lane(action, lateral)


def follow_reference(action: ShapedAction) -> object:
    """What of a reference decides where to go sideways and may change; None if nothing does.

    A lane beside another actor is another one when that actor changes lanes, and a heading
    relative to it changes when it turns.
    """
    for modifier in action.lasting:
        if getattr(modifier, "at", "all") != "all" or getattr(modifier, "projected", False):
            continue
        if isinstance(modifier, Lane) and modifier.reference is not None:
            place = action.world.state(modifier.reference.id).lane_position
            if place is not None:
                return number_of_lane(action.world.map, place, "right") or None
        if isinstance(modifier, Yaw | Orient) and modifier.relative_to is not None:
            return action.world.state(modifier.relative_to.id).h
    return None


def _along_route(action: ShapedAction, along: Along, route: RoadPart) -> FollowRoute:
    """In the lanes to the end of a route of the map."""
    if not action.movable.lane_bound:
        raise Refused("only vehicles go along routes of the map; others along paths")
    graph = RoadGraph(action.world.map)
    end = graph.end(graph.seen_from(route.found, action.here.lane_position))
    return FollowRoute(graph.map.advance(end, -along.end_offset).position)


def _turn(action: ShapedAction, heading: float) -> Command | None:
    here = action.here
    if not action.movable.lane_bound or here.lane_position is None:
        if action.may_jump:
            actor_id, world = action.actor.id, action.world
            action.effect("heading", heading, lambda: world.assign(actor_id, heading=heading))
        return Turn(heading)
    lane = action.world.map.pose(here.lane_position)
    angle = turn_between(lane.h, heading)
    if abs(angle) > HEADING_LIMIT:
        raise Refused(
            f"{action.actor.id} follows its lane and can turn {math.degrees(HEADING_LIMIT):.1f}"
            f" degrees from it, not {math.degrees(abs(angle)):.1f}"
        )
    return Slant(angle)


def _beside(action: ShapedAction, lateral: Lateral) -> Command:
    assert lateral.side_of is not None
    other = action.world.state(lateral.side_of.id)
    low, high = lateral.offsets(action.here.width, other.width)
    time = action.time_left() if lateral.at == "end" else None
    return Beside(
        lateral.side_of.id, low, spread=high - low, projected=lateral.projected, duration=time
    )


def _lane(action: ShapedAction, lateral: Lateral | None) -> Command | None:
    kinds = (Lane, ChangeLane, Lateral)
    found = [m for m in action.lasting if isinstance(m, kinds)]
    lanes = _lanes(action)
    if lanes is None and lateral is None:
        return None
    offset = 0.0
    if lateral is not None:
        offset = _offset(action, lateral, lanes or 0)
    if not lanes and lateral is None and action.here.offset == 0.0:
        return None
    if action.may_jump:
        jump_aside(action, lanes or 0, offset)
        return None
    profile, peak = _course(found)
    duration = None
    if any(modifier.at == "end" for modifier in found) and profile != "asap" and peak is None:
        duration = action.time_left()
    if duration is not None and action.option() == "must_be_physical":
        check_shift(action, lanes or 0, offset, duration)
    if lanes is None:
        return LaneOffset(offset, profile, peak, duration)
    return LaneChange(lanes, offset, profile, peak, duration)


def _course(modifiers: list[Lane | ChangeLane | Lateral]) -> tuple[DynamicProfile, float | None]:
    """Profile and peak of the lateral speed."""
    shapes = [modifier.shape for modifier in modifiers if modifier.shape is not None]
    return course_of(shapes[0] if shapes else None)


def _offset(action: ShapedAction, lateral: Lateral, lanes: int) -> float:
    """Metres left of the centre of the lane to be in."""
    there = _target(action, lanes)
    width = action.world.map.lane_width(there.road, there.lane, there.s)
    here = action.here.offset or 0.0 if lanes == 0 else 0.0
    return lateral.offset(action.here.width, width, here)


def _side(lanes: int) -> Literal["left", "right"]:
    return "left" if lanes > 0 else "right"


def _target(action: ShapedAction, lanes: int) -> LanePosition:
    here = action.place_of(action.actor.id)
    if lanes == 0:
        return here
    there = action.world.map.neighbour(here, _side(lanes), abs(lanes))
    if there is None:
        raise Refused(
            f"there is no such lane to the {_side(lanes)} of lane {here.lane} of road {here.road}"
            f" at s = {here.s:.1f} m"
        )
    return there


def jump_aside(action: ShapedAction, lanes: int, offset: float) -> None:
    """Puts the actor so many lanes to the left and so far (m) left of the centre, at once.

    Raises:
        Refused: There is no such lane.
    """
    there = _target(action, lanes)
    at = LanePosition(there.road, there.lane, there.s, offset)
    actor_id, world = action.actor.id, action.world
    action.effect("lane", (lanes, offset), lambda: world.assign(actor_id, at=at))


def check_shift(action: ShapedAction, lanes: int, offset: float, duration: float) -> None:
    """Refuses a change of the place across the road that is beyond the limits of the actor.

    Raises:
        Refused: It is, or there is no such lane.
    """
    reason = excessive_shift(
        action.world.map, action.here, _target(action, lanes), offset, duration, action.limits
    )
    if reason is not None:
        raise Refused(reason)


def _lanes(action: ShapedAction) -> int | None:
    """Lanes to the left of the present one; None if no modifier names a lane."""
    change = one_of_kind(action.lasting, ChangeLane)
    if change is not None:
        side = change.side or action.drawn_side(change.lane)
        return change.lane if side == "left" else -change.lane
    lane = one_of_kind(action.lasting, Lane)
    return None if lane is None else lanes_wanted(action, lane)


def lanes_wanted(action: MotionAction, lane: Lane) -> int:
    """Lanes to the left of the present one at which a modifier wants the actor.

    Raises:
        Refused: There is no such lane.
    """
    own = action.place_of(action.actor.id)
    try:
        if lane.reference is not None:
            beside = lanes_to_left(action.world.map, own, action.place_of(lane.reference.id))
            if lane.side_of is None:
                return beside
            return beside + (lane.number if lane.side == "left" else -lane.number)
    except ScenarioError as error:
        raise Refused(error.message) from error
    target = lane_with_number(action.world.map, own, lane.number, lane.from_)
    if target is None:
        raise Refused(
            f"road {own.road} has no lane {lane.number} from the {lane.from_}"
            f" at s = {own.s:.1f} m"
        )
    return lanes_to_left(action.world.map, own, target)


def lanes_to(action: MotionAction, lane: RoadPart) -> int:
    """Lanes to the left of the present one at which a lane of the map is.

    Raises:
        Refused: It is not beside the actor, or runs the other way.
    """
    own, found, road_map = action.place_of(action.actor.id), lane.found, action.world.map
    if found.lane is None or found.road != own.road:
        raise Refused(f"{action.actor.id} is on road {own.road}, so it cannot change to {found}")
    target = LanePosition(own.road, found.lane, own.s)
    beside = road_map.lanes(own.road, own.s, like=own.lane)
    if found.lane not in beside:
        raise Refused(f"{found} is not beside lane {own.lane} at s = {own.s:.1f} m")
    return lanes_to_left(road_map, own, target)
