"""From modifiers to the lateral command of a movement."""

from __future__ import annotations

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
from osc2tx_runtime.opendrive import LanePosition
from osc2tx_runtime.poses import heading_of, one_of_kind
from osc2tx_runtime.registry import LATERAL
from osc2tx_runtime.world.commands import (
    Beside,
    Command,
    LaneChange,
    LaneOffset,
    Sideways,
    Turn,
)
from osc2tx_runtime.world.lanes import lane_with_number, lanes_to_left
from osc2tx_runtime.world.lateral import excessive_shift

from .courses import path_command, trajectory_commands
from .paths import now
from .support import Refused

if TYPE_CHECKING:
    from .movement import Movement

__all__ = ["side_command"]


def side_command(action: Movement) -> Command | None:
    """Where to go sideways; None if no modifier speaks of it.

    Raises:
        Refused: It cannot be.
    """
    modifiers = action.modifiers
    exact = action.option() == "prefer_non_physical"
    along, timed = one_of_kind(modifiers, Along), one_of_kind(modifiers, AlongTrajectory)
    if along is not None:
        offsets = (along.start_offset, along.end_offset)
        return path_command(action.here, now(along.route), offsets, exact=exact)
    if timed is not None:
        offsets = (timed.start_offset, timed.end_offset)
        commands = trajectory_commands(action.here, now(timed.trajectory), offsets, exact=exact)
        return commands[LATERAL]
    for modifier in modifiers:
        if isinstance(modifier, Speed) and modifier.direction == "lateral":
            return Sideways(modifier.difference())
    heading = heading_of(action.world, action.movable, modifiers, action.here)
    if heading is not None:
        return _turn(action, heading)
    lateral = one_of_kind(modifiers, Lateral)
    if lateral is not None and lateral.side_of is not None:
        other = action.world.state(lateral.side_of.id)
        return Beside(lateral.side_of.id, lateral.offset(action.here.width, other.width))
    return _lane(action, lateral)


def _turn(action: Movement, heading: float) -> Command | None:
    turned = one_of_kind(action.modifiers, Yaw) or one_of_kind(action.modifiers, Orient)
    assert turned is not None  # else there is no heading
    if turned.at == "start" or action.option() == "prefer_non_physical":
        actor_id, world = action.actor.id, action.world
        action.effect("heading", heading, lambda: world.assign(actor_id, heading=heading))
        return None if turned.at == "start" else Turn(heading)
    return Turn(heading)


def _lane(action: Movement, lateral: Lateral | None) -> Command | None:
    modifiers = action.modifiers
    ending = [m for m in modifiers if isinstance(m, Lane | ChangeLane | Lateral) and m.at == "end"]
    duration = action.fixed_duration() if ending else None
    lanes = _lanes(action)
    if lanes is None and lateral is None:
        return None
    offset = 0.0
    if lateral is not None:
        place = action.place_of(action.actor.id)
        if lanes:
            place = action.world.map.neighbour(place, _side(lanes), abs(lanes)) or place
        width = action.world.map.lane_width(place.road, place.lane, place.s)
        offset = lateral.offset(action.here.width, width)
    if not lanes and lateral is None and action.here.offset == 0.0:
        return None
    if action.option() == "prefer_non_physical":
        _jump(action, lanes or 0, offset)
        return None
    if duration is not None and action.option() == "must_be_physical":
        _check_shift(action, lanes or 0, offset, duration)
    if lanes is None:
        return LaneOffset(offset, duration=duration)
    return LaneChange(lanes, offset, duration=duration)


def _side(lanes: int) -> Literal["left", "right"]:
    return "left" if lanes > 0 else "right"


def _target(action: Movement, lanes: int) -> LanePosition:
    here = action.place_of(action.actor.id)
    if lanes == 0:
        return here
    there = action.world.map.neighbour(here, _side(lanes), abs(lanes))
    if there is None:
        raise Refused(
            f"there is no such lane to the {_side(lanes)} of lane {here.lane} of road {here.road}"
        )
    return there


def _jump(action: Movement, lanes: int, offset: float) -> None:
    """Puts the actor there at once."""
    there = _target(action, lanes)
    at = LanePosition(there.road, there.lane, there.s, offset)
    actor_id, world = action.actor.id, action.world
    action.effect("lane", (lanes, offset), lambda: world.assign(actor_id, at=at))


def _check_shift(action: Movement, lanes: int, offset: float, duration: float) -> None:
    reason = excessive_shift(
        action.world.map, action.here, _target(action, lanes), offset, duration, action.limits
    )
    if reason is not None:
        raise Refused(reason)


def _lanes(action: Movement) -> int | None:
    """Lanes to the left of the present one; None if no modifier names a lane."""
    change, own = one_of_kind(action.modifiers, ChangeLane), None
    if change is not None:
        side = change.side or action.drawn_side(change.lane)
        return change.lane if side == "left" else -change.lane
    lane = one_of_kind(action.modifiers, Lane)
    if lane is None:
        return None
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
