"""Actions on the acceleration (DSL 8.8.2.7, 8.8.2.14, 8.8.2.15).

A released speed slot holds the speed, so an acceleration lasts only as long as an action keeps it:
`assign_acceleration`, then `keep_acceleration`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Unpack

from osc2tx_runtime.action import ActionOptions
from osc2tx_runtime.behaviour.base import Status
from osc2tx_runtime.modifiers import Modifier, Value, value_of
from osc2tx_runtime.registry import LONGITUDINAL, action
from osc2tx_runtime.world.acceleration import acceleration_profile
from osc2tx_runtime.world.commands import Accelerate, AccelerationChange
from osc2tx_runtime.world.longitudinal import excessive_acceleration
from osc2tx_runtime.world.profiles import DynamicProfile

from .speed import check_profile
from .support import MotionAction, OneStepAction

if TYPE_CHECKING:
    from osc2tx_runtime.actors import MovableObject

__all__ = ["AssignAcceleration", "ChangeAcceleration", "KeepAcceleration"]


@action("movable_object", "assign_acceleration", slots=(LONGITUDINAL,))
class AssignAcceleration(OneStepAction):
    """Have an acceleration (m/s^2) over the next step, whatever the limits."""

    def __init__(
        self,
        actor: MovableObject,
        *modifiers: Modifier,
        acceleration: Value,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        self.acceleration = acceleration

    def on_start(self) -> None:
        """Commands it."""
        self.command(LONGITUDINAL, Accelerate(value_of(self.acceleration)))


@action("movable_object", "keep_acceleration", slots=(LONGITUDINAL,), ends="open")
class KeepAcceleration(MotionAction):
    """Hold the present acceleration; an actor that comes to a stand stays there."""

    def on_start(self) -> None:
        """Commands it."""
        self.command(LONGITUDINAL, Accelerate(self.here.a))


@action("movable_object", "change_acceleration", slots=(LONGITUDINAL,))
class ChangeAcceleration(MotionAction):
    """Reach an acceleration; fails if the actor comes to a stand before.

    Args:
        actor: Who.
        *modifiers: None are taken.
        target: Acceleration (m/s^2), within the limits of the actor.
        rate_profile: Course of the jerk; `constant`, `none` and `asap` keep it constant.
        rate_peak: Its peak (m/s^3); default: the duration, else the limits of the actor.
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
        """Commands the change."""
        target, here = value_of(self.target), self.here
        given = self.rate_peak is None and self.rate_profile != "asap"
        change = AccelerationChange(
            target, self.rate_profile, self.rate_peak, self.fixed_duration() if given else None
        )
        self._refused = excessive_acceleration(target, here.v, self.limits)
        if self.rate_peak is not None and self.rate_peak <= 0.0:
            self._refused = f"rate_peak {self.rate_peak:g} m/s^3 is not positive"
        duration = self.fixed_duration()
        if self._refused is None and duration is not None and self.rate_peak is not None:
            own = acceleration_profile(change, here.a, self.limits).duration
            if abs(own - duration) > self.context.dt:
                self._refused = (
                    f"with rate_peak {self.rate_peak:g} m/s^3 it takes {own:.2f} s, not"
                    f" {duration:g} s"
                )
        if self._refused is None:
            self.command(LONGITUDINAL, change)

    def on_update(self) -> Status:
        """Ends at the target."""
        return super().on_update() if self._refused is None else self.fail(self._refused)
