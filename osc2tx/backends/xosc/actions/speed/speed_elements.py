"""Speeds as elements."""

from __future__ import annotations

from math import ceil
from typing import Literal

from osc2tx.backends.xosc.actions.leaf import Change, Leaf, Performance
from osc2tx.backends.xosc.report import GENERIC
from osc2tx.backends.xosc.state import LONGITUDINAL
from osc2tx.xosc import elements as xml
from osc2tx.xosc.expressions import Symbol
from osc2tx.xosc.literals import DynamicsDimension, DynamicsShape


def speed_action(
    target: float | xml.RelativeTargetSpeed,
    shape: DynamicsShape = "step",
    dimension: DynamicsDimension = "time",
    value: float = 0.0,
) -> xml.PrivateAction:
    """Return a `SpeedAction` to a speed; the change to it lasts so long, or has such a rate."""
    goal: xml.SpeedActionTargetPart = (
        target
        if isinstance(target, xml.RelativeTargetSpeed)
        else xml.AbsoluteTargetSpeed(value=target)
    )
    dynamics = xml.SpeedActionDynamics(
        dynamicsShape=shape, dynamicsDimension=dimension, value=value
    )
    return longitudinal(xml.SpeedAction(dynamics, xml.SpeedActionTarget(goal)))


def speed_of(
    reference: str,
    value: float = 0.0,
    kind: Literal["delta", "factor"] = "delta",
    *,
    continuous: bool = True,
) -> xml.RelativeTargetSpeed:
    """Return the speed of another actor, plus a value (m/s) or times a factor.

    If it is continuous, it is so at every moment from then on.
    """
    return xml.RelativeTargetSpeed(
        entityRef=reference, value=value, speedTargetValueType=kind, continuous=continuous
    )


def hold_speed(entity: str) -> xml.PrivateAction:
    """Return the action that ends a change of the speed where it is."""
    return speed_action(speed_of(entity, continuous=False))


def ends_evenly(change: Change) -> bool:
    """Whether a change of the speed keeps its acceleration up to its end."""
    dynamics = (each for action in change.actions for each in action.below(xml.SpeedActionDynamics))
    return any(each.dynamicsShape == "linear" for each in dynamics)


def longitudinal(action: xml.LongitudinalActionPart) -> xml.PrivateAction:
    """Return the private action around a longitudinal one."""
    return xml.PrivateAction(xml.LongitudinalAction(action))


RISE = 1.0
"""m/s from one step to the next."""

MOST = 20
"""Steps of one change."""

TICK = 0.05
"""Seconds between two looks of such a tool: an action is over half of that late, on average."""


def in_steps(leaf: Leaf, performance: Performance) -> tuple[xml.ActionPart, ...]:
    """Return actions that change a speed one after the other; none where one action does it.

    That is for what nothing cuts short: the steps would go on.
    """
    course = leaf.course
    if not leaf.ctx.profile.takes_speeds_at_once or course is None:
        return ()
    if [change.domain for change in performance.changes if change.actions] != [LONGITUDINAL]:
        return ()
    start, end = course.value(0.0), course.value(course.duration)
    if isinstance(start, Symbol) or isinstance(end, Symbol):  # another value has other steps
        return ()
    count = min(ceil(abs(end - start) / RISE), MOST)
    length = course.duration / max(count, 1)
    if count < 2 or length <= 2.0 * TICK:
        return ()
    leaf.approximate(
        f"{leaf.ctx.profile.name} takes up a speed at once, so it changes in {count} steps",
        "off by the way that each of them takes, more where throttle and brakes are not enough",
        GENERIC,
    )
    middles = [round(course.value((step + 0.5) * length), 6) for step in range(count)]
    lasting = round(length - 0.5 * TICK, 6)
    steps = (speed_action(speed, "linear", "time", lasting) for speed in middles)
    return (*steps, speed_action(end))
