"""Target lanes and offsets of lateral motions; checks that they are feasible."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.map.road_graph import RoadGraph
from osc2tx_runtime.domain.modifiers import Lane
from osc2tx_runtime.domain.planning.motion_action import Refused
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.actions.action import Action
from osc2tx_runtime.language.actions.registry import LATERAL
from osc2tx_runtime.language.tree import Serial
from osc2tx_runtime.opendrive import LanePosition
from osc2tx_runtime.world.geometry.lane_neighbours import (
    are_opposed,
    lane_beside,
    lane_with_number,
    lanes_to_left,
)
from osc2tx_runtime.world.lateral.execution import excessive_shift

if TYPE_CHECKING:
    from osc2tx_runtime.domain.map.roads_and_lanes import RoadPart
    from osc2tx_runtime.domain.planning.motion_action import ModifiedMotion, MotionAction
    from osc2tx_runtime.language.tree.base import Behaviour


def leads_beside(graph: RoadGraph, place: LanePosition, lanes: int) -> bool:
    """Whether a lane, or its continuation, has enough lanes to its left."""
    lane = graph.segment_of(graph.map.lane_key(place))
    reached, seen = [lane], {lane}
    for each in reached:
        assert each.lane is not None
        section = graph.map.roads[each.road].sections[each.section or 0]
        middle = 0.5 * (section.begin + section.end)
        there = LanePosition(each.road, each.lane, place.s if each == lane else middle)
        if lane_beside(graph.map, there, lanes) is not None:
            return True
        onward = [after for after in graph.after(each) if after not in seen]
        seen.update(onward)
        reached += onward
    return False


def may_leave_lane_before(action: MotionAction) -> bool:
    """Whether its actor may change the lane before an action starts."""
    *_, root = _upwards(action)
    for other in root.iterate():
        if other is action or not isinstance(other, Action) or other.actor is not action.actor:
            continue
        leaves = LATERAL in other.slots or other.registered.is_momentary
        if leaves and not _comes_after(other, action):
            return True
    return False


def _comes_after(other: Behaviour, action: Behaviour) -> bool:
    """Whether a node starts only after the end of an action."""
    branch = {id(above): below for below, above in _steps(action)}
    for below, above in _steps(other):
        if id(above) in branch:
            members = list(above.children)
            later = members.index(below) > members.index(branch[id(above)])
            return isinstance(above, Serial) and later
    return False


def _steps(node: Behaviour) -> Iterator[tuple[Behaviour, Behaviour]]:
    """Yield the ancestors of a node, each with its parent."""
    way = list(_upwards(node))
    yield from pairwise(way)


def _upwards(node: Behaviour | None) -> Iterator[Behaviour]:
    while node is not None:
        yield node
        node = node.parent


def target_of_shift(action: ModifiedMotion, lanes: int) -> LanePosition:
    """The centre of the lane a number of lanes to the left of the present one (`lane_beside`).

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
    """Sets the lane and the offset (m) of the actor instantly; positive to the left.

    Raises:
        Refused: There is no such lane.
    """
    there = target_of_shift(action, lanes)
    at = there._replace(offset=there.offset + offset)
    actor_id, world = action.actor.id, action.world
    action.effect("lane", (lanes, offset), lambda: world.assign(actor_id, at=at))


def check_shift(action: ModifiedMotion, lanes: int, offset: float, duration: float) -> None:
    """Rejects a lateral motion that exceeds the limits of the actor.

    Raises:
        Refused: It exceeds them, or there is no such lane.
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
    """Number of lanes to the left of the present one that a modifier requires.

    Raises:
        Refused: There is no such lane.
    """
    if lane.reference is not None:
        count = 0 if lane.side_of is None else lane.number
        return lanes_beside(action, lane.reference.id, count if lane.side == "left" else -count)
    own = action.place_of(action.actor.id)
    target = lane_with_number(action.world.map, own, lane.number, lane.edge)
    if target is None:
        raise Refused(
            f"road {own.road} has no lane {lane.number} from the {lane.edge} at s = {own.s:.1f} m"
        )
    return _lanes_between(action, own, target)


def lanes_beside(action: MotionAction, reference: str, lanes: int) -> int:
    """Number of lanes from the present one to the lane beside a reference, positive to the left.

    The left side of an oncoming reference is seen from its driver.

    Raises:
        Refused: There is no such lane.
    """
    own, theirs = (action.place_of(each) for each in (action.actor.id, reference))
    between = _lanes_between(action, own, theirs)
    return between - lanes if are_opposed(action.world.map, own, theirs) else between + lanes


def lanes_to(action: MotionAction, lane: RoadPart) -> int:
    """Number of lanes to the left of the present one to a lane of the map.

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
