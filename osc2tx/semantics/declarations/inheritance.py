"""Rules of inheritance: cycles, levels, actors, conditions (§7.3.8)."""

from __future__ import annotations

from collections.abc import Sequence

from osc2tx.semantics.resolution import Resolution, declared_here
from osc2tx.semantics.scope import Context, base_of, is_subtype
from osc2tx.semantics.symbols import (
    ActionSymbol,
    ActorSymbol,
    ScenarioSymbol,
    StructSymbol,
    Symbol,
    TypeSymbol,
)

MOST_LEVELS = 100
"""Types from which one inherits: each has all of their members, so n levels cost n * n."""


def check_inheritance(r: Resolution, symbol: Symbol, context: Context) -> None:
    """Check a type against its supertype; a bad base is taken away or replaced."""
    if not isinstance(symbol, StructSymbol | ActorSymbol | ScenarioSymbol | ActionSymbol):
        return
    if symbol.base is None:
        return
    *bases, first = _bases(symbol)
    if first is symbol:
        r.report("OSC307", symbol.span, f"`{symbol.name}` inherits from itself")
        symbol.base = None
        return
    if len(bases) >= MOST_LEVELS:
        if len(bases) == MOST_LEVELS:  # those that inherit from it are not at fault
            r.report(
                "OSC324",
                symbol.span,
                f"`{symbol.name}` inherits through more than {MOST_LEVELS} types, the first of "
                f"which is `{first.name}`",
                labels=declared_here(first),
            )
        symbol.base = first  # type: ignore[assignment]  # those in between count no more
        return
    if isinstance(symbol, ScenarioSymbol | ActionSymbol):
        _check_actors(r, symbol)
    if symbol.condition is None and symbol.base.condition is not None:
        r.report(
            "OSC308",
            symbol.span,
            f"`{symbol.name}` derives without a condition from `{symbol.base.name}`, which has one",
            labels=declared_here(symbol.base),
        )


def _bases(symbol: TypeSymbol) -> Sequence[TypeSymbol]:
    """Return the types from which one inherits; the last is the type itself in a circle."""
    found: dict[TypeSymbol, None] = {}
    current = base_of(symbol)
    while current is not None and current not in found:
        found[current] = None
        if current is symbol:
            break
        current = base_of(current)
    return list(found)


def _check_actors(r: Resolution, symbol: ScenarioSymbol | ActionSymbol) -> None:
    assert symbol.base is not None
    own, inherited = symbol.actor, symbol.base.actor
    if symbol.node.name.actor is not None and own is None:
        return  # an unknown actor was reported
    fits = own is inherited if own is None or inherited is None else is_subtype(own, inherited)
    if not fits:
        r.report(
            "OSC318",
            symbol.span,
            f"`{symbol.qualified_name}` cannot inherit from `{symbol.base.qualified_name}`: "
            "its actor is not of that type",
            labels=declared_here(symbol.base),
        )
