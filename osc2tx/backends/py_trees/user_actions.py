"""User-defined actions, as typed functions of the module.

The declaration in the scenario gives a function its signature, so that a misspelt argument is an
error of types; the class that carries the action out is found by name when the module runs.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from osc2tx import ir
from osc2tx.backends.py_trees.code import Level, PyDocLine, PyExpr, literal
from osc2tx.backends.py_trees.comments import beside
from osc2tx.backends.py_trees.naming import NameTable, identifier
from osc2tx.backends.py_trees.type_table import TypeTable
from osc2tx.backends.py_trees.uses import Uses
from osc2tx.backends.py_trees.view import ParameterView, UserActionView
from osc2tx.catalogue import catalogue


def action_key(action: str) -> str:
    """Return the key of the function of an action in the table of the module's names."""
    return f"action {action}"


def protocol_key(action: str) -> str:
    """Return the key of the type of the function of an action, from that of the action."""
    return f"type of {action}"


def is_function(node: ir.Invoke) -> bool:
    """Return whether an action is no method of the runtime's actors."""
    return node.is_own and has_function(node.qualified_name)


def has_function(action: str) -> bool:
    """Return whether a module needs a function for a user-defined action."""
    return action not in catalogue().actions


def write_actions(
    actions: Iterable[ir.UserAction],
    names: NameTable,
    types: TypeTable,
    uses: Uses,
    write: Callable[[ir.Expression], PyExpr],
) -> tuple[UserActionView, ...]:
    """Return the view models of the functions that a module defines, in their order.

    Args:
        actions: Those actions.
        names: Names of the module.
        types: All types that the module knows.
        uses: Collects the imports of the module.
        write: Writes a default.
    """
    return tuple(_write(action, names, types, uses, write) for action in actions)


def _write(
    action: ir.UserAction,
    names: NameTable,
    types: TypeTable,
    uses: Uses,
    write: Callable[[ir.Expression], PyExpr],
) -> UserActionView:
    key = action_key(action.qualified_name)
    uses.standard("typing", "Protocol")
    uses.name("Behaviour")
    if action.base is not None:
        uses.standard("typing", "ClassVar")
    about = [f"Action `{action.qualified_name}`.", *action.comments]
    if action.comments:
        about.insert(1, "")
    return UserActionView(
        function=names[key],
        protocol=names[protocol_key(key)],
        action=literal(identifier(action.name)),
        binder=uses.name("global_action" if action.owner is None else "user_action"),
        docstring=tuple(PyDocLine.of(line) for line in about),
        parameters=tuple(_parameters(action, types, uses, write)),
        base=None if action.base is None else literal(identifier(action.base)),
    )


def _parameters(
    action: ir.UserAction,
    types: TypeTable,
    uses: Uses,
    write: Callable[[ir.Expression], PyExpr],
) -> Iterator[ParameterView]:
    if action.takes_modifiers:
        modifier = uses.name("Modifier")
        label = (f"label: str | {modifier} | None = None", "/", f"*modifiers: {modifier}")
    else:
        label = ("label: str | None = None", "/", "*")
    actor = () if action.owner is None else (f"actor: {types.class_or_object(action.owner)}",)
    for each in (*actor, *label):
        yield ParameterView(PyExpr(each, Level.ATOM))
    for parameter in action.parameters:
        annotation = str(types.annotation(parameter.type))
        if parameter.type.kind is not ir.Kind.ACTOR:
            annotation = f"{uses.name('Late')}[{annotation}]"
        default = "" if parameter.has_default else " = ..."
        if parameter.default is not None:
            default = f" = {write(parameter.default)}"
        text = f"{identifier(parameter.name)}: {annotation}{default}"
        yield ParameterView(
            PyExpr(text, Level.ATOM), **beside(parameter.comments, f"        {text},")
        )
    yield ParameterView(PyExpr(f"duration: {uses.name('Duration')} | None = None", Level.ATOM))
