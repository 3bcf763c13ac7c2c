"""Profiles of speeds: in times, or within limits of the acceleration."""

from __future__ import annotations

import math
from collections.abc import Mapping

from osc2tx.importing.cast import Actor
from osc2tx.importing.cursor import Node
from osc2tx.importing.dimensions import SPEED, TIME, Quantity, literal
from osc2tx.importing.effects import Reader
from osc2tx.importing.statements import Statement, call, composed
from osc2tx.xosc.player.courses import with_jerk
from osc2tx_runtime.world.actor_dimensions import CAR_LIMITS, COMFORT
from osc2tx_runtime.world.grip.friction import ADHESION, GRAVITY

CAR = {
    "maxAcceleration": CAR_LIMITS.acceleration,
    "maxDeceleration": CAR_LIMITS.deceleration,
    "maxAccelerationRate": CAR_LIMITS.jerk,
}
"""The limits of a car in the world."""

SHARES: Mapping[float, str] = {1.0: "asap", COMFORT: ""}
"""The profile of a change of speed that uses a share of the limits of its actor.

Half of the grip on snow is all of it on ice: the whole comes first.
"""


def _held(limits: Mapping[str, float], share: float, grip: float) -> dict[str, float]:
    """Return a share of limits, on a road with a grip (m/s^2)."""
    held = {name: share * min(limits[name], grip) for name in CAR if name != "maxAccelerationRate"}
    return {**held, "maxAccelerationRate": limits["maxAccelerationRate"]}


class Profiles(Reader):
    """Reads profiles of speeds."""

    def statement(self, node: Node, actor: Actor) -> Statement | None:
        """Return what a profile does; `None`, with a finding, if nothing says it."""
        node.text("followingMode")  # the times of the entries hold in both modes
        if node.has("entityRef"):
            node.leave_out(
                "a speed profile relative to another actor has no counterpart in the DSL"
            )
            return None
        limits = node.find("DynamicConstraints")
        changes = []
        for entry in node.children("SpeedProfileEntry"):
            speed = self._values.quantity(entry, "speed", SPEED)
            time = self._values.quantity(entry, "time", TIME)
            if not entry.has("time"):
                changes.append(self._untimed(entry, limits, speed, actor))
            elif time.value == 0.0:
                changes.append(Statement(call(actor.name, "assign_speed", speed.text), length=0.0))
            else:
                changes.append(self._change(actor, speed, "constant", time.text, time.value))
            self._speeds[actor.said] = speed
        if limits is not None:
            limits.use_all()
        return composed("serial", changes) if changes else None

    def _untimed(
        self, entry: Node, limits: Node | None, speed: Quantity, actor: Actor
    ) -> Statement:
        """Return a change of the speed that only limits of the acceleration tell."""
        before, body = self._speeds.get(actor.said), self._body(actor)
        told = {name: self._values.nominal(limits, name, math.inf) for name in CAR if limits}
        own = CAR if body is None else body.limits
        for share, profile in SHARES.items():
            roads = (math.inf, *(each * GRAVITY for each in ADHESION.values()))
            if any(told == _held(each, share, grip) for each in (CAR, own) for grip in roads):
                return self._change(actor, speed, profile)
        if body is None or before is None or before.value == speed.value:
            entry.approximate("the speed changes with the usual accelerations of the world")
            return self._change(actor, speed)
        entry.approximate("the speed changes in the time that its limits give, but not as they say")
        peak, jerk = (
            min(told.get(name, math.inf), body.limits[name])
            for name in (
                "maxAcceleration" if speed.value > before.value else "maxDeceleration",
                "maxAccelerationRate",
            )
        )
        _, time = with_jerk(before.value, speed.value, peak, jerk, 0.0)
        duration = literal(round(time, 6), TIME)
        shape = "constant" if 4.0 * peak / jerk < time else "smooth"  # ramps are short or all of it
        return self._change(actor, speed, shape, duration, time)

    @staticmethod
    def _change(
        actor: Actor,
        speed: Quantity,
        profile: str = "",
        duration: str = "",
        length: float | None = None,
    ) -> Statement:
        """Return a change of the speed; `""` stands for what is not told of it."""
        told = {"target": speed.text, "rate_profile": profile, "duration": duration}
        arguments = {name: text for name, text in told.items() if text}
        return Statement(call(actor.name, "change_speed", **arguments), length=length)
