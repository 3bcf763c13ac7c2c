"""Changes of the speed as `SpeedAction` or `SpeedProfileAction`.

A course that a `SpeedAction` draws exactly becomes one. Others become a `SpeedProfileAction` (1.2),
which has the limits of acceleration and jerk, or any course through points. Before 1.2 a
`SpeedAction` of the same length stands for it, which is not the same.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from osc2tx.backends.xosc.actions.leaf import Change, Leaf
from osc2tx.backends.xosc.actions.speed.speed_elements import longitudinal, speed_action
from osc2tx.backends.xosc.actions.speed.speed_notes import (
    PROFILE_ACTION,
    note_acceleration,
    note_even_change,
    refuse_contradiction,
)
from osc2tx.backends.xosc.facts.actors import (
    COMFORT,
    COSINE_PEAK,
    GENTLE,
    TOP_SPEED,
    Cosine,
    Course,
    Limits,
    Linear,
    Pace,
    Profile,
    course_of_speed,
)
from osc2tx.backends.xosc.report import GENERIC, Inexpressible, Remedy
from osc2tx.backends.xosc.state import LONGITUDINAL, Demand, Interval, known
from osc2tx.xosc import elements as xml
from osc2tx.xosc.expressions import Symbol
from osc2tx.xosc.literals import DynamicsShape
from osc2tx_shared.classes import replace

POINTS = 12
"""Points of a smooth course; the way it covers is within 2 cm for changes of 30 m/s."""

RATE = "SpeedActionDynamics/rate"

STRAIGHT = 1e-5
"""m/s^2 by which accelerations before and after a point may differ on a straight line."""


def may_jump(leaf: Leaf) -> bool:
    """Whether physics need not hold (§8.9.18): as a modifier states, else of a replay."""
    call = leaf.modifier("physical_movement")
    if call is not None:
        return call.member("option", "must_be_physical") == "prefer_non_physical"
    return leaf.node.action.startswith("replay_")


def change_speed(leaf: Leaf, target: float, pace: Pace) -> Change:
    """Return the change of the speed of an actor to a target (m/s).

    Where the speed at the start is not known, the scenario leaves the length of the change open,
    and so does the rate that stands here: it is the one of the embedded world. What need not be
    physical takes no time, whatever its profile.
    """
    if may_jump(leaf):
        return jump_to(leaf, target)
    state = leaf.state
    after = replace(state, speed=known(target)).finished(LONGITUDINAL)
    if state.speed == known(target) and not state.is_changing_speed:
        return Change(LONGITUDINAL, (), 0.0, after, after)
    passed = None if state.speed is None else state.speed.over(known(target))
    pending = _accelerations(leaf, target, pace)
    during = replace(after, speed=passed, aim=target, rate=None, pending=pending)
    start = state.known_speed
    if start is not None:
        if pace.peak is not None and pace.duration is not None:
            own = course_of_speed(start, target, pace._replace(duration=None), leaf.limits)
            refuse_contradiction(leaf, pace.peak, own.duration, pace.duration)
        course = course_of_speed(start, target, pace, leaf.limits)
        limited = leaf.within_limit(pace, course.duration)
        if limited is not pace:
            pace, course = limited, course_of_speed(start, target, limited, leaf.limits)
        leaf.course = course
        action = _from_known(leaf, course, target, pace)
        return Change(LONGITUDINAL, (action,), course.duration, during, after)
    if pace.peak is not None:
        slowest, fastest = state.speed or (0.0, TOP_SPEED)
        leaf.demand(pace.peak if slowest < target else 0.0, pace.peak if fastest > target else 0.0)
    elif pace.duration is not None and pace.profile != "asap":
        leaf.demand(*_steepest(leaf, target, pace.duration))
    action = _from_unknown(leaf, target, pace)
    return Change(LONGITUDINAL, (action,), pace.duration, during, after)


def _steepest(leaf: Leaf, target: float, duration: float) -> tuple[float, float]:
    """Return the greatest acceleration and deceleration of a change in a time, from any speed."""
    slowest, fastest = leaf.state.speed or (0.0, TOP_SPEED)
    faster, slower = max(target - slowest, 0.0), max(fastest - target, 0.0)
    return COSINE_PEAK * faster / duration, COSINE_PEAK * slower / duration


def jump_to(leaf: Leaf, target: float) -> Change:
    """Return the change of the speed in no time."""
    jumps = leaf.state.speed != known(target)
    after = replace(leaf.state, speed=known(target)).finished(LONGITUDINAL)
    after = replace(after, jumped=jumps)
    leaf.ctx.demand(leaf.member.name, Demand(jumps=jumps))
    return Change(LONGITUDINAL, (speed_action(target, "step", "time", 0.0),), 0.0, after, after)


def _from_known(leaf: Leaf, course: Profile, target: float, pace: Pace) -> xml.PrivateAction:
    """Return the change from a speed that is known, whose action may last shorter than it."""
    if isinstance(course, Linear):
        return speed_action(target, "linear", "time", course.duration)
    if isinstance(course, Cosine):
        return speed_action(target, _curve(leaf, pace), "time", course.duration)
    note_acceleration(leaf, target, pace)
    if leaf.ctx.can(PROFILE_ACTION, "1.2"):
        # A tool that carries on an acceleration takes a jump for one, or that of the step before.
        is_carried = leaf.state.jumped and leaf.ctx.profile.carries_acceleration
        return through_points(course) if is_carried else within_limits(target, leaf.limits, pace)
    length = course.duration
    if pace.duration is None and leaf.duration is not None:
        length = min(leaf.duration, length)
    even = Linear(course.value(0.0), course.value(length), length)
    if leaf.ctx.profile.has_shapes:  # others are reported for all changes
        note_even_change(leaf, [(course, even)], length)
    return speed_action(even.end, "linear", "time", length)


def _accelerations(leaf: Leaf, target: float, pace: Pace) -> Interval:
    """Return between which accelerations (m/s^2) a change to a target may be cut short."""
    limits, speed = leaf.limits, leaf.state.speed
    up, down = _rates(limits, pace)
    faster = up if speed is None or speed.low < target else 0.0
    slower = down if speed is None or speed.high > target else 0.0
    return Interval(-slower, faster)


def _from_unknown(leaf: Leaf, target: float, pace: Pace) -> xml.PrivateAction:
    profile = pace.profile
    if pace.duration is not None and profile != "asap":
        shape: DynamicsShape = "linear" if profile == "constant" else _curve(leaf, pace)
        return speed_action(target, shape, "time", pace.duration)
    if profile in ("none", "asap"):
        note_acceleration(leaf, target, pace)
    if profile in ("none", "asap") and leaf.ctx.can(PROFILE_ACTION, "1.2"):
        return within_limits(target, leaf.limits, pace)
    limit = _limit_towards(leaf, target, profile)
    share = {"asap": 1.0, "smooth": COMFORT * GENTLE}.get(profile, COMFORT)
    rate = round(share * limit, 6) if pace.peak is None else pace.peak
    curve: DynamicsShape = "sinusoidal" if profile == "smooth" else "linear"
    if leaf.ctx.can(RATE, "1.0"):
        if profile in ("none", "asap"):
            note_even_change(leaf, _even_courses(leaf, target, pace, rate), None)
        return speed_action(target, curve, "rate", rate)  # which is the peak of the shape
    return speed_action(target, "linear", "time", _longest(leaf, target, profile, rate))


def _even_courses(
    leaf: Leaf, target: float, pace: Pace, rate: float
) -> Iterator[tuple[Profile, Linear]]:
    """Yield the courses of a change from the speeds that it may begin with, and the even ones."""
    for speed in leaf.state.speed or (0.0, TOP_SPEED):
        even = Linear(speed, target, abs(target - speed) / rate)
        yield course_of_speed(speed, target, pace._replace(duration=None), leaf.limits), even


def _longest(leaf: Leaf, target: float, profile: str, rate: float) -> float:
    """Return how long (s) a change takes at most, for tools that know no rates (m/s^2).

    Raises:
        Inexpressible: Nothing is known of the speed at its start.
    """
    speed, tool = leaf.state.speed, leaf.ctx.profile.name
    if speed is None:
        known_speed = replace(GENERIC, instead="with `speed(…, at: start)` it can be written")
        reason = f"{tool} knows no rates, and nothing is known of the speed"
        raise Inexpressible(reason, None, known_speed)
    farthest = max(speed.low, speed.high, key=lambda each: abs(target - each))
    duration = course_of_speed(farthest, target, Pace(profile, rate), leaf.limits).duration
    reason = f"{tool} knows no rates, and the speed at the start is only known in the run"
    bound = f"it takes {duration:.3g} s, as from {farthest:.3g} m/s, the longest that it may take"
    leaf.approximate(reason, bound, GENERIC)
    return duration


def _curve(leaf: Leaf, pace: Pace) -> DynamicsShape:
    """Return the shape of a smooth change; tools without shapes do as they like if they may."""
    is_free = pace.profile == "none" and not leaf.ctx.profile.has_shapes
    return "linear" if is_free else "sinusoidal"


def _limit_towards(leaf: Leaf, target: float, profile: str) -> float:
    """Return the limit of the acceleration on the way to a target.

    If only the run shows whether it has to go faster or slower, it is taken for granted that the
    change before has come to its end; where there is none, the smaller limit holds.
    """
    limits, speed, aim = leaf.limits, leaf.state.speed, leaf.state.aim
    if speed is not None and target >= speed.high:
        return limits.acceleration
    if target <= 0.0 or (speed is not None and target <= speed.low):
        return limits.deceleration
    taken = min(limits.acceleration, limits.deceleration)
    if speed is not None and aim is not None and aim != target and speed.low <= aim <= speed.high:
        taken = limits.acceleration if target > aim else limits.deceleration
    if profile == "asap" and limits.acceleration != limits.deceleration:
        leaf.approximate(
            "whether it has to go faster or slower is only known during the run",
            f"it uses {taken:g} m/s^2 in both directions",
            Remedy(version="1.2"),
        )
    return taken


def _rates(limits: Limits, pace: Pace) -> tuple[float, float]:
    """Return acceleration and deceleration (m/s^2) of a change within limits."""
    if pace.peak is not None:
        return pace.peak, pace.peak
    share = 1.0 if pace.profile == "asap" else COMFORT
    return share * limits.acceleration, share * limits.deceleration


def within_limits(target: float, limits: Limits, pace: Pace) -> xml.PrivateAction:
    """Return the fastest change within limits of acceleration and jerk."""
    faster, slower = _rates(limits, pace)
    constraints = xml.DynamicConstraints(
        maxAcceleration=faster,
        maxAccelerationRate=limits.jerk,
        maxDeceleration=slower,
        maxDecelerationRate=limits.jerk,
    )
    entry = xml.SpeedProfileEntry(speed=target)
    return longitudinal(xml.SpeedProfileAction(constraints, entry, followingMode="follow"))


def through_points(course: Course, count: int = POINTS) -> xml.PrivateAction:
    """Return a course through points, with times since the point before.

    Points on the straight line between others are left out: esmini does so too, and then waits for
    as many as there are entries.
    """
    step = course.duration / count
    speeds = [course.value(index * step) for index in range(count + 1)]
    entries, last = [], 0
    for index in range(1, count + 1):
        if index < count and _is_straight(speeds[index - 1 : index + 2], step):
            continue
        time, speed = round((index - last) * step, 9), round(speeds[index], 9)
        entries.append(xml.SpeedProfileEntry(time=time, speed=speed))
        last = index
    return longitudinal(xml.SpeedProfileAction(*entries, followingMode="position"))


def _is_straight(speeds: Sequence[float], step: float) -> bool:
    """Whether three speeds, a step (s) apart, lie on a line for all values of open parameters."""
    before, here, after = speeds
    if any(isinstance(speed, Symbol) for speed in speeds):
        return False
    return abs(before - 2.0 * here + after) < STRAIGHT * step
