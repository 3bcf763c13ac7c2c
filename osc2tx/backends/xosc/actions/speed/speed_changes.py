"""Changes of the speed as `SpeedAction` or `SpeedProfileAction`.

A course that a `SpeedAction` draws exactly becomes one. Others become a `SpeedProfileAction` (1.2),
which has the limits of acceleration and jerk, or any course through points. Before 1.2 a
`SpeedAction` of the same length stands for it, which is not the same.
"""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx.backends.xosc.actions.leaf import Arguments, Change, Leaf
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
    Profile,
    course_of_speed,
)
from osc2tx.backends.xosc.report import GENERIC, Inexpressible, Remedy
from osc2tx.backends.xosc.state import LONGITUDINAL, ActorState, Demand, Interval, known
from osc2tx.xosc import elements as xml
from osc2tx.xosc.literals import DynamicsShape
from osc2tx_shared.classes import replace

POINTS = 12
"""Points of a smooth course; the way it covers is within 2 cm for changes of 30 m/s."""

RATE = "SpeedActionDynamics/rate"


def may_jump(leaf: Leaf) -> bool:
    """Whether physics need not hold (§8.9.18): as a modifier states, else of a replay."""
    for call in leaf.node.modifiers:
        if call.name == "physical_movement":
            arguments = Arguments(leaf.ctx, call.arguments, call)
            return arguments.member("option", "must_be_physical") == "prefer_non_physical"
    return leaf.node.action.startswith("replay_")


def change_speed(
    leaf: Leaf, target: float, profile: str, peak: float | None, duration: float | None
) -> Change:
    """Return the change of the speed of an actor.

    Args:
        leaf: The invocation.
        target: m/s.
        profile: `none`, `constant`, `smooth` or `asap` (§8.8.2.18).
        peak: Of the acceleration (m/s^2).
        duration: Seconds that it takes.

    Where the speed at the start is not known, the scenario leaves the length of the change open,
    and so does the rate that stands here: it is the one of the embedded world. What need not be
    physical takes no time, whatever its profile.
    """
    if may_jump(leaf):
        return jump_to(leaf, target)
    state = leaf.state
    after = replace(state, speed=known(target)).finished(LONGITUDINAL)
    if state.speed == known(target) and not _is_changing(state):
        return Change(LONGITUDINAL, (), 0.0, after, after)
    passed = None if state.speed is None else state.speed.over(known(target))
    pending = _accelerations(leaf, target, profile, peak)
    during = replace(after, speed=passed, aim=target, rate=None, pending=pending)
    if state.speed is not None and state.speed.is_known:
        start = state.speed.low
        if peak is not None and duration is not None:
            own = course_of_speed(start, target, profile, peak, None, leaf.limits).duration
            refuse_contradiction(leaf, peak, own, duration)
        course = course_of_speed(start, target, profile, peak, duration, leaf.limits)
        leaf.course = course
        lasting = leaf.duration if duration is None else None
        action = _from_known(leaf, course, target, profile, peak, lasting)
        return Change(LONGITUDINAL, (action,), course.duration, during, after)
    if peak is not None:
        slowest, fastest = state.speed or (0.0, TOP_SPEED)
        leaf.demand(peak if slowest < target else 0.0, peak if fastest > target else 0.0)
    elif duration is not None and profile != "asap":
        leaf.demand(*_steepest(leaf, target, duration))
    action = _from_unknown(leaf, target, profile, peak, duration)
    return Change(LONGITUDINAL, (action,), duration, during, after)


def _steepest(leaf: Leaf, target: float, duration: float) -> tuple[float, float]:
    """Return the greatest acceleration and deceleration of a change in a time, from any speed."""
    slowest, fastest = leaf.state.speed or (0.0, TOP_SPEED)
    faster, slower = max(target - slowest, 0.0), max(fastest - target, 0.0)
    return COSINE_PEAK * faster / duration, COSINE_PEAK * slower / duration


def jump_to(leaf: Leaf, target: float) -> Change:
    """Return the change of the speed in no time."""
    after = replace(leaf.state, speed=known(target)).finished(LONGITUDINAL)
    leaf.ctx.demand(leaf.member.name, Demand(jumps=leaf.state.speed != known(target)))
    return Change(LONGITUDINAL, (speed_action(target, "step", "time", 0.0),), 0.0, after, after)


def _is_changing(state: ActorState) -> bool:
    return any(domain == LONGITUDINAL for domain, _ in state.unfinished)


def _from_known(
    leaf: Leaf,
    course: Profile,
    target: float,
    profile: str,
    peak: float | None,
    lasting: float | None,
) -> xml.PrivateAction:
    """Return the change from a speed that is known, whose action may last shorter than it."""
    if isinstance(course, Linear):
        return speed_action(target, "linear", "time", course.duration)
    if isinstance(course, Cosine):
        return speed_action(target, _curve(leaf, profile), "time", course.duration)
    note_acceleration(leaf, target, profile, peak)
    if leaf.ctx.can(PROFILE_ACTION, "1.2"):
        return within_limits(target, leaf.limits, profile, peak)
    length = course.duration if lasting is None else min(lasting, course.duration)
    even = Linear(course.value(0.0), course.value(length), length)
    if leaf.ctx.profile.has_shapes:  # others are reported for all changes
        note_even_change(leaf, [(course, even)], length)
    return speed_action(even.end, "linear", "time", length)


