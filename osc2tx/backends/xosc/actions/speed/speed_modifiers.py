"""Modifiers of speed and path (§8.9.4 to §8.9.6, §8.9.13, §8.9.18)."""

from __future__ import annotations

from math import inf

from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.actions.leaf import UNKNOWN_SPEED, Change, Changes, Leaf
from osc2tx.backends.xosc.actions.registry import modifier, require_at_start
from osc2tx.backends.xosc.actions.speed.acceleration import speed_by, user_shape
from osc2tx.backends.xosc.actions.speed.courses import (
    SAME,
    follow_course,
    speed_action,
    speed_of,
)
from osc2tx.backends.xosc.actions.speed.speed_changes import change_speed, jump_to, may_jump
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.facts.actors import COMFORT, FASTEST, Course, Linear, Pace
from osc2tx.backends.xosc.state import LONGITUDINAL, Demand, known
from osc2tx.backends.xosc.values.constants import Bounds
from osc2tx.losses.entries import GENERIC, Inexpressible, Remedy
from osc2tx.xosc.literals import DynamicsDimension, DynamicsShape

RELATIVE = {"faster_than": 1.0, "slower_than": -1.0, "same_as": 1.0}
"""Argument that names a reference -> sign of the difference to its speed."""


ABSOLUTE = Remedy(instead="`speed` with the speed itself is exact", asks=("SpeedActionDynamics",))


@modifier("physical_movement")
def _physical(leaf: Leaf, call: Arguments) -> Changes:
    call.member("option", "must_be_physical")
    return ()  # steps are written for changes that may jump, courses for all others


@modifier("avoid_collisions", takes=())
def _avoid(leaf: Leaf, call: Arguments) -> Changes:
    if call.get("avoid") is not False:
        call.doubt(
            "the XML cannot ask for caution: nobody brakes for others, red lights or bends",
            Remedy(
                instead="`change_speed` at a condition says when it brakes, and how, exactly",
                asks=("SpeedActionDynamics",),
            ),
            note="the XML cannot ask for caution; the runs that were compared did not need any",
        )
    return ()


@modifier("keep_speed", "keep_lane", takes=())
def _keep(leaf: Leaf, call: Arguments) -> Changes:
    return ()


@modifier("keep_position", takes=(LONGITUDINAL,))
def _keep_position(leaf: Leaf, call: Arguments) -> Changes:
    if leaf.state.speed == known(0.0):
        return ()
    return (change_speed(leaf, 0.0, FASTEST),)


@modifier("speed")
def _speed(leaf: Leaf, call: Arguments) -> Changes:
    if call.member("direction", "longitudinal") != "longitudinal":
        instead = "`change_lane` or `lateral(…)` with a duration moves across the road exactly"
        remedy = Remedy(instead=instead, asks=("LaneChangeActionDynamics",))
        raise Inexpressible("there is no action on a speed across the road", remedy=remedy)
    own = user_shape(call)
    if own is not None and call.at == "all":
        return (speed_by(leaf, own),)
    pace, target = call.shape()
    if "rate_profile" in call or "rate_peak" in call:
        pace = call.pace()
    given = call.number("speed")
    target = given if given is not None else target
    allowed = call.get("speed_range")
    if isinstance(allowed, Bounds):
        if any(other.name == "acceleration" for other in leaf.node.modifiers):
            raise Inexpressible("the XML has no acceleration within a range of speeds")
        speed = leaf.state.known_speed
        target = 0.5 * (allowed.lower + allowed.upper)  # if the nearest one is not known
        if speed is not None:
            target = min(max(speed, allowed.lower), allowed.upper)
    reference = next((name for name in RELATIVE if name in call), None)
    place = leaf.modifier("position")
    if call.at == "end" and place is not None and place.at == "end":
        if reference is not None:
            raise Inexpressible("a speed relative to another one, at the end of the way to a place")
        return ()  # the way there ends with it
    if reference is not None:
        return (_relative(leaf, call, reference, target or 0.0),)
    if target is None:
        raise Inexpressible("no speed is stated")
    if call.at == "start" and not may_jump(leaf):
        return _holds(leaf, call, target)
    rate = _rate_beside(leaf)
    if rate is not None:
        pace = Pace("constant", rate)
    return (change_speed(leaf, target, leaf.in_time(call, pace)),)


def _holds(leaf: Leaf, call: Arguments, target: float) -> Changes:
    """Check a speed that has to be there already."""
    speed = leaf.state.speed
    if speed is None:
        require_at_start(leaf, call)
    elif not speed.low - 1e-6 <= target <= speed.high + 1e-6:
        raise Inexpressible("the speed at the start is another one, and must not jump")
    return ()


def _rate_beside(leaf: Leaf) -> float | None:
    """Return the acceleration (m/s^2) that another modifier gives the change of the speed."""
    call = leaf.modifier("acceleration")
    if call is None:
        return None
    if "acceleration_range" in call:
        reason = "how fast a speed is reached within a range of accelerations"
        raise Inexpressible(f"{reason} is not known before the run", call.span)
    rate = call.number("acceleration")
    return None if rate is None else abs(rate)


