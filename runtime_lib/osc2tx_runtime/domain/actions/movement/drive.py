"""The generic actions `drive`, `walk` and `move` (DSL 8.8.2.3, 8.8.3.1)."""

from __future__ import annotations

from typing import ClassVar

from osc2tx_runtime.domain.modifiers import (
    Acceleration,
    AvoidCollisions,
    ChangeSpeed,
    Distance,
    KeepPosition,
    KeepSpeed,
    PhysicalMovement,
    Speed,
)
from osc2tx_runtime.domain.modifiers.groups import (
    LANE_SHAPERS,
    PATH_SHAPERS,
    SPEED_SHAPERS,
    TURN_SHAPERS,
)
from osc2tx_runtime.language.actions.registry import action

from .modifiable import ModifiableAction


@action("movable_object", "move", ends="open")
class Move(ModifiableAction):
    """Move as the modifiers state."""

    accepts: ClassVar[tuple[type, ...]] = (
        *SPEED_SHAPERS,
        *LANE_SHAPERS,
        *TURN_SHAPERS,
        *PATH_SHAPERS,
        *(Distance, KeepPosition, PhysicalMovement),
    )


@action("vehicle", "drive", ends="open")
class Drive(ModifiableAction):
    """Drive as the modifiers state.

    Without modifiers along the lane at the present speed.
    """

    accepts: ClassVar[tuple[type, ...]] = Move.accepts


@action(
    "animal",
    "walk",
    ends="open",
    undeclared="the text of §8.8.4.1 lets animals walk, its types do not",
)
@action("person", "walk", ends="open")
class Walk(ModifiableAction):
    """Walk as the modifiers state, straight ahead or along a path."""

    accepts: ClassVar[tuple[type, ...]] = (
        *(Speed, ChangeSpeed, KeepSpeed, Acceleration),
        *(Distance, KeepPosition, AvoidCollisions),
        *TURN_SHAPERS,
        *PATH_SHAPERS,
        PhysicalMovement,
    )
