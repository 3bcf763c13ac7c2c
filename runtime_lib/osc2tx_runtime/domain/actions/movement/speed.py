"""Speed actions: change, keep and assign it; remain stationary (DSL 8.8.2)."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Unpack

from osc2tx_runtime.domain.modifiers import (
    KeepPosition,
    Modifier,
    PhysicalMovement,
    Value,
    value_of,
)
from osc2tx_runtime.domain.modifiers.groups import PLACES, SIDE_FREE
from osc2tx_runtime.domain.planning.longitudinal.longitudinal_planning import (
    jump_to,
    stop_command,
)
from osc2tx_runtime.domain.planning.motion_action import Assignment, Refused
from osc2tx_runtime.language.actions.action import ActionOptions
from osc2tx_runtime.language.actions.registry import LATERAL, LONGITUDINAL, action
from osc2tx_runtime.language.tree.base import Status
from osc2tx_runtime.world.commands import SpeedChange
from osc2tx_runtime.world.longitudinal.execution import (
    excessive_rate,
    speed_profile,
    within_limits,
)
from osc2tx_shared.classes import replace

from .modifiable import ModifiableAction
from .profiled_change import RatedChange

if TYPE_CHECKING:
    from osc2tx_runtime.domain.actors import MovableObject


@action("movable_object", "change_speed", slots=(LONGITUDINAL,))
class ChangeSpeed(RatedChange):
    """Reach a speed.

    Args:
        actor: The actor.
        *modifiers: Modifiers of the lane.
        target: Speed (m/s).
        rate_profile: Profile of the acceleration.
        rate_peak: Its peak (m/s^2); default: the duration, else the limits of the actor.
        **options: Duration and label.
    """

    unit = "m/s^2"
    _is_there = False

    def on_start(self) -> None:
        """Commands the change, or nothing if the speed is already reached."""
        limits = self.limits if self.strict else self.tyres
        change = within_limits(self._change(value_of(self.target)), self.here.v, limits)
        reason = excessive_rate(change, self.here.v, limits)
        reason = None if self.may_jump else reason or self._contradiction(change)
        if reason is not None:
            raise Refused(reason)
        self._is_there = change.target == self.here.v
        if not self._is_there:
            self.command(LONGITUDINAL, change)

    def lasts_its_duration(self) -> bool:
        """Whether the speed is already reached, and remains for the duration."""
        return self._is_there

    def on_update(self) -> Status:
        """Ends at the target speed."""
        if self.elapsed_steps == 0 and self._is_there and not self.has_goal:
            return Status.SUCCESS
        return super().on_update()

    def _change(self, target: float) -> SpeedChange:
        if self.may_jump:
            return jump_to(target)
        change = SpeedChange(target, self.rate_profile, self.rate_peak)
        frame = self.time_frame()
        if frame is None or self.rate_profile == "asap" or change.rate_peak is not None:
            return change
        if not isinstance(frame, tuple):
            return replace(change, duration=self.fixed_duration())
        low, high = frame
        own = speed_profile(change, self.here.v, self.limits).duration
        return replace(change, duration=min(max(own, low), high))

    def _contradiction(self, change: SpeedChange) -> str | None:
        if change.rate_peak is None or self.rate_profile == "asap":
            return None
        own = speed_profile(change, self.here.v, self.limits).duration
        return self.takes_too_long(f"{change.rate_peak:g} m/s^2", own)


@action("movable_object", "keep_speed", slots=(LONGITUDINAL,), ends="open")
class KeepSpeed(ModifiableAction):
    """Hold the present speed."""

    accepts: ClassVar[tuple[type, ...]] = SIDE_FREE

    def on_start(self) -> None:
        """Commands it."""
        self.command(LONGITUDINAL, jump_to(self.here.v))


@action("movable_object", "assign_speed", ends="at_once", slots=(LONGITUDINAL,))
class AssignSpeed(Assignment):
    """Set a speed (m/s) instantly, whatever the limits."""

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
class RemainStationary(ModifiableAction):
    """Remain at standstill.

    A moving actor first brakes with its greatest deceleration, unless physics must hold. If a
    modifier states the position, the actor has to be there at the start.
    """

    accepts: ClassVar[tuple[type, ...]] = (*PLACES, KeepPosition, PhysicalMovement)
    stands = True

    def __init__(
        self, actor: MovableObject, *modifiers: Modifier, **options: Unpack[ActionOptions]
    ) -> None:
        at_start = (
            replace(each, at="start") if isinstance(each, PLACES) else each for each in modifiers
        )
        super().__init__(actor, *at_start, **options)

    def on_start(self) -> None:
        """Commands it."""
        self.command(LONGITUDINAL, stop_command(self))
