"""The longitudinal command of an action, from its modifiers."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.modifiers import (
    Acceleration,
    AlongTrajectory,
    ChangeSpeed,
    Distance,
    KeepPosition,
    KeepSpeed,
    Position,
    Speed,
)
from osc2tx_runtime.domain.modifiers.base import course_of, now, own_course, value_of
from osc2tx_runtime.domain.placing.pose_resolution import one_of_kind
from osc2tx_runtime.domain.planning.feasibility import check_one_way, check_peak, check_rates
from osc2tx_runtime.domain.planning.motion_action import Refused
from osc2tx_runtime.domain.planning.path_commands import trajectory_commands
from osc2tx_runtime.language.actions.registry import LONGITUDINAL
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
from osc2tx_runtime.world.geometry.function_profiles import Mapped
from osc2tx_runtime.world.longitudinal.execution import (
    excessive_acceleration,
    excessive_rate,
    speed_profile,
    within_limits,
)
from osc2tx_shared.classes import replace

from .goals import (
    lasting_position,
    position_shape,
    speed_at_end,
    speeds_of,
    watched_place,
    way_to_goal,
)
from .position_planning import check_way_to_gap, position_command

if TYPE_CHECKING:
    from osc2tx_runtime.domain.planning.motion_action import ModifiedMotion
    from osc2tx_runtime.world.geometry.profiles import Profile

STANDS = 0.05  # m/s: a slower actor is at standstill


def speed_command(action: ModifiedMotion) -> Command | None:
    """The command for the speed; None if no modifier requires one.

    Raises:
        Refused: It is not possible.
    """
    modifiers = action.lasting
    position = lasting_position(action)
    stays = position is not None and position.stands
    if stays or one_of_kind(modifiers, KeepPosition) is not None:
        return stop_command(action, at_once=stays)
    timed = one_of_kind(modifiers, AlongTrajectory)
    if timed is not None:
        offsets = (value_of(timed.start_offset), value_of(timed.end_offset))
        trajectory = now(timed.trajectory)
        commands = trajectory_commands(
            action.world.map, action.here, trajectory, offsets, exact=action.may_jump
        )
        return commands[LONGITUDINAL]
    placed = position_shape(action)
    if placed is not None:
        return position_command(action, placed)
    counted = one_of_kind(modifiers, Distance) is not None
    if watched_place(action) is not None and not counted:
        return _speed(action)
    if position is not None and position.reference is not None and not counted:
        return _gap(action, position)
    aims = position is not None or (speed_at_end(action) is not None and not _says_how(action))
    is_steady = action.duration is not None and any(m.at == "all" for m in speeds_of(action))
    is_timed = action.duration is not None or action.end_is_known or (counted and aims)
    if is_timed and not (counted and is_steady):
        way = way_to_goal(action)
        if way is not None:
            return _in_time(action, *way)
    change = one_of_kind(modifiers, ChangeSpeed)
    if change is None:
        return _speed(action)
    own, (low, high) = own_course(change.shape), change.difference()
    if own is not None:
        return _computed(action, change, Mapped(own, 1.0, action.here.v))
    target = action.here.v + min(max(0.0, low), high)
    return _checked(action, _to_speed(action, target, change))


def stop_command(action: ModifiedMotion, *, at_once: bool = False) -> Command:
    """The command to remain at the position.

    A moving actor may brake first, unless physics must hold.

    Args:
        action: The action.
        at_once: Whether the position on the road is fixed, so that braking would leave it.

    Raises:
        Refused: It moves, and must not.
    """
    if action.may_jump:
        _assign(action, 0.0)
        return Standstill()
    speed = action.here.v
    if abs(speed) > STANDS and (at_once or action.option() == "must_be_physical"):
        raise Refused(f"it moves at {speed:.2f} m/s, so it cannot keep its position; stop it first")
    return Standstill()


def jump_to(speed: float) -> SpeedChange:
    """The command to set a speed (m/s) instantly and hold it."""
    return SpeedChange(speed, "constant", None, 0.0)


def _says_how(action: ModifiedMotion) -> bool:
    """Whether a speed has a profile, or holds from the start."""
    return any(each.shaped or each.at == "all" for each in speeds_of(action))


def _in_time(action: ModifiedMotion, low: float, high: float) -> Command:
    """The command to cover a distance in the duration, or to stop after it."""
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


def _speed(action: ModifiedMotion) -> Command | None:
    rate = one_of_kind(action.commanding, Acceleration)
    lasting = [m for m in speeds_of(action) if m.at != "start"]
    start = _start_speed(action)
    if not lasting:
        if rate is not None:
            return _acceleration(action, rate, start)
        if start is not None:
            _assign(action, start)
        return None if one_of_kind(action.modifiers, KeepSpeed) is None else jump_to(action.here.v)
    speed = lasting[0]
    other = 0.0
    if speed.reference is not None:
        other = speed.times * action.world.state(speed.reference.id).v
    if speed.reference is not None and not speed.projected:
        if start is not None:
            _assign(action, start)
        return _following(action, speed, speed.reference.id, other)
    own, (low, high) = own_course(speed.shape), speed.difference()
    if own is not None:
        sign = -1.0 if speed.slower_than is not None else 1.0
        return _computed(action, speed, Mapped(own, sign, other))
    low, high = low + other, high + other
    present = action.here.v if start is None else start
    target = min(max(present, low), high)
    if rate is not None and low < high:
        target = _goal_of(action, speed, rate, present, (low, high))
    command = _to_speed(action, target, speed, rate, start)
    return _checked(action, command)


def _following(action: ModifiedMotion, speed: Speed, reference: str, other: float) -> FollowSpeed:
    """The speed of an actor plus a difference, which may have a profile."""
    low, high = speed.difference()
    if not speed.shaped:
        left = action.time_left()
        due = (math.inf if left is None else left) if speed.at == "end" else None
        return FollowSpeed(reference, speed.times, low, high - low, due=due)
    own, sign = own_course(speed.shape), -1.0 if speed.slower_than is not None else 1.0
    here = action.here.v - other
    course: Profile
    if own is not None:
        course = Mapped(own, sign, 0.0)
    else:
        (profile, peak), limits = speed.course, action.limits
        check_peak(peak, "m/s^2")
        in_time = speed.at == "end" and profile != "asap" and peak is None
        least = min(limits.acceleration, limits.deceleration)
        even = replace(limits, acceleration=least, deceleration=least)
        change = SpeedChange(
            min(max(here, low), high), profile, peak, action.time_left() if in_time else None
        )
        course = speed_profile(change, here, even)
    check_one_way(speed, course)
    return FollowSpeed(reference, speed.times, course=course)


def _computed(action: ModifiedMotion, modifier: Speed | ChangeSpeed, course: Mapped) -> SpeedChange:
    """The command for a speed that a shape of the scenario computes."""
    check_one_way(modifier, course)
    if not action.may_jump:
        check_rates(action, course)
    end = 0.0 if math.isinf(course.duration) else course.value(course.duration)
    return SpeedChange(end, course=course, exact=action.may_jump)


def _start_speed(action: ModifiedMotion) -> float | None:
    """The speed to set instantly at the start; None without one."""
    found = [m for m in speeds_of(action) if m.at == "start"]
    if not found or not action.may_jump:
        return None
    low, high = speed_at_start(action, found[0])
    return min(max(action.here.v, low), high)


def speed_at_start(action: ModifiedMotion, speed: Speed) -> tuple[float, float]:
    """Least and greatest speed (m/s) that a modifier allows now."""
    low, high = speed.difference()
    if speed.reference is None:
        return low, high
    other = speed.times * action.world.state(speed.reference.id).v
    return low + other, high + other


def _assign(action: ModifiedMotion, value: float) -> None:
    actor_id, world = action.actor.id, action.world
    action.effect("speed", value, lambda: world.assign(actor_id, speed=value))


def _to_speed(
    action: ModifiedMotion,
    target: float,
    speed: Speed | ChangeSpeed,
    rate: Acceleration | None = None,
    start: float | None = None,
) -> SpeedChange:
    if action.may_jump and start is None:
        if isinstance(speed, Speed) and speed.at == "all" and not speed.shaped:
            _assign(action, target)  # it holds from the first instant
        return jump_to(target)
    if rate is not None:
        return SpeedChange(target, "constant", _pace(action, target, speed, rate), start=start)
    profile, peak = speed.course
    in_time = speed.at == "end" and profile != "asap" and peak is None
    return SpeedChange(target, profile, peak, action.time_left() if in_time else None, start)


def _goal_of(
    action: ModifiedMotion,
    speed: Speed,
    rate: Acceleration,
    present: float,
    bounds: tuple[float, float],
) -> float:
    """The speed (m/s) in a range that an acceleration reaches from the present one."""
    low, high = bounds
    pace = rate.value(action.here.a)
    time = action.time_left() if speed.at == "end" else math.inf
    if time is None or pace == 0.0:
        return min(max(present, low), high)
    return min(max(present + pace * time, low), high)


def _pace(
    action: ModifiedMotion, target: float, speed: Speed | ChangeSpeed, rate: Acceleration
) -> float:
    """The acceleration (m/s^2, unsigned) with which to reach a speed, unless stated."""
    slowest, fastest = sorted(map(abs, rate.bounds()))
    if min(rate.bounds()) < 0.0 < max(rate.bounds()):
        slowest = 0.0
    time = action.time_left() if speed.at == "end" else None
    if not time:
        return slowest or fastest
    return min(max(abs(target - action.here.v) / time, slowest), fastest)


def _checked(action: ModifiedMotion, command: SpeedChange) -> SpeedChange:
    if command.duration == 0.0:
        return command  # it may change instantly
    start = action.here.v if command.start is None else command.start
    limits = action.limits if action.strict else action.tyres
    command = within_limits(command, start, limits)
    reason = excessive_rate(command, start, limits)
    if reason is not None:
        raise Refused(reason)
    return command


def _acceleration(action: ModifiedMotion, rate: Acceleration, start: float | None) -> Command:
    value = rate.value(action.here.a)
    if not action.may_jump:
        _check_acceleration(action, value)
    if start is not None and rate.at == "all" and rate.shape is None:
        return Accelerate(value, start)
    if start is not None:
        _assign(action, start)
    if rate.at == "start":
        return AccelerationChange(0.0, start=value)
    own = own_course(rate.shape)
    if own is not None:
        check_one_way(rate, own)
        return AccelerationChange(value, course=own)
    if rate.shape is not None:
        profile, peak = course_of(rate.shape)
        check_peak(peak, "m/s^3")
        return AccelerationChange(value, profile, peak)
    if rate.at == "all":
        return Accelerate(value)
    return AccelerationChange(value, duration=action.time_left())


def _check_acceleration(action: ModifiedMotion, value: float) -> None:
    limits = action.limits if action.strict else action.tyres
    reason = excessive_acceleration(value, action.here.v, limits)
    if reason is not None:
        raise Refused(reason)


def _gap(action: ModifiedMotion, position: Position) -> Command:
    """The command for a position ahead of or behind another actor."""
    reference = position.reference
    assert reference is not None
    low, high = position.size()
    ahead = position.ahead
    if high <= 0.0 and low < 0.0:  # a negative distance is on the other side
        low, high, ahead = -high, -low, not ahead
    if position.timed and low < 0.0:
        raise Refused("a range of times that is both ahead and behind cannot be kept")
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
    if position.monotonous:
        check_way_to_gap(action, position, time if position.at == "end" else None)
    if position.at != "end" or time is None or time <= 0.0:
        return gap
    return Arrive(time, gap=gap, speed=speed_at_end(action))
