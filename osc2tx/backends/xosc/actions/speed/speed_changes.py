"""Changes of the speed as `SpeedAction` or `SpeedProfileAction`.

A course that a `SpeedAction` draws exactly becomes one. Others become a `SpeedProfileAction` (1.2),
which has the limits of acceleration and jerk, or any course through points. Before 1.2 a
`SpeedAction` of the same length stands for it, which is not the same.
"""

from __future__ import annotations

from functools import partial

from osc2tx.backends.xosc.actions.leaf import Change, Leaf
from osc2tx.backends.xosc.actions.speed.courses import (
    PROFILE_ACTION,
    longitudinal,
    note_even,
    speed_action,
    through_points,
)
from osc2tx.backends.xosc.facts.actors import (
    COMFORT,
    COSINE_PEAK,
    GENTLE,
    TOP_SPEED,
    Cosine,
    Limits,
    Linear,
    Pace,
    Profile,
    course_of_speed,
)
from osc2tx.backends.xosc.state import LONGITUDINAL, Demand, known
from osc2tx.losses.entries import GENERIC, Inexpressible, Remedy
from osc2tx.xosc import elements as xml
from osc2tx.xosc.literals import DynamicsShape
from osc2tx_shared.classes import replace
from osc2tx_shared.steps import DEFAULT_STEP

RATE = "SpeedActionDynamics/rate"


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
    during = replace(after, speed=passed, aim=target, rate=None)
    start = state.known_speed
    if start is not None:
        planned = partial(course_of_speed, start, target, limits=leaf.limits)
        if pace.peak is not None and pace.duration is not None:
            own = planned(pace._replace(duration=None)).duration
            if abs(own - pace.duration) > DEFAULT_STEP:
                raise Inexpressible(
                    f"with rate_peak {pace.peak:g} m/s^2 it takes {own:.2f} s, not"
                    f" {pace.duration:g} s: every run fails"
                )
        pace, course = leaf.within_limit(pace, planned)
        leaf.course = course
        action = _from_known(leaf, course, target, pace)
        return Change(LONGITUDINAL, (action,), course.duration, during, after)
    if pace.peak is not None:
        slowest, fastest = state.speed or (0.0, TOP_SPEED)
        leaf.demand(pace.peak if slowest < target else 0.0, pace.peak if fastest > target else 0.0)
    elif pace.duration is not None and pace.profile != "asap":
        slowest, fastest = leaf.state.speed or (0.0, TOP_SPEED)  # any of which it may start with
        ways = max(target - slowest, 0.0), max(fastest - target, 0.0)
        leaf.demand(*(COSINE_PEAK * way / pace.duration for way in ways))
    action = _from_unknown(leaf, target, pace)
    return Change(LONGITUDINAL, (action,), pace.duration, during, after)


def jump_to(leaf: Leaf, target: float) -> Change:
    """Return the change of the speed in no time."""
    jumps = leaf.state.speed != known(target)
    after = replace(leaf.state, speed=known(target)).finished(LONGITUDINAL)
    after = replace(after, jumped=jumps)
    leaf.ctx.demand(leaf.member.name, Demand(jumps=jumps))
    return Change(LONGITUDINAL, (speed_action(target),), 0.0, after, after)


def _from_known(leaf: Leaf, course: Profile, target: float, pace: Pace) -> xml.PrivateAction:
    """Return the change from a speed that is known, whose action may last shorter than it."""
    if isinstance(course, Linear):
        return speed_action(target, "linear", "time", course.duration)
    if isinstance(course, Cosine):
        return speed_action(target, _curve(leaf, pace), "time", course.duration)
    _note_acceleration(leaf)
    if leaf.ctx.can(PROFILE_ACTION, "1.2"):
        # A tool that carries on an acceleration takes a jump for one, or that of the step before.
        is_carried = leaf.state.jumped and leaf.ctx.profile.carries_acceleration
        return through_points(course) if is_carried else within_limits(target, leaf.limits, pace)
    length = course.duration
    if pace.duration is None and leaf.duration is not None:
        length = min(leaf.duration, length)
    even = Linear(course.value(0.0), course.value(length), length)
    if leaf.ctx.profile.has_shapes:  # others are reported for all changes
        note_even(leaf, leaf.arguments, _jerky(leaf))
    return speed_action(even.end, "linear", "time", length)


def _from_unknown(leaf: Leaf, target: float, pace: Pace) -> xml.PrivateAction:
    profile = pace.profile
    if pace.duration is not None and profile != "asap":
        shape: DynamicsShape = "linear" if profile == "constant" else _curve(leaf, pace)
        return speed_action(target, shape, "time", pace.duration)
    if profile in ("none", "asap"):
        _note_acceleration(leaf)
    if profile in ("none", "asap") and leaf.ctx.can(PROFILE_ACTION, "1.2"):
        return within_limits(target, leaf.limits, pace)
    limit = _limit_towards(leaf, target, profile)
    share = {"asap": 1.0, "smooth": COMFORT * GENTLE}.get(profile, COMFORT)
    rate = round(share * limit, 6) if pace.peak is None else pace.peak
    curve: DynamicsShape = "sinusoidal" if profile == "smooth" else "linear"
    if leaf.ctx.can(RATE, "1.0"):
        if profile in ("none", "asap"):
            note_even(leaf, leaf.arguments, _jerky(leaf))
        return speed_action(target, curve, "rate", rate)  # which is the peak of the shape
    return speed_action(target, "linear", "time", _longest(leaf, target, profile, rate))


def _longest(leaf: Leaf, target: float, profile: str, rate: float) -> float:
    """Return how long (s) a change takes at most, for tools that know no rates (m/s^2)."""
    speed, tool = leaf.state.speed, leaf.ctx.profile.name
    if speed is None:
        known_speed = replace(GENERIC, instead="with `speed(…, at: start)` it can be written")
        reason = f"{tool} knows no rates, and nothing is known of the speed"
        raise Inexpressible(reason, None, known_speed)
    farthest = max(speed.low, speed.high, key=lambda each: abs(target - each))
    duration = course_of_speed(farthest, target, Pace(profile, rate), leaf.limits).duration
    reason = f"{tool} knows no rates, and the speed at the start is only known in the run"
    bound = f"it takes {duration:.3g} s, as from {farthest:.3g} m/s, the longest that it may take"
    leaf.arguments.approximate(reason, bound, GENERIC)
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
        leaf.arguments.doubt(
            "whether it has to go faster or slower is only known during the run, so it changes at"
            f" {taken:g} m/s^2 in both directions",
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


# --- reports ------------------------------------------------------------------------------------


def _note_acceleration(leaf: Leaf) -> None:
    """Report that a change takes over an acceleration: that of the XML begins without any."""
    rate, has_profiles = leaf.state.rate, leaf.ctx.can(PROFILE_ACTION, "1.2")
    if rate == 0.0:
        return
    if rate is None and has_profiles and leaf.ctx.profile.carries_acceleration:
        return  # it takes over that of a change that is interrupted, not of one that is over
    leaf.arguments.doubt(
        "it takes over the acceleration of the change before; one of the XML begins without any",
        Remedy(version=None if has_profiles else "1.2", profile="esmini"),
    )


def _jerky(leaf: Leaf) -> str:
    version = leaf.ctx.version
    return f"OpenSCENARIO XML {version} has no limits of the jerk: the speed changes evenly"