def _accelerations(leaf: Leaf, target: float, profile: str, peak: float | None) -> Interval:
    """Return between which accelerations (m/s^2) a change to a target may be cut short."""
    limits, speed = leaf.limits, leaf.state.speed
    share = 1.0 if profile == "asap" else COMFORT
    up, down = (share * limits.acceleration, share * limits.deceleration)
    if peak is not None:
        up = down = peak
    faster = up if speed is None or speed.low < target else 0.0
    slower = down if speed is None or speed.high > target else 0.0
    return Interval(-slower, faster)


def _from_unknown(
    leaf: Leaf, target: float, profile: str, peak: float | None, duration: float | None
) -> xml.PrivateAction:
    limits = leaf.limits
    if duration is not None and profile != "asap":
        shape: DynamicsShape = "linear" if profile == "constant" else _curve(leaf, profile)
        return speed_action(target, shape, "time", duration)
    if profile in ("none", "asap"):
        note_acceleration(leaf, target, profile, peak)
    if profile in ("none", "asap") and leaf.ctx.can(PROFILE_ACTION, "1.2"):
        return within_limits(target, limits, profile, peak)
    limit = _limit_towards(leaf, target, profile)
    share = {"asap": 1.0, "smooth": COMFORT * GENTLE}.get(profile, COMFORT)
    rate = round(share * limit, 6) if peak is None else peak
    curve: DynamicsShape = "sinusoidal" if profile == "smooth" else "linear"
    if leaf.ctx.can(RATE, "1.0"):
        if profile in ("none", "asap"):
            note_even_change(leaf, _even_courses(leaf, target, profile, peak, rate), None)
        return speed_action(target, curve, "rate", rate)  # which is the peak of the shape
    return speed_action(target, "linear", "time", _longest(leaf, target, profile, rate))


def _even_courses(
    leaf: Leaf, target: float, profile: str, peak: float | None, rate: float
) -> Iterator[tuple[Profile, Linear]]:
    """Yield the courses of a change from the speeds that it may begin with, and the even ones."""
    for speed in leaf.state.speed or (0.0, TOP_SPEED):
        even = Linear(speed, target, abs(target - speed) / rate)
        yield course_of_speed(speed, target, profile, peak, None, leaf.limits), even


def _longest(leaf: Leaf, target: float, profile: str, rate: float) -> float:
    """Return how long (s) a change takes at most, for tools that know no rates (m/s^2).

    Raises:
        Inexpressible: Nothing is known of the speed at its start.
    """
    speed, tool = leaf.state.speed, leaf.ctx.profile.name
    if speed is None:
        raise Inexpressible(
            f"{tool} knows no rates, and nothing is known of the speed", None, GENERIC
        )
    farthest = max(speed.low, speed.high, key=lambda each: abs(target - each))
    duration = course_of_speed(farthest, target, profile, rate, None, leaf.limits).duration
    reason = f"{tool} knows no rates, and the speed at the start is only known in the run"
    bound = f"it takes {duration:.3g} s, as from {farthest:.3g} m/s, the longest that it may take"
    leaf.ctx.report.approximate(leaf.construct, leaf.node.span, reason, bound, GENERIC)
    return duration


def _curve(leaf: Leaf, profile: str) -> DynamicsShape:
    """Return the shape of a smooth change; tools without shapes do as they like if they may."""
    is_free = profile == "none" and not leaf.ctx.profile.has_shapes
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
        leaf.ctx.report.approximate(
            leaf.construct,
            leaf.node.span,
            "whether it has to go faster or slower is only known during the run",
            f"it uses {taken:g} m/s^2 in both directions",
            Remedy(version="1.2"),
        )
    return taken


def within_limits(
    target: float, limits: Limits, profile: str, peak: float | None
) -> xml.PrivateAction:
    """Return the fastest change within limits of acceleration and jerk."""
    share = 1.0 if profile == "asap" else COMFORT
    return longitudinal(
        xml.SpeedProfileAction(
            xml.DynamicConstraints(
                maxAcceleration=share * limits.acceleration if peak is None else peak,
                maxAccelerationRate=limits.jerk,
                maxDeceleration=share * limits.deceleration if peak is None else peak,
                maxDecelerationRate=limits.jerk,
            ),
            xml.SpeedProfileEntry(speed=target),
            followingMode="follow",
        )
    )


def through_points(course: Course, count: int = POINTS) -> xml.PrivateAction:
    """Return a course through points, with times since the point before."""
    step = course.duration / count
    entries = [
        xml.SpeedProfileEntry(
            time=round(step, 9),
            speed=round(course.value(index * step), 9),
        )
        for index in range(1, count + 1)
    ]
    return longitudinal(xml.SpeedProfileAction(*entries, followingMode="position"))
