"""Speeds relative to that of an actor, as elements."""

from __future__ import annotations

from typing import Literal

from osc2tx.backends.xosc.xml.tree import Element, element


def relative_speed(
    reference: str,
    value: float = 0.0,
    kind: Literal["delta", "factor"] = "delta",
    *,
    continuous: bool,
    shape: str = "step",
    dimension: str = "time",
    length: float = 0.0,
) -> Element:
    """Return the action that gives an actor a speed relative to that of another one.

    Args:
        reference: Whose speed counts.
        value: By which it is faster (m/s), or a factor.
        kind: Which of both it is.
        continuous: It has this speed at every moment from then on.
        shape: Of the change to it.
        dimension: Of the length of that change.
        length: That length: seconds, or m/s^2 for a rate.
    """
    goal = element(
        "RelativeTargetSpeed",
        entityRef=reference,
        value=value,
        speedTargetValueType=kind,
        continuous=continuous,
    )
    action = element(
        "SpeedAction",
        element(
            "SpeedActionDynamics",
            dynamicsShape=shape,
            dynamicsDimension=dimension,
            value=length,
        ),
        element("SpeedActionTarget", goal),
    )
    return element("PrivateAction", element("LongitudinalAction", action))
