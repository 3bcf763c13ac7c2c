"""From modifiers to the longitudinal command of an action."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from osc2tx_runtime.modifiers import (
    Acceleration,
    AlongTrajectory,
    ChangeSpeed,
    KeepPosition,
    Position,
    Speed,
)
from osc2tx_runtime.modifiers.base import now
from osc2tx_runtime.poses import one_of_kind
from osc2tx_runtime.registry import LONGITUDINAL
from osc2tx_runtime.world.commands import (
    Accelerate,
    AccelerationChange,
    Arrive,
    Command,
    FollowSpeed,
    KeepGap,
    SpeedChange,
    Standstill,
)
from osc2tx_runtime.world.longitudinal import excessive_acceleration, excessive_rate

from .courses import trajectory_commands
from .support import Refused
from .ways import lasting_position, speed_at_end, speeds_of, watched_place, way_to_goal

if TYPE_CHECKING:
    from .shaped import ShapedAction

__all__ = ["speed_at_start", "speed_command"]


def speed_command(action: ShapedAction) -> Command | None:
    """What to do with the speed; None if no modifier speaks of it.

    Raises:
        Refused: It cannot be.
    """
    modifiers = action.lasting
    if one_of_kind(modifiers, KeepPosition) is not None:
        return SpeedChange(0.0, "constant", None, 0.0) if action.may_jump else Standstill()
    timed = one_of_kind(modifiers, AlongTrajectory)
    if timed is not None:
        offsets = (timed.start_offset, timed.end_offset)
        trajectory = now(timed.trajectory)
        commands = trajectory_commands(
            action.world.map, action.here, trajectory, offsets, exact=action.may_jump
        )
        return commands[LONGITUDINAL]
    position = lasting_position(action)
    if watched_place(action) is not None:
        return _speed(action)
    if position is not None and position.reference is not None:
        return _gap(action, position)
    if action.duration is not None or action.end_is_known:
        way = way_to_goal(action)
        if way is not None:
            return _in_time(action, *way)
    change = one_of_kind(modifiers, ChangeSpeed)
    if change is not None:
        low, high = change.difference()
        target = action.here.v + min(max(0.0, low), high)
        return _checked(action, _to_speed(action, target, change))
    return _speed(action)


def _in_time(action: ShapedAction, low: float, high: float) -> Command:
    """What covers a way in the duration, or stops after it."""
    time, speed = action.time_left(), action.here.v
    if time is None or time <= 0.0:
        raise Refused("a distance in a duration needs one duration, not a range")
    way = min(max(speed * time, low), high)
    end = speed_at_end(action)
    if end is not None:
        return Arrive(time, way=way, speed=end)
    rate = 2.0 * (way - speed * time) / (time * time)
    if speed + rate * time < 0.0:
        rate = -speed * speed / (2.0 * way) if way > 0.0 else -math.inf
    _check_acceleration(action, rate)
    return Accelerate(rate)


def _speed(action: ShapedAction) -> Command | None:
    rate = one_of_kind(action.modifiers, Acceleration)
    lasting = [m for m in speeds_of(action) if m.at != "start"]
    start = _start_speed(action)
    if not lasting:
        if rate is not None:
            return _acceleration(action, rate, start)
        if start is not None:
            _assign(action, start)
        return None
    speed = lasting[0]
    low, high = speed.difference()
    if speed.reference is not None and not speed.projected:
        if start is not None:
            _assign(action, start)
        return FollowSpeed(speed.reference.id, speed.factor, low, high - low)
    if speed.reference is not None:
        other = speed.factor * action.world.state(speed.reference.id).v
        low, high = low + other, high + other
    present = action.here.v if start is None else start
    command = _to_speed(action, min(max(present, low), high), speed, rate, start)
    return _checked(action, command)


def _start_speed(action: ShapedAction) -> float | None:
    """The speed to jump to at the start; None if there is none."""
    found = [m for m in speeds_of(action) if m.at == "start"]
    if not found or not action.may_jump:
        return None
    low, high = speed_at_start(action, found[0])
    return min(max(action.here.v, low), high)


def speed_at_start(action: ShapedAction, speed: Speed) -> tuple[float, float]:
    """Least and greatest speed (m/s) that a modifier allows now."""
    low, high = speed.difference()
    if speed.reference is None:
        return low, high
    other = speed.factor * action.world.state(speed.reference.id).v
    return low + other, high + other


def _assign(action: ShapedAction, value: float) -> None:
    actor_id, world = action.actor.id, action.world
    action.effect("speed", value, lambda: world.assign(actor_id, speed=value))


def _to_speed(
    action: ShapedAction,
    target: float,
    speed: Speed | ChangeSpeed,
    rate: Acceleration | None = None,
    start: float | None = None,
) -> SpeedChange:
    if action.may_jump and start is None:
        return SpeedChange(target, "constant", None, 0.0)
    if rate is not None:
        return SpeedChange(target, "constant", abs(rate.value(0.0)), start=start)
    profile, peak = speed.course
    in_time = speed.at == "end" and profile != "asap" and peak is None
    return SpeedChange(target, profile, peak, action.time_left() if in_time else None, start)


def _checked(action: ShapedAction, command: SpeedChange) -> SpeedChange:
    if command.duration == 0.0:
        return command  # it may jump
    start = action.here.v if command.start is None else command.start
    strict = action.option() == "must_be_physical"
    reason = excessive_rate(command, start, action.limits if strict else action.tyres)
    if reason is not None:
        raise Refused(reason)
    return command


def _acceleration(action: ShapedAction, rate: Acceleration, start: float | None) -> Command:
    value = rate.value(action.here.a)
    if not action.may_jump:
        _check_acceleration(action, value)
    if start is not None and rate.at == "all" and rate.shape is None:
        return Accelerate(value, start)
    if start is not None:
        _assign(action, start)
    if rate.at == "start":
        return AccelerationChange(0.0, start=value)
    if rate.shape is not None:
        shape = rate.shape
        return AccelerationChange(value, shape.rate_profile, shape.rate_peak)
    if rate.at == "all":
        return Accelerate(value)
    return AccelerationChange(value, duration=action.time_left())


def _check_acceleration(action: ShapedAction, value: float) -> None:
    strict = action.option() == "must_be_physical"
    reason = excessive_acceleration(value, action.here.v, action.limits if strict else action.tyres)
    if reason is not None:
        raise Refused(reason)


def _gap(action: ShapedAction, position: Position) -> Command:
    """The command for a place ahead of or behind another actor."""
    reference = position.reference
    assert reference is not None
    low, high = position.size()
    ahead = position.ahead
    if high <= 0.0 and low < 0.0:  # a negative distance is one on the other side
        low, high, ahead = -high, -low, not ahead
    if position.timed and low < 0.0:
        raise Refused("a range of times ahead and behind at once is none it can keep")
    gap = KeepGap(
        reference.id,
        ahead,
        "reference",
        distance=None if position.timed else low,
        time=low if position.timed else None,
        spread=high - low,
        projected=position.projected,
    )
    time = action.time_left()
    if position.at != "end" or time is None or time <= 0.0:
        return gap
    return Arrive(time, gap=gap, speed=speed_at_end(action))
