"""The base of actions with motion modifiers, as the planning modules see them."""

from __future__ import annotations

from functools import cached_property
from typing import Unpack

from osc2tx_runtime.domain.actors import MovableObject
from osc2tx_runtime.domain.modifiers import Modifier, Orient
from osc2tx_runtime.domain.placing.pose_resolution import one_of_kind
from osc2tx_runtime.language.action import ActionOptions
from osc2tx_runtime.language.tree.duration_limits import Limits

from .motion_action import MotionAction

__all__ = ["ModifiedMotion"]


class ModifiedMotion(MotionAction):
    """An action with modifiers that say how its actor moves, and until when.

    Attributes:
        movable: The actor.
    """

    def __init__(
        self, actor: MovableObject, *modifiers: Modifier, **options: Unpack[ActionOptions]
    ) -> None:
        self.movable = actor  # what the action becomes may depend on it
        super().__init__(actor, *modifiers, **options)
        self._phase: Limits | None = None

    @cached_property
    def lasting(self) -> tuple[Modifier, ...]:
        """The modifiers but those that only speak of the start."""
        return tuple(modifier for modifier in self.modifiers if not modifier.is_start)

    @cached_property
    def orient(self) -> Orient | None:
        """How a vehicle is to be tilted for some time; None if nothing is said of it."""
        return one_of_kind(self.lasting, Orient) if self.movable.lane_bound else None

    @property
    def end_is_known(self) -> bool:
        """Whether it is known in advance when the action ends."""
        return self.fixed_duration() is not None or self._phase is not None

    def time_left(self) -> float | None:
        """Seconds until the end, where it is known."""
        if self._phase is not None:
            return self._phase.left * self.context.dt
        return super().time_left()
