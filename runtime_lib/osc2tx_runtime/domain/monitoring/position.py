"""Monitors of the position along the road, and of the distance (DSL 8.9.2, 8.9.3, 8.9.13)."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.modifiers import Distance, Position
from osc2tx_runtime.domain.monitoring.conditions import Condition, Reading
from osc2tx_runtime.domain.monitoring.registry import monitors
from osc2tx_runtime.domain.monitoring.shaped_values import is_course, limits, moment
from osc2tx_runtime.domain.placing.pose_resolution import pose_of
from osc2tx_runtime.domain.routes.lane_coordinates import position_from
from osc2tx_runtime.opendrive import LanePosition
from osc2tx_runtime.world.measuring.distances import along_lanes

if TYPE_CHECKING:
    from osc2tx_runtime.domain.monitoring.phase import Phase


@monitors("position")
def position(modifier: Position, phase: Phase) -> Iterator[Condition]:
    """The position along the road, relative to a reference, a point, or the start of the road."""
    if modifier.reference is not None:
        side = "ahead of" if modifier.ahead else "behind"
        what = f"its distance {side} {modifier.reference.id}"
        measure = _beside(modifier, phase)
    elif modifier.absolute:
        what, measure = "its distance from the point", _at_point(modifier, phase)
    elif modifier.reference_point is not None:
        what = f"its distance {'ahead of' if modifier.ahead else 'behind'} the point"
        measure = _from_point(modifier, phase)
    else:
        what, measure = "its position along its road", _on_road(modifier, phase)
    course = is_course(modifier)
    yield Condition("position", what, "position", moment(modifier), measure, is_target=course)


def _beside(modifier: Position, phase: Phase) -> Callable[[], Reading | None]:
    assert modifier.reference is not None
    road_map, me = phase.world.map, phase.me
    other = phase.track(modifier.reference.id, modifier.projected)
    size = limits(modifier, phase, Position.size)
    sign = 1.0 if modifier.ahead else -1.0

    def measure() -> Reading | None:
        here, there = me(), other()
        along = along_lanes(road_map, there, here)
        if along is None:
            return None
        low, high = size()
        if not modifier.timed:
            return sign * along, low, high
        trailing = max(there.v if along > 0.0 else here.v, 0.0)
        return sign * along, low * trailing, high * trailing

    return measure


def _on_road(modifier: Position, phase: Phase) -> Callable[[], Reading | None]:
    road_map, me, origin = phase.world.map, phase.me, phase.first.lane_position
    size = limits(modifier, phase, Position.size)

    def measure() -> Reading | None:
        place = me().lane_position
        if place is None:
            return None
        return position_from(road_map, origin or place, place), *size()

    return measure


def _from_point(modifier: Position, phase: Phase) -> Callable[[], Reading | None]:
    point = modifier.reference_point
    assert point is not None
    size = limits(modifier, phase, Position.size)
    along = _along_from(phase, point.x, point.y, point.z)
    sign = 1.0 if modifier.ahead else -1.0

    def measure() -> Reading | None:
        found = along()
        return None if found is None else (sign * found, *size())

    return measure


def _at_point(modifier: Position, phase: Phase) -> Callable[[], Reading | None]:
    at, _ = pose_of(phase.action.actor, modifier)  # type: ignore[arg-type]
    along, me = _along_from(phase, at.x, at.y, at.z), phase.me
    by_road = modifier.at_point is not None and modifier.project_on_route

    def measure() -> Reading | None:
        found = along() if by_road else math.hypot(me().x - at.x, me().y - at.y)
        return None if found is None else (found, 0.0, 0.0)

    return measure


def _along_from(phase: Phase, x: float, y: float, z: float) -> Callable[[], float | None]:
    """Return a reader of the distance (m) along lanes from a point to the actor."""
    road_map, me = phase.world.map, phase.me
    on = road_map.locate(x, y, z)
    begin = None if on is None else LanePosition(on.road, on.lane, on.s)

    def along() -> float | None:
        here = me().lane_position
        if begin is None or here is None:
            return None
        return road_map.route_distance(begin, here)

    return along


@monitors("keep_position")
def keep_position(modifier: object, phase: Phase) -> Iterator[Condition]:
    """The position in the world at the start, all the time."""
    first, me = phase.first, phase.me

    def measure() -> Reading:
        here = me()
        return math.hypot(here.x - first.x, here.y - first.y), 0.0, 0.0

    what = "its distance from its position at the start"
    yield Condition("keep_position", what, "position", "all", measure)


@monitors("distance")
def distance(modifier: Distance, phase: Phase) -> Iterator[Condition]:
    """The distance covered from the start to the end of the phase."""
    way, covered = modifier.way(), phase.covered()
    yield Condition(
        "distance",
        "the distance that it has covered",
        "position",
        "end",
        lambda: (covered(), way, way),
    )
