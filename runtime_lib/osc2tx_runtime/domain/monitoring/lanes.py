"""Monitors of the lane and of the lateral position (DSL 8.9.8, 8.9.14 to 8.9.16)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.modifiers import ChangeLane, Lane, Lateral
from osc2tx_runtime.domain.modifiers.base import Late, now
from osc2tx_runtime.domain.monitoring.conditions import Condition, Reading
from osc2tx_runtime.domain.monitoring.registry import monitors
from osc2tx_runtime.domain.monitoring.shaped_values import (
    follows_course,
    is_course,
    moment,
    present,
)
from osc2tx_runtime.enums import SideLeftRight
from osc2tx_runtime.opendrive import LanePosition, RoadMap
from osc2tx_runtime.world.geometry.lane_neighbours import (
    actual_lane,
    are_opposed,
    lane_with_number,
    lanes_to_left,
    offset_from,
)
from osc2tx_runtime.world.measuring.distances import is_oncoming, lateral_on_road

if TYPE_CHECKING:
    from osc2tx_runtime.domain.monitoring.phase import Phase
    from osc2tx_runtime.world.state import ActorState

_WITHIN = 1.0  # m from the lane centre that count as in the lane


@monitors("lane")
def lane(modifier: Lane, phase: Phase) -> Iterator[Condition]:
    """The lane, by its number from an edge or relative to the lane of a reference."""
    if modifier.reference is None:
        measure, where = _numbered(modifier, phase), f"lane {modifier.number}"
        where += f" from the {modifier.edge}"
    else:
        measure, where = _beside(modifier, phase), f"the lane of {modifier.reference.id}"
        if modifier.side_of is not None:
            where = f"lane {modifier.number} {_side(modifier.side)} of {modifier.reference.id}"
    text, steady = lanes_text(phase, where), modifier.reference is None
    yield Condition(
        "lane",
        "its lane",
        "lane",
        moment(modifier),
        measure,
        text,
        is_steady=steady,
        is_target=is_course(modifier),
    )


def _side(side: Late[SideLeftRight] | None) -> SideLeftRight | None:
    return None if side is None else now(side)


def lanes_text(phase: Phase, where: str) -> Callable[[Reading], str]:
    """Return a description of the lane of an actor and of the required lane."""

    def text(reading: Reading) -> str:
        lanes = round(reading[0] - reading[1])
        side = "left" if lanes > 0 else "right"
        place = phase.me().lane_position
        here = "" if place is None else f"in lane {place.lane} of road {place.road}, "
        return f"it is {here}{abs(lanes)} to the {side} of {where}"

    return text


def _numbered(modifier: Lane, phase: Phase) -> Callable[[], Reading | None]:
    """Number of lanes to the left of the numbered lane."""
    number, edge, road_map = modifier.number, modifier.edge, phase.world.map

    def lanes(place: LanePosition) -> float | None:
        target = lane_with_number(road_map, place, number, edge)
        return None if target is None else lanes_to_left(road_map, target, place)

    return _by_lane(phase, lanes)


def _beside(modifier: Lane, phase: Phase) -> Callable[[], Reading | None]:
    """Number of lanes to the left of the lane beside a reference."""
    assert modifier.reference is not None
    road_map, me = phase.world.map, phase.me
    other = phase.track(modifier.reference.id, modifier.projected)
    count = 0 if modifier.side_of is None else modifier.number
    wanted = float(-count if _side(modifier.side) == "right" else count)

    def measure() -> Reading | None:
        here, there = me().lane_position, other().lane_position
        if here is None or there is None:
            return None
        lanes = -float(lanes_to_left(road_map, here, there))
        left = -wanted if are_opposed(road_map, here, there) else wanted
        return lanes, left, left

    return measure


def _by_lane(
    phase: Phase, lanes: Callable[[LanePosition], float | None]
) -> Callable[[], Reading | None]:
    """Return a measure that is evaluated only when the lane of the actor changes."""
    me, road_map = phase.me, phase.world.map
    known: tuple[object, Reading | None] = (None, None)

    def measure() -> Reading | None:
        nonlocal known
        place = me().lane_position
        if place is None:
            return None
        lane = _lane_of(road_map, place)
        if known[0] != lane:
            found = lanes(place)
            known = (lane, None if found is None else (found, 0.0, 0.0))
        return known[1]

    return measure


def _lane_of(road_map: RoadMap, place: LanePosition) -> object:
    """Key of the lane, and whether the actor is within it."""
    beyond = abs(place.offset) > _WITHIN and actual_lane(road_map, place)
    return (
        place.road,
        place.lane,
        road_map.roads[place.road].section_at(place.s),
        beyond and (beyond.lane),
    )


def lanes_from_start(phase: Phase) -> Callable[[], float | None]:
    """Return a measure of the number of lanes to the left of the lane at the start."""
    road_map, first = phase.world.map, phase.first.lane_position

    def lanes(place: LanePosition) -> float | None:
        if first is None:
            return None
        along = road_map.route_distance(first, place)
        if along is None:
            return None
        same = road_map.advance(first, along).position
        return float(lanes_to_left(road_map, same._replace(offset=first.offset), place))

    measure = _by_lane(phase, lanes)

    def count() -> float | None:
        reading = measure()
        return None if reading is None else reading[0]

    return count


@monitors("keep_lane")
def keep_lane(modifier: object, phase: Phase) -> Iterator[Condition]:
    """The lane at the start, all the time."""
    lanes = lanes_from_start(phase)

    def measure() -> Reading | None:
        found = lanes()
        return None if found is None else (found, 0.0, 0.0)

    text = lanes_text(phase, "its lane at the start")
    yield Condition("keep_lane", "its lane", "lane", "all", measure, text, is_steady=True)


@monitors("change_lane")
def change_lane(modifier: ChangeLane, phase: Phase) -> Iterator[Condition]:
    """The lane at the end, relative to the lane at the start.

    A change before the end is not checked.
    """
    lanes, count = lanes_from_start(phase), float(modifier.number)
    side = _side(modifier.side)

    def measure() -> Reading | None:
        found = lanes()
        if found is None:
            return None
        target = count if side == "left" or (side is None and found > 0.0) else -count
        return found, target, target

    where = f"the lane {modifier.number} {side or 'beside'} of its lane at the start"
    yield Condition("change_lane", "its lane", "lane", "end", measure, lanes_text(phase, where))


@monitors("lateral")
def lateral(modifier: Lateral, phase: Phase) -> Iterator[Condition]:
    """The lateral position in the lane, or relative to a reference."""
    road_map, me, stated = phase.world.map, phase.me, present(modifier, phase)
    if modifier.side_of is None:
        leaves = any(isinstance(each, Lane | ChangeLane) for each in phase.modifiers)
        lane_of_it = _lane_of_offset(phase, leaves or "change_lane" in phase.action.registered.name)

        def measure() -> Reading | None:
            lane = lane_of_it()
            return None if lane is None else _in_lane(road_map, me(), lane, stated())

        what = "its distance left of its lane's centre"
    else:
        other = phase.track(modifier.side_of.id, modifier.projected)

        def measure() -> Reading | None:
            here, there = me(), other()
            to_left = lateral_on_road(road_map, here, there)
            if to_left is None:
                return None
            oncoming = is_oncoming(here, there)
            return (0.0 - to_left, *stated().offsets(here.width, there.width, oncoming=oncoming))

        what = f"its distance left of {modifier.side_of.id}"
    steady = modifier.side_of is None and now(modifier.measure_by) == "center_to_center"
    yield Condition(
        "lateral",
        what,
        "lateral position",
        moment(modifier),
        measure,
        is_steady=steady and not follows_course(modifier),
        is_target=is_course(modifier),
    )


def _lane_of_offset(phase: Phase, leaves: bool) -> Callable[[], LanePosition | None]:
    """Return a reader of the lane from which an offset counts.

    That is the lane at the start, which a large offset may leave; if a modifier or the action
    states another lane, it is the present lane. An actor that only overlaps a lane boundary at the
    start is still in its lane.
    """
    road_map, me, lanes = phase.world.map, phase.me, lanes_from_start(phase)

    def only_reaches_over() -> bool:
        first = phase.first.lane_position
        if first is None or abs(first.offset) <= _WITHIN:
            return False
        centre = road_map.pose(actual_lane(road_map, first))
        return (
            abs(offset_from(road_map, first._replace(offset=0.0), centre.x, centre.y))
            - abs(first.offset)
            > _WITHIN
        )

    def lane_of_it() -> LanePosition | None:
        place = me().lane_position
        if place is None:
            return None
        left = 0.0 if leaves or only_reaches_over() else lanes() or 0.0
        if left == 0.0 and abs(place.offset) <= _WITHIN:
            return place._replace(offset=0.0)
        here = actual_lane(road_map, place)
        if left == 0.0:
            return here
        side: SideLeftRight = "right" if left > 0.0 else "left"
        return road_map.neighbour(here, side, round(abs(left)), either_way=True)

    return lane_of_it


def _in_lane(
    road_map: RoadMap, state: ActorState, lane: LanePosition, modifier: Lateral
) -> Reading:
    """Distance of an actor to the left of a lane centre, in its direction of travel."""
    width = road_map.lane_width(lane.road, lane.lane, lane.s)
    place = state.lane_position
    if place is not None and (place.road, place.lane) == (lane.road, lane.lane):
        return (place.offset, *modifier.offsets(state.width, width))
    offset = offset_from(road_map, lane, state.x, state.y)
    if place is not None and are_opposed(road_map, place, lane):
        offset = -offset
    return (offset, *modifier.offsets(state.width, width))
