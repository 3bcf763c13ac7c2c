"""Types of the library that scenarios and fields of the user hide."""

from __future__ import annotations

from osc2tx.semantics.resolution import Resolution
from osc2tx.semantics.scope import NamedSymbol
from osc2tx.semantics.symbols import ActionSymbol
from osc2tx.semantics.types import BehaviorType, Type


def described(type_: Type) -> str:
    """Return how a message names the type of a value: a behavior with its kind."""
    return f"{_kind(type_)} `{type_}`" if isinstance(type_, BehaviorType) else f"`{type_}`"


def _kind(type_: BehaviorType) -> str:
    return "action" if isinstance(type_.symbol, ActionSymbol) else "scenario"


def hidden_type(r: Resolution, type_: Type) -> str | None:
    """Return the help for a value of a behavior whose name a type of the library has as well.

    A plain name means the declaration of the user (§7.7.4), so a field `load: trailer` below
    `scenario trailer` is that scenario.
    """
    if not isinstance(type_, BehaviorType):
        return None
    hidden = next((s for s in r.scope.types_named(type_.symbol.name) if _is_library(s)), None)
    if hidden is None:
        return None
    library = f"{hidden.namespace}::{hidden.name}"
    return f"rename that {_kind(type_)}, or write `{library}` for the type of the library"


def _is_library(symbol: NamedSymbol) -> bool:
    return symbol.origin == "library"
