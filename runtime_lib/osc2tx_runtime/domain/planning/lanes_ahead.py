"""What is known before the run of the lanes that an actor will have beside it."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.routes.road_graph import RoadGraph
from osc2tx_runtime.language.action import Action
from osc2tx_runtime.language.registry import LATERAL
from osc2tx_runtime.language.tree import Serial
from osc2tx_runtime.opendrive import LanePosition
from osc2tx_runtime.world.lane_neighbours import lane_beside

if TYPE_CHECKING:
    from osc2tx_runtime.domain.planning.motion_action import MotionAction
    from osc2tx_runtime.language.tree.base import Behaviour

__all__ = ["leads_beside", "may_leave_lane_before"]


def leads_beside(graph: RoadGraph, place: LanePosition, lanes: int) -> bool:
    """Whether a lane has so many others to its left, here or anywhere that it leads to."""
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
    """Whether its actor may go to another lane before an action starts."""
    *_, root = _upwards(action)
    for other in root.iterate():
        if other is action or not isinstance(other, Action) or other.actor is not action.actor:
            continue
        leaves = LATERAL in other.slots or other.registered.is_momentary
        if leaves and not _comes_after(other, action):
            return True
    return False


def _comes_after(other: Behaviour, action: Behaviour) -> bool:
    """Whether something starts only when an action is over."""
    branch = {id(above): below for below, above in _steps(action)}
    for below, above in _steps(other):
        if id(above) in branch:
            members = list(above.children)
            later = members.index(below) > members.index(branch[id(above)])
            return isinstance(above, Serial) and later
    return False


def _steps(node: Behaviour) -> Iterator[tuple[Behaviour, Behaviour]]:
    """Yield nodes on the way up, each with the one above it."""
    way = list(_upwards(node))
    yield from pairwise(way)


def _upwards(node: Behaviour | None) -> Iterator[Behaviour]:
    while node is not None:
        yield node
        node = node.parent
