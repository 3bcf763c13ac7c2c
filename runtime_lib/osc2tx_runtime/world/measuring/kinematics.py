"""Velocity and acceleration in the axes of the actor (DSL 8.7.5), from its last three states.

The state has the speed `v` on the ground and its change `a`. The direction in the own axes follows
from the last step, relative to the attitude at its middle; on a circle this is exactly forwards.
The climb follows from the slope of the surface: heights of maps have steps of fractions of a
millimetre, which short time steps would amplify. Turning is the change of attitude over the last
step. The acceleration is the change in the moving axes plus the effect of their turning: a = du/dt
+ w x u.

Teleports are not motion: their steps are not evaluated.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple, Protocol

from osc2tx_runtime.opendrive.model import new_tuple
from osc2tx_runtime.world.geometry.curve import turn_between
from osc2tx_runtime.world.state import ActorState

from .measured import Measured
from .velocities import (
    Acceleration,
    OrientationAcceleration,
    OrientationRate,
    TranslationalAcceleration,
    TranslationalVelocity,
    Velocity,
)

_STILL = 1e-9  # m
_STRAIGHT = 1e-3  # rad from its axis within which an actor moves along it

Vector = tuple[float, float, float]


class Motion(Protocol):
    """Motion of an actor at one instant, in its own axes."""

    @property
    def velocity(self) -> Velocity:
        """Velocity (m/s) and turning (rad/s)."""

    @property
    def acceleration(self) -> Acceleration:
        """Acceleration (m/s^2) and change of turning (rad/s^2)."""


class _Step(NamedTuple):
    """The states before a step, by the ids of the actors, and the teleported ones."""

    ids: Sequence[str]
    states: Sequence[ActorState]
    jumped: frozenset[str]


class Track:
    """The last two steps of all actors."""

    def __init__(self) -> None:
        self._last: _Step | None = None
        self._before: _Step | None = None  # the step before that

    def add(self, ids: Sequence[str], before: Sequence[ActorState], jumped: frozenset[str]) -> None:
        """Note a step.

        Args:
            ids: The actors.
            before: Their states before it.
            jumped: The teleported actors.
        """
        self._before, self._last = self._last, new_tuple(_Step, (ids, before, jumped))

    def interrupt(self, actor: str) -> None:
        """Note that an actor was teleported, or turned, at the present step."""
        if self._last is not None:
            self._last = self._last._replace(jumped=self._last.jumped | {actor})

    def of(self, actor: str, now: ActorState, dt: float, *, lies: bool = False) -> Kinematics:
        """Return the motion of an actor.

        Args:
            actor: Its id.
            now: Its present state.
            dt: Length of a step (s).
            lies: Whether its pitch and roll follow the surface.
        """
        states = [now]
        for step in (self._last, self._before):
            if step is None or actor in step.jumped or actor not in step.ids:
                break
            states.append(step.states[step.ids.index(actor)])
        return Kinematics(states, dt, lies=lies)


class Kinematics:
    """Motion of an actor at one instant.

    Args:
        states: The present state, and up to two before it that are connected by motion.
        dt: Length of a step (s).
        lies: Whether its pitch and roll follow the surface.
    """

    def __init__(self, states: list[ActorState], dt: float, *, lies: bool = False) -> None:
        self._now = states[0]
        self._dt = dt
        steps = list(pairwise(states))
        self._rates = [_rates(before, after, dt) for after, before in steps]
        self._ways = [_direction(before, after, lies=lies) for after, before in steps]

    @property
    def velocity(self) -> Velocity:
        """Velocity (m/s) and turning (rad/s)."""
        way, v = self._way, self._now.v
        return Velocity(
            TranslationalVelocity(*(Measured(v * part) for part in way)),
            OrientationRate(*map(Measured, self._turning)),
        )

    @property
    def acceleration(self) -> Acceleration:
        """Acceleration (m/s^2) and change of turning (rad/s^2)."""
        way, v, a, dt = self._way, self._now.v, self._now.a, self._dt
        before = self._ways[1] if len(self._ways) > 1 else way
        p, q, r = self._turning
        x, y, z = (v * part for part in way)
        turned = (q * z - r * y, r * x - p * z, p * y - q * x)
        own = (
            a * now + v * (now - then) / dt + by_turning
            for now, then, by_turning in zip(way, before, turned, strict=True)
        )
        faster: Vector = (0.0, 0.0, 0.0)
        if len(self._rates) > 1:
            faster = _per(self._rates[1], self._rates[0], dt)
        return Acceleration(
            TranslationalAcceleration(*map(Measured, own)),
            OrientationAcceleration(*map(Measured, faster)),
        )

    @property
    def _turning(self) -> Vector:
        return self._rates[0] if self._rates else (0.0, 0.0, 0.0)

    @property
    def _way(self) -> Vector:
        """Direction of motion in its own axes, per metre forwards on the ground."""
        return self._ways[0] if self._ways else _forwards(self._now)


def _forwards(state: ActorState) -> Vector:
    return (1.0 / math.cos(state.pitch), 0.0, 0.0)


def _direction(before: ActorState, after: ActorState, *, lies: bool) -> Vector:
    """Displacement of a step in the own axes at its middle, per metre forwards on the ground."""
    dx, dy, dz = after.x - before.x, after.y - before.y, after.z - before.z
    ground = math.hypot(dx, dy)
    if ground < _STILL:
        return _forwards(after)
    turn = turn_between(before.h, after.h)
    aside = turn_between(before.h + 0.5 * turn, math.atan2(dy, dx))
    backwards = after.v < 0.0 or (after.v == 0.0 and abs(aside) > 0.5 * math.pi)
    if backwards:
        aside = turn_between(math.pi, aside)
    if abs(aside) <= 0.5 * abs(turn) + _STRAIGHT:
        aside = 0.0  # an actor that turns and then moves still moves forwards
    sign = -1.0 if backwards else 1.0
    roll, pitch = 0.5 * (before.roll + after.roll), 0.5 * (before.pitch + after.pitch)
    forwards, left, up = math.cos(aside), math.sin(aside), sign * dz / ground
    if lies:
        up = left * math.tan(roll) / math.cos(pitch) - forwards * math.tan(pitch)
    # From level axes to the axes of the actor: by its pitch, then by its roll.
    x = forwards * math.cos(pitch) - up * math.sin(pitch)
    nod = forwards * math.sin(pitch) + up * math.cos(pitch)
    y = left * math.cos(roll) + nod * math.sin(roll)
    z = nod * math.cos(roll) - left * math.sin(roll)
    return x, y, z


def _rates(before: ActorState, after: ActorState, dt: float) -> Vector:
    """Rates about the own axes (rad/s) over a step, from the changes of yaw, pitch, roll."""
    yaw = turn_between(before.h, after.h) / dt
    pitch, roll = (after.pitch - before.pitch) / dt, (after.roll - before.roll) / dt
    if not (pitch or roll or after.pitch or after.roll):
        return 0.0, 0.0, yaw
    tilt, lean = 0.5 * (before.pitch + after.pitch), 0.5 * (before.roll + after.roll)
    return (
        roll - yaw * math.sin(tilt),
        pitch * math.cos(lean) + yaw * math.cos(tilt) * math.sin(lean),
        yaw * math.cos(tilt) * math.cos(lean) - pitch * math.sin(lean),
    )


def _per(before: Vector, after: Vector, dt: float) -> Vector:
    x, y, z = ((new - old) / dt for old, new in zip(before, after, strict=True))
    return x, y, z
