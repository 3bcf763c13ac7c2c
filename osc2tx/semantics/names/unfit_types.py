"""Values of types that do not fit: structs and behaviors in place of actors."""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx.semantics.resolution import Resolution
from osc2tx.semantics.scope import NamedSymbol
from osc2tx.semantics.symbols import ActionSymbol, FieldSymbol
from osc2tx.semantics.types import BehaviorType, ListType, StructType, Type
from osc2tx.syntax import ast


def actions_on(r: Resolution, type_: Type, node: ast.Invocation) -> str | None:
    """Return a help text that names the actions which change a struct.

    Args:
        r: The state of the pass.
        type_: The type of the expression that is used as an actor.
        node: The invocation.

    Returns:
        The action with the name of the invocation, otherwise all actions that take such a struct,
        otherwise the action with the name of the struct (`rain`); `None` if there is none.
    """
    if not isinstance(type_, StructType):
        return None
    name, called = node.behavior.text, list(_actions(r))
    taking = [(action, p) for action in called for p in _parameters_of_type(action, type_)]
    for action, parameter in taking:
        if action.name == name and node.actor is not None:
            return _call(action, f"{parameter}: {node.actor.span.text}, …")
    for action in called:
        if action.name == name:
            return _call(action, "…")
    if taking:
        names = sorted({f"`{action.qualified_name}`" for action, _ in taking})
        return f"actions that change it: {', '.join(names)}"
    own = next((action for action in called if action.name == type_.symbol.name), None)
    return None if own is None else f"`{own.qualified_name}` changes it"


def _call(action: ActionSymbol, arguments: str) -> str:
    actor = action.actor.name if action.actor else ""
    return f"write `<{actor}>.{action.name}({arguments})` with an actor of type `{actor}`"


def _actions(r: Resolution) -> Iterator[ActionSymbol]:
    """Yield all actions of actors."""
    for layer in r.scope.layers():
        for group in layer.behaviors.values():
            for symbol in group:
                if isinstance(symbol, ActionSymbol) and symbol.actor is not None:
                    yield symbol


def _parameters_of_type(action: ActionSymbol, type_: StructType) -> Iterator[str]:
    """Yield the parameters of an action that are such a struct, or a list of them."""
    for member in action.members.values():
        if isinstance(member, FieldSymbol) and not member.is_variable:
            found = member.type.element if isinstance(member.type, ListType) else member.type
            if found == type_:
                yield member.name


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
