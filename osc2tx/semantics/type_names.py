"""Names of types that several namespaces have (§7.7.3): all but one get their namespace in front.

Backends know types by their names alone. The library keeps its own; then the first type in the
order of the program does.
"""

from __future__ import annotations

from osc2tx.semantics.scope import Scope
from osc2tx.semantics.symbols import ActorSymbol, EnumSymbol, StructSymbol


def tell_types_apart(scope: Scope) -> None:
    """Rename the types of a layer whose names stand for other types as well."""
    for name, group in scope.types.items():
        below = scope.parent is not None and scope.parent.types_named(name)
        for symbol in group if below else group[1:]:
            if isinstance(symbol, ActorSymbol | EnumSymbol | StructSymbol):
                symbol.name = f"{symbol.namespace}::{name}"
