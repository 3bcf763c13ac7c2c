"""Facts of the catalogue about the actions that a scenario invokes."""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx.catalogue import ActionEntry, catalogue
from osc2tx.semantics import SemanticModel
from osc2tx.semantics import symbols as sym
from osc2tx.semantics.scope import supertypes
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


def entry_of(action: sym.ActionSymbol) -> ActionEntry | None:
    """Return the entry of a library action, or of the one that an action derives from."""
    for ancestor in supertypes(action):
        if isinstance(ancestor, sym.ActionSymbol) and ancestor.origin != "user":
            entry = catalogue().actions.get(ancestor.qualified_name)
            if entry is not None:
                return entry
    return None


def is_open_ended(action: sym.ActionSymbol) -> bool:
    """Whether an action continues until something ends it."""
    entry = entry_of(action)
    return entry is not None and entry.ends == "open"


def is_instant(action: sym.ActionSymbol) -> bool:
    """Whether an action is over in the instant in which it starts."""
    entry = entry_of(action)
    return action.qualified_name in catalogue().lowered or (
        entry is not None and entry.ends == "instant"
    )


def is_library_actor(actor: sym.ActorSymbol, name: str) -> bool:
    """Whether an actor type is the library's of that name, or derives from it."""
    return any(a.name == name and a.origin != "user" for a in supertypes(actor))
