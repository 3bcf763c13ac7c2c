"""Target lanes and offsets of lateral changes; checks that they can be driven."""

from __future__ import annotations

from typing import TYPE_CHECKING

from osc2tx_runtime.domain.modifiers import Lane
from osc2tx_runtime.domain.planning.motion_action import Refused
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.opendrive import LanePosition
from osc2tx_runtime.world.lane_neighbours import (
    are_opposed,
    lane_beside,
    lane_with_number,
    lanes_to_left,
)
from osc2tx_runtime.world.lateral import excessive_shift

if TYPE_CHECKING:
    from osc2tx_runtime.domain.planning.modified_motion import ModifiedMotion
    from osc2tx_runtime.domain.planning.motion_action import MotionAction
    from osc2tx_runtime.domain.routes.roads_and_lanes import RoadPart

__all__ = [
    "check_shift",
    "jump_aside",
    "lanes_beside",
    "lanes_to",
    "lanes_wanted",
    "target_of_shift",
]


def target_of_shift(action: ModifiedMotion, lanes: int) -> LanePosition:
    """The centre of the lane so many to the left of the present one (`lane_beside`).

    Raises:
        Refused: There is no such lane.
    """
    here = action.place_of(action.actor.id)
    there = lane_beside(action.world.map, here, lanes)
    if there is None:
        side = "left" if lanes > 0 else "right"
        raise Refused(
            f"there is no such lane to the {side} of lane {here.lane} of road {here.road}"
            f" at s = {here.s:.1f} m"
        )
    return there


def jump_aside(action: ModifiedMotion, lanes: int, offset: float) -> None:
    """Puts the actor so many lanes to the left and so far (m) left of the centre, at once.

    Raises:
        Refused: There is no such lane.
    """
    there = target_of_shift(action, lanes)
    at = there._replace(offset=there.offset + offset)
    actor_id, world = action.actor.id, action.world
    action.effect("lane", (lanes, offset), lambda: world.assign(actor_id, at=at))


def check_shift(action: ModifiedMotion, lanes: int, offset: float, duration: float) -> None:
    """Refuses a change of the place across the road that is beyond the limits of the actor.

    Raises:
        Refused: It is, or there is no such lane.
    """
    reason = excessive_shift(
        action.world.map,
        action.here,
        target_of_shift(action, lanes),
        offset,
        duration,
        action.limits,
    )
    if reason is not None:
        raise Refused(reason)


def lanes_wanted(action: MotionAction, lane: Lane) -> int:
    """Lanes to the left of the present one at which a modifier wants the actor.

    Raises:
        Refused: There is no such lane.
    """
    if lane.reference is not None:
        count = 0 if lane.side_of is None else lane.number
        return lanes_beside(action, lane.reference.id, count if lane.side == "left" else -count)
    own = action.place_of(action.actor.id)
    target = lane_with_number(action.world.map, own, lane.number, lane.from_)
    if target is None:
        raise Refused(
            f"road {own.road} has no lane {lane.number} from the {lane.from_}"
            f" at s = {own.s:.1f} m"
        )
    return _lanes_between(action, own, target)


def lanes_beside(action: MotionAction, reference: str, lanes: int) -> int:
    """Lanes to the left of the present one of the lane so many to the left of a reference.

    What is left of a reference in oncoming traffic is so as it drives.

    Raises:
        Refused: There is no such lane.
    """
    own, theirs = (action.place_of(each) for each in (action.actor.id, reference))
    between = _lanes_between(action, own, theirs)
    return between - lanes if are_opposed(action.world.map, own, theirs) else between + lanes


def lanes_to(action: MotionAction, lane: RoadPart) -> int:
    """Lanes to the left of the present one at which a lane of the map is.

    Raises:
        Refused: It is not beside the actor.
    """
    own, found = action.place_of(action.actor.id), lane.found
    if found.lane is None or found.road != own.road:
        raise Refused(f"{action.actor.id} is on road {own.road}, so it cannot change to {found}")
    if found.lane not in action.world.map.roads[own.road].section_at(own.s).lanes:
        raise Refused(f"{found} is not beside lane {own.lane} at s = {own.s:.1f} m")
    return _lanes_between(action, own, LanePosition(own.road, found.lane, own.s))


def _lanes_between(action: MotionAction, own: LanePosition, lane: LanePosition) -> int:
    try:
        return lanes_to_left(action.world.map, own, lane)
    except ScenarioError as error:
        raise Refused(error.message) from error
