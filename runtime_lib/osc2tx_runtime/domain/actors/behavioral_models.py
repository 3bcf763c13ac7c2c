"""Behavioral models at work (DSL 8.6): what an object does while no action controls it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from osc2tx_runtime.errors import UnsupportedError
from osc2tx_runtime.language.registry import LONGITUDINAL
from osc2tx_runtime.world.commands import Careful

if TYPE_CHECKING:
    from osc2tx_runtime.domain.actors import PhysicalObject
    from osc2tx_runtime.domain.actors.parts import BehavioralModel
    from osc2tx_runtime.language.context import ExecutionContext

__all__ = ["leave_to"]


def leave_to(context: ExecutionContext, actor: PhysicalObject, model: BehavioralModel) -> None:
    """Let a model command the slots of an object that have no owner.

    Raises:
        UnsupportedError: The model cannot drive such an object.
    """
    careful = model.bm_engine.name == "careful_driver"
    if careful and not actor.lane_bound:
        raise UnsupportedError(
            f"{actor.id}, a {actor.library_kind}, cannot be left to a careful driver:"
            " only vehicles with propulsion can",
            actor.source,
        )
    command = Careful(None) if careful else None
    context.leave(actor.id, LONGITUDINAL, model.bm_engine.name, command)
