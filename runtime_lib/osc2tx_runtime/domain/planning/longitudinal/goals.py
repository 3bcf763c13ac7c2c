"""Goals of an action: the position or distance at its end, and the distance to it."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.modifiers import (
    Acceleration,
    Along,
    ChangeSpeed,
    Distance,
    KeepSpeed,
    Position,
    Speed,
)
from osc2tx_runtime.domain.placing.pose_resolution import one_of_kind, pose_of
from osc2tx_runtime.domain.planning.motion_action import Refused
from osc2tx_runtime.domain.routes.lane_coordinates import way_to_position
from osc2tx_runtime.opendrive import LanePosition
from osc2tx_runtime.world.commands import FollowSpeed

if TYPE_CHECKING:
    from osc2tx_runtime.domain.planning.motion_action import ModifiedMotion
    from osc2tx_runtime.domain.points_and_poses import Point


def distance_to_cover(action: ModifiedMotion) -> float | None:
    """Metres to the goal of the movement; None without such a goal.

    Raises:
        Refused: The position is not ahead.
    """
    way = None if position_shape(action) else way_to_goal(action)
    counted = one_of_kind(action.modifiers, Distance) is not None
    if way is None or (watched_place(action) is not None and not counted):
        return None
    if way[1] < 0.0:
        raise Refused(f"its target position is {-way[1]:.1f} m behind it")
    if action.duration is None and not action.end_is_known:
        return max(way[0], 0.0)
    return None if speed_at_end(action) is not None else max(way[0], 0.0)


def watched_place(action: ModifiedMotion) -> Position | None:
    """The position at the end, if another modifier determines the speed or the distance."""
    position = lasting_position(action)
    if position is None or position.shape is not None:
        return None
    rates = [m for m in action.lasting if isinstance(m, Acceleration)]
    rules = any(m.at == "all" for m in (*speeds_of(action), *rates))
    rules = rules or one_of_kind(action.lasting, KeepSpeed) is not None
    return position if rules or one_of_kind(action.lasting, Distance) is not None else None


def position_shape(action: ModifiedMotion) -> Along | Distance | Position | None:
    """The modifier with a shape of the position; None without one."""
    for modifier in action.lasting:
        if isinstance(modifier, Along | Distance | Position) and modifier.shape is not None:
            return modifier
    return None


def lasting_position(action: ModifiedMotion) -> Position | None:
    """The position that is not only for the start."""
    return one_of_kind(action.lasting, Position)


def way_to_goal(action: ModifiedMotion) -> tuple[float, float] | None:
    """Least and greatest distance (m) to its goal; None without such a goal."""
    distance = one_of_kind(action.modifiers, Distance)
    if distance is not None:
        way = distance.way()
        return way, way
    position = lasting_position(action)
    if position is None or position.reference is not None or position.stands:
        return None
    return way_to(action, position)


def way_to(action: ModifiedMotion, position: Position) -> tuple[float, float]:
    """Least and greatest distance (m) along the lane to a position on the road."""
    here = action.place_of(action.actor.id)
    low, high = position.size()
    point: Point | None = position.reference_point
    if position.absolute:
        at, _ = pose_of(action.movable, position)
        way = _way_to_point(action, here, at.x, at.y, at.z)
        return way, way
    if point is None:
        along = partial(way_to_position, action.world.map, action.origin, here)
        return along(low), along(high)
    way = _way_to_point(action, here, point.x, point.y, point.z)
    return (way + low, way + high) if position.ahead else (way - high, way - low)


def _way_to_point(
    action: ModifiedMotion, here: LanePosition, x: float, y: float, z: float
) -> float:
    on = action.world.map.locate(x, y, z)
    if on is None:
        raise Refused(f"there is no lane near ({x:g}, {y:g})")
    way = action.world.map.route_distance(here, LanePosition(on.road, on.lane, on.s))
    if way is None:
        raise Refused(f"no route along lanes leads from {action.actor.id} to ({x:g}, {y:g})")
    return way


def speed_at_end(action: ModifiedMotion) -> float | FollowSpeed | None:
    """The required speed at the end (m/s, or that of an actor); None if it is free."""
    lasting = [m for m in speeds_of(action) if m.at == "end"]
    change = one_of_kind(action.lasting, ChangeSpeed)
    if not lasting and change is not None and change.at == "end" and change.shape is None:
        low, high = change.difference()
        return action.here.v + min(max(0.0, low), high)
    if not lasting:
        return None
    speed = lasting[0]
    low, high = speed.difference()
    if speed.reference is None:
        return min(max(action.here.v, low), high)
    return FollowSpeed(speed.reference.id, speed.times, low, high - low)


def speeds_of(action: ModifiedMotion) -> list[Speed]:
    """The modifiers of the speed along the road."""
    return [m for m in action.commanding if isinstance(m, Speed) and m.direction == "longitudinal"]
