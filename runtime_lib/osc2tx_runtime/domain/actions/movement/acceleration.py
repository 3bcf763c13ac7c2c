"""Acceleration actions: assign, keep and change it (DSL 8.8.2.7, 8.8.2.14, 8.8.2.15).

A released speed slot holds the speed, so an acceleration lasts only while an action holds it:
`assign_acceleration`, then `keep_acceleration`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Unpack

from osc2tx_runtime.domain.modifiers import Modifier, Value, value_of
from osc2tx_runtime.domain.modifiers.groups import SIDE_FREE
from osc2tx_runtime.domain.planning.motion_action import Assignment, Refused
from osc2tx_runtime.language.actions.action import ActionOptions
from osc2tx_runtime.language.actions.registry import LONGITUDINAL, action
from osc2tx_runtime.world.commands import Accelerate, AccelerationChange
from osc2tx_runtime.world.longitudinal.acceleration import acceleration_profile
from osc2tx_runtime.world.longitudinal.execution import excessive_acceleration

from .modifiable import ModifiableAction
from .profiled_change import RatedChange

if TYPE_CHECKING:
    from osc2tx_runtime.domain.actors import MovableObject


@action("movable_object", "assign_acceleration", ends="at_once", slots=(LONGITUDINAL,))
class AssignAcceleration(Assignment):
    """Set an acceleration (m/s^2) instantly, whatever the limits."""

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
        """Assigns it."""
        value, actor_id = value_of(self.acceleration), self.actor.id
        self.effect("acceleration", value, lambda: self.world.assign(actor_id, acceleration=value))


@action("movable_object", "keep_acceleration", slots=(LONGITUDINAL,), ends="open")
class KeepAcceleration(ModifiableAction):
    """Hold the present acceleration; an actor that reaches standstill remains there."""

    accepts: ClassVar[tuple[type, ...]] = SIDE_FREE

    def on_start(self) -> None:
        """Commands it."""
        self.command(LONGITUDINAL, Accelerate(None))


@action("movable_object", "change_acceleration", slots=(LONGITUDINAL,))
class ChangeAcceleration(RatedChange):
    """Reach an acceleration; fails if the actor reaches standstill before.

    Args:
        actor: The actor.
        *modifiers: Modifiers of the lane.
        target: Acceleration (m/s^2), within the limits of the actor.
        rate_profile: Profile of the jerk; `constant`, `none` and `asap` keep it constant.
        rate_peak: Its peak (m/s^3); default: the duration, else the limits of the actor.
        **options: Duration and label.
    """

    unit = "m/s^3"

    def on_start(self) -> None:
        """Commands the change."""
        target, here = value_of(self.target), self.here
        if self.may_jump:
            self.command(LONGITUDINAL, AccelerationChange(target, start=target))
            return
        peak = self.rate_peak
        given = peak is None and self.rate_profile != "asap"
        change = AccelerationChange(
            target, self.rate_profile, peak, self.fixed_duration() if given else None
        )
        reason = excessive_acceleration(target, here.v, self.limits) or self._contradiction(change)
        if reason is not None:
            raise Refused(reason)
        self.command(LONGITUDINAL, change)

    def _contradiction(self, change: AccelerationChange) -> str | None:
        peak = change.rate_peak
        if peak is None:
            return None
        own = acceleration_profile(change, self.here.a, self.limits).duration
        return self.takes_too_long(f"{peak:g} m/s^3", own)
