"""From modifiers to the longitudinal command of a movement."""

from __future__ import annotations

from typing import TYPE_CHECKING

from osc2tx_runtime.modifiers import (
    Acceleration,
    AlongTrajectory,
    ChangeSpeed,
    Distance,
    KeepPosition,
    Position,
    Speed,
    value_of,
)
from osc2tx_runtime.opendrive import LanePosition
from osc2tx_runtime.poses import one_of_kind
from osc2tx_runtime.registry import LONGITUDINAL
from osc2tx_runtime.routes import along_lane
from osc2tx_runtime.world.commands import (
    Accelerate,
    AccelerationChange,
    Command,
    FollowSpeed,
    KeepGap,
    SpeedChange,
    Standstill,
)
from osc2tx_runtime.world.longitudinal import excessive_acceleration, excessive_rate

from .courses import trajectory_commands
from .paths import now
from .support import Refused

if TYPE_CHECKING:
    from .movement import Movement

__all__ = ["distance_to_cover", "speed_command"]


def speed_command(action: Movement) -> Command | None:
    """What to do with the speed; None if no modifier speaks of it.

    Raises:
        Refused: It cannot be.
    """
    modifiers = action.modifiers
    if one_of_kind(modifiers, KeepPosition) is not None:
        if action.option() == "prefer_non_physical":
            return SpeedChange(0.0, "constant", None, 0.0)
        return Standstill()
    timed = one_of_kind(modifiers, AlongTrajectory)
    if timed is not None:
        offsets = (timed.start_offset, timed.end_offset)
        exact = action.option() == "prefer_non_physical"
        trajectory = now(timed.trajectory)
        return trajectory_commands(action.here, trajectory, offsets, exact=exact)[LONGITUDINAL]
    position = one_of_kind(modifiers, Position)
    if position is not None and position.reference is not None:
        return _gap(position)
    if action.duration is not None:
        way = distance_to_cover(action)
        if way is not None:
            return _in_time(action, way)
    change = one_of_kind(modifiers, ChangeSpeed)
    if change is not None:
        return _checked(action, _to_speed(action, action.here.v + value_of(change.speed), change))
    return _speed(action)


def distance_to_cover(action: Movement) -> float | None:
    """Metres after which the movement has reached its goal; None if it has no such goal.

    Raises:
        Refused: The place is not ahead.
    """
    distance = one_of_kind(action.modifiers, Distance)
    if distance is not None:
        way = value_of(distance.distance)
    else:
        position = one_of_kind(action.modifiers, Position)
        if position is None or position.reference is not None:
            return None
        way = _way_to(action, position)
    if way < 0.0:
        raise Refused(f"the place it is to be at lies {-way:.1f} m behind it")
    return way


def _way_to(action: Movement, position: Position) -> float:
    """Metres along the lane to a place on the road."""
    here = action.place_of(action.actor.id)
    value = value_of(position.distance or 0.0)
    point = position.reference_point
    if point is None:
        return value - along_lane(action.world.map, here)
    on = action.world.map.locate(point.x, point.y, point.z)
    if on is None:
        raise Refused(f"no lane is near ({point.x:g}, {point.y:g})")
    way = action.world.map.route_distance(here, LanePosition(on.road, on.lane, on.s))
    if way is None:
        raise Refused(f"no lane leads from {action.actor.id} to ({point.x:g}, {point.y:g})")
    return way + (value if position.ahead else -value)


def _in_time(action: Movement, way: float) -> Command:
    """The constant acceleration that covers a way in the duration, or stops after it."""
    time, speed = action.fixed_duration(), action.here.v
    if time is None or time <= 0.0:
        raise Refused("a distance in a duration needs one duration, not a range")
    rate = 2.0 * (way - speed * time) / (time * time)
    if speed + rate * time < 0.0:
        rate = -speed * speed / (2.0 * way) if way > 0.0 else -1e9
    _check_acceleration(action, rate)
    return Accelerate(rate)


def _speed(action: Movement) -> Command | None:
    rate = one_of_kind(action.modifiers, Acceleration)
    all_speeds = [
        m for m in action.modifiers if isinstance(m, Speed) and m.direction == "longitudinal"
    ]
    at_start = [m for m in all_speeds if m.at == "start"]
    lasting = [m for m in all_speeds if m.at != "start"]
    start = _value(action, at_start[0]) if at_start else None
    if not lasting:
        if rate is not None:
            return _acceleration(action, rate, start)
        if start is not None:
            _assign(action, start)
        return None
    speed = lasting[0]
    if speed.reference is not None:
        if start is not None:
            _assign(action, start)
        return FollowSpeed(speed.reference.id, speed.factor, speed.difference())
    command = _to_speed(action, speed.difference(), speed, rate, start)
    return _checked(action, command)


def _value(action: Movement, speed: Speed) -> float:
    value = speed.difference()
    if speed.reference is not None:
        value += speed.factor * action.world.state(speed.reference.id).v
    return value


def _assign(action: Movement, value: float) -> None:
    actor_id, world = action.actor.id, action.world
    action.effect("speed", value, lambda: world.assign(actor_id, speed=value))


def _to_speed(
    action: Movement,
    target: float,
    speed: Speed | ChangeSpeed,
    rate: Acceleration | None = None,
    start: float | None = None,
) -> SpeedChange:
    if action.option() == "prefer_non_physical":
        return SpeedChange(target, "constant", None, 0.0)
    if rate is not None:
        return SpeedChange(target, "constant", abs(value_of(rate.acceleration)), start=start)
    profile = speed.rate_profile if isinstance(speed, Speed) else "none"
    peak = speed.rate_peak if isinstance(speed, Speed) else None
    duration = action.fixed_duration() if speed.at == "end" else None
    return SpeedChange(target, profile, peak, duration, start)


def _checked(action: Movement, command: SpeedChange) -> SpeedChange:
    if command.duration == 0.0:
        return command  # it may jump
    start = action.here.v if command.start is None else command.start
    strict = action.option() == "must_be_physical"
    reason = excessive_rate(command, start, action.limits if strict else None)
    if reason is not None:
        raise Refused(reason)
    return command


def _acceleration(action: Movement, rate: Acceleration, start: float | None) -> Command:
    value = value_of(rate.acceleration)
    if action.option() != "prefer_non_physical":
        _check_acceleration(action, value)
    if start is not None and rate.at == "all":
        return Accelerate(value, start)
    if start is not None:
        _assign(action, start)
    match rate.at:
        case "all":
            return Accelerate(value)
        case "start":
            return AccelerationChange(0.0, start=value)
    return AccelerationChange(value, duration=action.fixed_duration())


def _check_acceleration(action: Movement, value: float) -> None:
    strict = action.option() == "must_be_physical"
    reason = excessive_acceleration(value, action.here.v, action.limits if strict else None)
    if reason is not None:
        raise Refused(reason)


def _gap(position: Position) -> KeepGap:
    reference = position.reference
    assert reference is not None
    time = None if position.time is None else value_of(position.time)
    size = time if time is not None else value_of(position.distance or 0.0)
    ahead = position.ahead == (size >= 0.0)
    return KeepGap(
        reference.id,
        ahead,
        "reference",
        distance=abs(size) if time is None else None,
        time=None if time is None else abs(time),
    )
