"""Conversions of actors to more special types (§7.4.2.6)."""

from __future__ import annotations

from typing import TypeVar

from osc2tx_runtime.domain.actors import Actor
from osc2tx_runtime.errors import ScenarioError

__all__ = ["as_type"]

ActorT = TypeVar("ActorT", bound=Actor)


def as_type(actor: Actor, kind: type[ActorT]) -> ActorT:
    """Return an actor as one of a more special type.

    Raises:
        ScenarioError: If it is none.
    """
    if not isinstance(actor, kind):
        raise ScenarioError(f"{actor.id} is no {kind.kinds[0]}", actor.source)
    return actor
