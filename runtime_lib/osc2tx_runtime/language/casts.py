"""Conversions of actors to more special types (§7.4.2.6)."""

from __future__ import annotations

from typing import TypeVar

from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.declared import BaseActor

__all__ = ["as_type"]

ActorT = TypeVar("ActorT", bound=BaseActor)


def as_type(actor: BaseActor, kind: type[ActorT]) -> ActorT:
    """Return an actor as one of a more special type.

    Raises:
        ScenarioError: If it is none.
    """
    if not isinstance(actor, kind):
        raise ScenarioError(f"{actor.id} is no {kind.kinds[0]}", actor.source)
    return actor
