"""Reports members of types that modules do not support.

What the members of a type mean is mostly said where they are used: fields and constraints by the
objects, methods by their calls, events by those who wait for them. The rest has to be looked for.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from osc2tx.lowering.context import LoweringContext
from osc2tx.semantics import symbols as sym
from osc2tx.semantics.scope import supertypes
from osc2tx.semantics.types import ActorType, StructType
from osc2tx.syntax import ast


def report_unsupported_members(
    ctx: LoweringContext, used: Iterable[sym.TypeSymbol], actions: Iterable[sym.ActionSymbol]
) -> None:
    """Report members of types in use that would have no effect, each of them once.

    Args:
        ctx: The checked program.
        used: Types of declared objects.
        actions: Actions that are invoked.
    """
    found: dict[sym.TypeSymbol, None] = {}
    for symbol in (*used, *actions):
        _add(symbol, found)
    for symbol in found:
        for statement in symbol.statements:
            _report(ctx, symbol, statement)


def _add(symbol: sym.TypeSymbol, found: dict[sym.TypeSymbol, None]) -> None:
    """Add a type, those it inherits from, and those of its fields."""
    for ancestor in supertypes(symbol):
        if ancestor in found:
            continue
        found[ancestor] = None
        for field in ancestor.members.values():
            type_ = field.type if isinstance(field, sym.FieldSymbol) else None
            if field.origin == "user" and isinstance(type_, ActorType | StructType):
                _add(type_.symbol, found)


def _report(ctx: LoweringContext, owner: sym.TypeSymbol, statement: ast.Statement) -> None:
    what = {
        sym.ActorSymbol: "an actor",
        sym.StructSymbol: "a struct",
        sym.ActionSymbol: "an action",
    }.get(type(owner), "a type")
    for item in _items(statement):
        ctx.unsupported(
            "OSC501",
            item.span,
            f"`{item.kind}` in {what} is not supported yet",
            help="sample it in the scenario, `cover(name, expression: object.member)`",
        )
    if isinstance(owner, sym.ActionSymbol) and isinstance(
        statement, ast.DoDirective | ast.OnDirective
    ):
        word = "do" if isinstance(statement, ast.DoDirective) else "on"
        ctx.unsupported(
            "OSC506",
            statement.span,
            f"`{word}` in an action is not carried out: actions are, by the runtime or a package",
            help=f"make it a scenario, `scenario {owner.qualified_name}`",
        )


def _items(statement: ast.Statement) -> Iterator[ast.CoverageDeclaration]:
    match statement:
        case ast.CoverageDeclaration():
            yield statement
        case ast.ParameterDeclaration(constraints=constraints):
            for constraint in constraints:
                if isinstance(constraint, ast.CoverageDeclaration):
                    yield constraint
