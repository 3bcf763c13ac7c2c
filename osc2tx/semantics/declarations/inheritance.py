"""Rules of inheritance: cycles, actors, conditions (§7.3.8)."""

from __future__ import annotations

from osc2tx.semantics.resolution import Resolution, declared_here
from osc2tx.semantics.scope import Context, base_of, is_subtype
from osc2tx.semantics.symbols import ActionSymbol, ActorSymbol, ScenarioSymbol, StructSymbol, Symbol


def check_inheritance(r: Resolution, symbol: Symbol, context: Context) -> None:
    """Check a type against its supertype; a bad base is taken away."""
    if not isinstance(symbol, StructSymbol | ActorSymbol | ScenarioSymbol | ActionSymbol):
        return
    if symbol.base is None:
        return
    if _is_cyclic(symbol):
        r.report("OSC307", symbol.span, f"`{symbol.name}` inherits from itself")
        symbol.base = None
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


def _is_cyclic(symbol: StructSymbol | ActorSymbol | ScenarioSymbol | ActionSymbol) -> bool:
    seen = {symbol}
    current = base_of(symbol)
    while current is not None:
        if current is symbol:
            return True
        if current in seen:
            return False
        seen.add(current)  # type: ignore[arg-type]
        current = base_of(current)
    return False


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
