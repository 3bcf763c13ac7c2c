"""Kinematics of trailers: one axle behind the hitch of the towing vehicle.

Unless the scenario states otherwise, the hitch is at the rear end of the towing vehicle, and the
coupler `DRAWBAR` ahead of the box of the trailer. In a step the hitch moves straight, and the axle
follows on a tractrix; the distance remains exact, and on a circle the trailer approaches the steady
angle sin(angle) = distance / radius.
"""

from __future__ import annotations

import math

from osc2tx_runtime.opendrive import Pose
from osc2tx_runtime.world.actor_dimensions import Shape
from osc2tx_runtime.world.geometry.curve import turn_between
from osc2tx_runtime.world.state import ActorState

JACK_KNIFE = 0.5 * math.pi
"""Largest angle (rad) between a towing vehicle and its trailer."""

DRAWBAR = 0.5
"""Metres from the front of a trailer's box to its coupler."""

_STILL = 1e-12  # m

COUPLING_REACH = 1.0
"""Largest distance (m) between hitch and coupler for coupling."""


def _hitch(tow: ActorState) -> tuple[float, float]:
    back = _back(tow.shape)
    return tow.x - back * math.cos(tow.h), tow.y - back * math.sin(tow.h)


def _back(tow: Shape) -> float:
    """Metres from the reference point back to the hitch."""
    return tow.rear if tow.hitch is None else tow.hitch


def _bar(trailer: Shape) -> float:
    """Metres from the axle to the coupler."""
    return trailer.front + DRAWBAR if trailer.drawbar is None else trailer.drawbar


def coupling_gap(tow: ActorState, trailer: ActorState) -> float:
    """Metres between hitch and coupler."""
    x, y = _hitch(tow)
    bar = _bar(trailer.shape)
    return math.hypot(
        x - trailer.x - bar * math.cos(trailer.h), y - trailer.y - bar * math.sin(trailer.h)
    )


def pose_behind(tow: ActorState, trailer: Shape) -> Pose:
    """Pose of a trailer in line with the towing vehicle."""
    x, y = _hitch(tow)
    bar = _bar(trailer)
    return Pose(x - bar * math.cos(tow.h), y - bar * math.sin(tow.h), tow.z, tow.h)


def _turned(heading: float, dx: float, dy: float, bar: float) -> float:
    """Heading (rad) of a bar whose front end was drawn straight by (dx, dy).

    Its angle to the motion obeys d(angle)/d(distance) = -sin(angle) / bar, so the tangent of half
    of it decays exponentially.
    """
    way = math.hypot(dx, dy)
    if way < _STILL:
        return heading
    course = math.atan2(dy, dx)
    half = 0.5 * turn_between(course, heading)
    angle = 2.0 * math.atan2(math.sin(half) * math.exp(-way / bar), math.cos(half))
    return turn_between(0.0, course + angle)


def drawn(
    trailer: ActorState, tow: ActorState, tow_before: ActorState, dt: float
) -> tuple[Pose, float]:
    """Pose and speed (m/s) of a trailer at the next step.

    Args:
        trailer: Its state at the present step.
        tow: The towing vehicle at the next step.
        tow_before: The towing vehicle at the present step.
        dt: Length of the step (s).
    """
    (x, y), (before_x, before_y) = _hitch(tow), _hitch(tow_before)
    bar = _bar(trailer.shape)
    bar_before = math.atan2(before_y - trailer.y, before_x - trailer.x)
    h = _turned(bar_before, x - before_x, y - before_y, bar)
    turning = turn_between(tow_before.h, tow.h) / dt * _back(tow.shape)
    angle = tow.h - h
    speed = tow.v * math.cos(angle) + turning * math.sin(angle)
    return Pose(x - bar * math.cos(h), y - bar * math.sin(h), trailer.z, h), speed
