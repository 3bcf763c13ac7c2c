"""Axles of vehicles (§8.7.12)."""

from __future__ import annotations

from typing import NamedTuple

from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.values.constants import Constant, Named
from osc2tx.backends.xosc.xml.tree import Element, element

WHEEL_DIAMETER = 0.6
MAX_STEERING = 0.5
"""Metres and radians of axles that the scenario says nothing about."""


class Axle(NamedTuple):
    """What the XML asks for about an axle, in its units: metres and radians."""

    max_steering: float
    wheel_diameter: float
    track_width: float
    position_x: float
    position_z: float


def axles(ctx: Context, member: CastMember) -> list[Element]:
    """Return the axles, those of the scenario if it has some, from front to rear."""
    shape = member.shape
    track = round(0.9 * shape.width, 3)
    usual = [
        Axle(steering, WHEEL_DIAMETER, track, position, WHEEL_DIAMETER / 2)
        for steering, position in ((MAX_STEERING, shape.wheelbase), (0.0, 0.0))
    ]
    name = member.actor.name
    listed = ctx.values.field(name, ("axles",))
    found = [_as_said(ctx, name, ("axles", str(i)), axle) for i, axle in enumerate(usual)]
    if isinstance(listed, tuple) and listed:
        front, rear = usual
        default = [front, *[rear] * (len(listed) - 1)] if len(listed) > 1 else [rear]
        made = [_axle_of(ctx, each, like) for each, like in zip(listed, default, strict=True)]
        found = sorted(made, key=lambda axle: -axle.position_x)
    if len(found) == 1 and ctx.version < "1.3":  # a front axle cannot be left out yet
        found = [found[0], *found]
    if len(found) == 1:
        return [_axle("RearAxle", found[0])]
    front_most, *others, rear_most = found
    return [
        _axle("FrontAxle", front_most),
        _axle("RearAxle", rear_most),
        *(_axle("AdditionalAxle", axle) for axle in others),
    ]


def _axle_of(ctx: Context, given: Constant, like: Axle) -> Axle:
    """Return an axle of the scenario; what it leaves open is as usual."""
    return _as_said(ctx, given.name if isinstance(given, Named) else "", (), like)


def _as_said(ctx: Context, name: str, path: tuple[str, ...], usual: Axle) -> Axle:
    """Return an axle with what is said of it below a path of an object."""
    said = {part: ctx.values.field(name, (*path, part)) for part in Axle._fields}
    numbers = {part: float(v) for part, v in said.items() if isinstance(v, (int, float))}
    return usual._replace(**numbers)


def _axle(tag: str, axle: Axle) -> Element:
    return element(
        tag,
        maxSteering=axle.max_steering,
        wheelDiameter=axle.wheel_diameter,
        trackWidth=axle.track_width,
        positionX=axle.position_x,
        positionZ=axle.position_z,
    )
