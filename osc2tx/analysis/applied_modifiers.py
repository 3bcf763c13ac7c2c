"""Modifiers of the library that apply to an invocation; those of the user are expanded."""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx.semantics import SemanticModel
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast


def library_modifiers(
    model: SemanticModel, node: ast.ModifierApplication
) -> Iterator[ast.ModifierApplication]:
    """Yield a modifier of the library, or those in the body of one of the user."""
    pending, seen = [node], set[sym.Symbol]()
    while pending:
        current = pending.pop()
        binding = model.bindings.get(current)
        callee = binding.callee if binding is not None else None
        if not isinstance(callee, sym.ModifierSymbol) or callee.origin != "user":
            yield current
        elif callee not in seen:
            seen.add(callee)
            inner = [s for s in callee.statements if isinstance(s, ast.ModifierApplication)]
            pending += reversed(inner)
