"""Speeds as elements."""

from __future__ import annotations

from typing import Literal

from osc2tx.backends.xosc.xml.tree import Element, element


def speed_action(target: float, shape: str, dimension: str, value: float) -> Element:
    """Return a `SpeedAction` to an absolute speed."""
    return longitudinal(
        element(
            "SpeedAction",
            element(
                "SpeedActionDynamics",
                dynamicsShape=shape,
                dynamicsDimension=dimension,
                value=value,
            ),
            element("SpeedActionTarget", element("AbsoluteTargetSpeed", value=target)),
        )
    )


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
    return longitudinal(action)


def hold_speed(entity: str) -> Element:
    """Return the action that ends a change of the speed where it is."""
    return relative_speed(entity, continuous=False)


def longitudinal(action: Element) -> Element:
    """Return the private action around a longitudinal one."""
    return element("PrivateAction", element("LongitudinalAction", action))
