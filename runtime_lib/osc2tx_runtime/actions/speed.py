"""Actions on the speed alone (DSL 8.8.2)."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Unpack

from osc2tx_runtime.action import ActionOptions
from osc2tx_runtime.behaviour.base import Status
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.modifiers import Modifier, Value, value_of
from osc2tx_runtime.registry import LATERAL, LONGITUDINAL, action
from osc2tx_runtime.world.commands import SpeedChange, Standstill
from osc2tx_runtime.world.longitudinal import excessive_rate, speed_profile
from osc2tx_runtime.world.profiles import PROFILES, DynamicProfile

from .support import MotionAction, OneStepAction

if TYPE_CHECKING:
    from osc2tx_runtime.actors import MovableObject

__all__ = ["AssignSpeed", "ChangeSpeed", "KeepSpeed", "RemainStationary", "check_profile"]


def check_profile(name: str, profile: str) -> None:
    """Refuses a profile that does not exist."""
    if profile not in PROFILES:
        raise ScenarioError(f"{name}: rate_profile `{profile}` is none of {', '.join(PROFILES)}")


@action("movable_object", "change_speed", slots=(LONGITUDINAL,))
class ChangeSpeed(MotionAction):
    """Reach a speed.

    Args:
        actor: Who.
        *modifiers: None are taken.
        target: Speed (m/s).
        rate_profile: Course of the acceleration.
        rate_peak: Its peak (m/s^2); default: the duration, else the limits of the actor.
        **options: Duration and label.
    """

    def __init__(
        self,
        actor: MovableObject,
        *modifiers: Modifier,
        target: Value,
        rate_profile: DynamicProfile = "none",
        rate_peak: float | None = None,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        check_profile(self.action_name, rate_profile)
        self.target = target
        self.rate_profile: DynamicProfile = rate_profile
        self.rate_peak = rate_peak
        self._refused: str | None = None

    def on_start(self) -> None:
        """Commands the change, or nothing if the speed is there already."""
        change = self._change(value_of(self.target))
        self._refused = excessive_rate(change, self.here.v) or self._contradiction(change)
        if self._refused is None and change.target != self.here.v:
            self.command(LONGITUDINAL, change)

    def on_update(self) -> Status:
        """Ends at the target speed."""
        if self._refused is not None:
            return self.fail(self._refused)
        if self.elapsed_steps == 0 and value_of(self.target) == self.here.v:
            return Status.SUCCESS
        return super().on_update()

    def _change(self, target: float) -> SpeedChange:
        change = SpeedChange(target, self.rate_profile, self.rate_peak)
        if self.duration is None or self.rate_profile == "asap" or self.rate_peak is not None:
            return change
        if not isinstance(self.duration, tuple):
            return dataclasses.replace(change, duration=float(self.duration))
        low, high = self.duration
        own = speed_profile(change, self.here.v, self.actor.spec().limits).duration
        return dataclasses.replace(change, duration=min(max(own, low), high))

    def _contradiction(self, change: SpeedChange) -> str | None:
        duration = self.fixed_duration()
        if duration is None or change.rate_peak is None or self.rate_profile == "asap":
            return None
        own = speed_profile(change, self.here.v, self.actor.spec().limits).duration
        if abs(own - duration) <= self.context.dt:
            return None
        return f"with rate_peak {change.rate_peak:g} m/s^2 it takes {own:.2f} s, not {duration:g} s"


@action("movable_object", "keep_speed", slots=(LONGITUDINAL,), ends="open")
class KeepSpeed(MotionAction):
    """Hold the present speed: what a released slot does by itself."""


@action("movable_object", "assign_speed", slots=(LONGITUDINAL,))
class AssignSpeed(OneStepAction):
    """Have a speed (m/s) at the next step, whatever the limits."""

    def __init__(
        self,
        actor: MovableObject,
        *modifiers: Modifier,
        speed: Value,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        self.speed = speed

    def on_start(self) -> None:
        """Assigns it."""
        speed = value_of(self.speed)
        self.effect("speed", speed, lambda: self.world.assign(self.actor.id, speed=speed))


@action("movable_object", "remain_stationary", slots=(LONGITUDINAL, LATERAL), ends="open")
class RemainStationary(MotionAction):
    """Stand; an actor that moves brakes as hard as it can first."""

    def on_start(self) -> None:
        """Commands it."""
        self.command(LONGITUDINAL, Standstill())
