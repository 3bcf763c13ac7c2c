"""Conversions of actors and structs to more special types (§7.4.2.6)."""

from __future__ import annotations

from typing import TypeVar

from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.declared import BaseActor

__all__ = ["as_type"]

ObjectT = TypeVar("ObjectT")


def as_type(value: object, kind: type[ObjectT]) -> ObjectT:
    """Return an actor or a struct as one of a more special type.

    Raises:
        ScenarioError: If it is none.
    """
    if isinstance(value, kind):
        return value
    if isinstance(value, BaseActor) and issubclass(kind, BaseActor):
        raise ScenarioError(f"{value.id} is no {kind.kinds[0]}", value.source)
    raise ScenarioError(f"a {type(value).__name__} is no {kind.__name__}")
