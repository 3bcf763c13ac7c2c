"""Actions of the actor type `animal`; made by tools/make_actor_methods.py."""

# The registry executes these declarations.
# mypy: disable-error-code="empty-body"

from __future__ import annotations

from typing import TYPE_CHECKING

from osc2tx_runtime.language.actions.registry import carried_out

if TYPE_CHECKING:
    from osc2tx_runtime.domain.modifiers.groups import PathModifier, StartModifier, TurnModifier
    from osc2tx_runtime.domain.modifiers.movement.conduct import AvoidCollisions, PhysicalMovement
    from osc2tx_runtime.domain.modifiers.movement.position import Distance, KeepPosition
    from osc2tx_runtime.domain.modifiers.movement.speed import Acceleration, ChangeSpeed, KeepSpeed
    from osc2tx_runtime.language.tree.base import Behaviour
    from osc2tx_runtime.language.tree.duration_limits import Duration


@carried_out
class AnimalMethods:
    """Actions of the actor type `animal`."""

    def walk(
        self,
        label: (
            str
            | TurnModifier
            | PathModifier
            | StartModifier
            | Acceleration
            | AvoidCollisions
            | ChangeSpeed
            | Distance
            | KeepPosition
            | KeepSpeed
            | PhysicalMovement
            | None
        ) = None,
        /,
        *modifiers: TurnModifier
        | PathModifier
        | StartModifier
        | Acceleration
        | AvoidCollisions
        | ChangeSpeed
        | Distance
        | KeepPosition
        | KeepSpeed
        | PhysicalMovement,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Walk as the modifiers state, straight ahead or along a path."""