def _relative(leaf: Leaf, call: Arguments, name: str, difference: float) -> Change:
    """Return the change to a speed relative to that of another actor."""
    reference, factor = call.required_entity(name), call.number("factor")
    difference *= RELATIVE[name]
    if factor not in (None, 1.0) and difference != 0.0:
        raise Inexpressible("a factor and a difference at once")
    if factor == 1.0:
        factor = None
    leaf.follow(reference, rigid=False)
    shape: DynamicsShape = "linear"
    dimension: DynamicsDimension = "rate"
    length = _rate_towards(leaf, call, reference, factor, difference)
    if any(name in call for name in ("shape", "rate_profile", "rate_peak")):
        reason = (
            "the difference to the speed of another actor has a course of its own in the world, and"
            " a rate in the XML"
        )
        call.doubt(reason, ABSOLUTE)
    if "SpeedActionDynamics/rate" in leaf.ctx.profile.unsupported:
        shape, dimension, length = "step", "time", 0.0
        at_once = f"{leaf.ctx.profile.name} takes up such a speed at once"
        call.doubt(at_once, GENERIC)
    goal = speed_of(reference.name, difference)
    if factor is not None:
        goal = speed_of(reference.name, factor, "factor")
    return leaf.at_open_speed(speed_action(goal, shape, dimension, length), inf)


def _rate_towards(
    leaf: Leaf, call: Arguments, reference: CastMember, factor: float | None, more: float
) -> float:
    """Return the rate (m/s^2) of the way to a speed relative to another one.

    The world speeds up and brakes at different rates, the XML has one. That is exact where it is
    the one of the world whenever the other actor is faster than that.
    """
    limits, mine = leaf.limits, leaf.state.known_speed
    faster, slower = COMFORT * limits.acceleration, COMFORT * limits.deceleration
    theirs = leaf.state_of(reference).known_speed
    if mine is not None and theirs is not None:
        missing = (theirs * factor if factor is not None else theirs + more) - mine
        demand, share = leaf.ctx.demand_on(reference.name), 1.0 if factor is None else abs(factor)
        rises, falls = (
            inf if demand.jumps else share * rate
            for rate in (demand.acceleration, demand.deceleration)
        )
        if not demand.jumps:
            leaf.ctx.demand(leaf.member.name, Demand(share * demand.speed + abs(more)))
        for rate in (max(faster, slower), faster, slower):
            is_up = rate == faster or (missing <= SAME and rises <= min(rate, faster))
            is_down = rate == slower or (missing >= -SAME and falls <= min(rate, slower))
            if is_up and is_down:
                return rate
    call.doubt(
        f"how fast {leaf.member.name} takes up a speed relative to one that changes is one rate in"
        " the XML, and another one for braking in the world",
        ABSOLUTE,
    )
    return min(faster, slower)


@modifier("change_speed")
def _change_speed(leaf: Leaf, call: Arguments) -> Changes:
    pace, target = call.shape()
    given = call.number("speed")
    difference = given if given is not None else target
    allowed = call.get("speed_range")
    if isinstance(allowed, Bounds):
        difference = min(max(0.0, allowed.lower), allowed.upper)
    if difference is None:
        raise Inexpressible("no difference is stated")
    speed = leaf.state.known_speed
    if speed is None:
        again = "tools read a speed relative to itself again and again"
        raise Inexpressible(f"{UNKNOWN_SPEED}, and {again}")
    goal = speed + difference
    if may_jump(leaf):
        return (jump_to(leaf, goal),)
    return (change_speed(leaf, goal, leaf.in_time(call, pace)),)


# --- distances ----------------------------------------------------------------------------------


@modifier("distance", takes=())
def _distance(leaf: Leaf, call: Arguments) -> Changes:
    distance = call.required("distance")
    if leaf.duration is not None:
        return (cover_in_time(leaf, call, distance, leaf.duration),)
    check_end_is_free(leaf, call)
    leaf.distance = distance
    return ()


def cover_in_time(leaf: Leaf, call: Arguments, distance: float, time: float) -> Change:
    """Return the even change of the speed that covers a distance (m) in a time (s).

    Raises:
        Inexpressible: Something else decides how it gets there.
    """
    check_end_is_free(leaf, call)
    start = leaf.state.known_speed
    if start is None:
        raise Inexpressible(UNKNOWN_SPEED)
    end = 2.0 * distance / time - start
    if end < 0.0:
        raise Inexpressible("it would stop before its time is over")
    return follow_course(
        leaf, Linear(start, end, time), rate=(end - start) / time if end > 0.0 else 0.0
    )


ASIDE = ("lane", "lateral", "change_lane")
"""Modifiers of the place across the road, which do not decide how an actor gets along it."""


def check_end_is_free(leaf: Leaf, call: Arguments, *free: str) -> None:
    """Require that nothing but a modifier, and free ones, holds at the end of an invocation.

    In a given time, where it is across the road does not count.
    """
    ends = [m.name for m in leaf.node.modifiers if m is not call.source and m.at == "end"]
    allowed = free if leaf.duration is None else (*free, *ASIDE)
    if any(name not in allowed for name in ends):
        reason = f"what has to hold at the end of its {call.name} decides how it gets there"
        raise Inexpressible(reason)


def time_to_cover(leaf: Leaf) -> float | None:
    """Return after how many seconds an invocation has covered its distance; `None` without one."""
    if leaf.distance is None:
        return None
    if leaf.course is not None:
        time = _time_along(leaf.course, leaf.distance)
    else:
        reason = "how long it takes depends on a speed that is only known during the run"
        speed = leaf.known_speed(reason)
        time = leaf.distance / speed if speed > 0.0 else inf
    if time == inf:
        raise Inexpressible("it comes to a stand before")
    return round(time, 9)


STEPS = 2000
"""Pieces of a course in which its way is summed up."""


def _time_along(course: Course, way: float) -> float:
    """Return the time (s) at which a course has covered a way (m)."""
    step = course.duration / STEPS
    covered = 0.0
    for index in range(STEPS if step > 0.0 else 0):
        left, right = course.value(index * step), course.value((index + 1) * step)
        piece = 0.5 * step * (left + right)
        if covered + piece >= way:
            return (index + (way - covered) / piece) * step
        covered += piece
    end = course.value(course.duration)
    return course.duration + (way - covered) / end if end > 0.0 else inf
