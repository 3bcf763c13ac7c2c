"""Actors and structs that the scenario's files declare, as classes of the module."""

from __future__ import annotations

from collections.abc import Iterable

from osc2tx import ir
from osc2tx.lowering.context import LoweringContext, statement_comments
from osc2tx.lowering.user_fields import TypeSymbol, class_default, user_fields, user_lineage
from osc2tx.lowering.value_types import lower_type
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.syntax import ast


def lower_types(ctx: LoweringContext, used: Iterable[TypeSymbol]) -> tuple[ir.UserType, ...]:
    """Lower the types of declared objects that are not the library's.

    Bases come first, and so do the types of fields, as far as they do not need each other.

    Args:
        ctx: The checked program.
        used: Types of declared objects.
    """
    symbols: dict[str, TypeSymbol] = {}
    for symbol in used:
        _add(ctx, symbol, symbols, ())
    return tuple(_lower_type(ctx, symbol) for symbol in symbols.values())


def _add(
    ctx: LoweringContext,
    symbol: TypeSymbol,
    symbols: dict[str, TypeSymbol],
    around: tuple[TypeSymbol, ...],
) -> None:
    """Add a type below all that it needs."""
    for each in reversed(user_lineage(symbol)):
        if each in around:
            continue
        for field in user_fields(ctx, each):
            for needed in _object_types(field.type):
                _add(ctx, needed, symbols, (*around, each))
        if symbols.setdefault(each.name, each) is not each:
            ctx.unsupported(
                "OSC501",
                each.span,
                f"another type of the module has the name `{each.name}`",
                help="types of one module share their names, whatever their namespace: rename one",
            )


def _object_types(type_: types.Type) -> Iterable[TypeSymbol]:
    match type_:
        case types.ActorType(symbol=symbol) | types.StructType(symbol=symbol):
            return (symbol,)
        case types.ListType(element=element):
            return _object_types(element)
        case _:
            return ()


def _lower_type(ctx: LoweringContext, symbol: TypeSymbol) -> ir.UserType:
    node = next((s for s in _declarations(ctx) if s.name.span == symbol.span), None)
    return ir.UserType(
        name=symbol.name,
        span=symbol.span,
        comments=() if node is None else statement_comments(node),
        base=None if symbol.base is None else symbol.base.name,
        is_actor=isinstance(symbol, sym.ActorSymbol),
        fields=tuple(_lower_field(ctx, field) for field in user_fields(ctx, symbol)),
    )


def _declarations(ctx: LoweringContext) -> Iterable[ast.ActorDeclaration | ast.StructDeclaration]:
    for file in ctx.model.files:
        for statement in file.statements:
            if isinstance(statement, ast.ActorDeclaration | ast.StructDeclaration):
                yield statement


def _lower_field(ctx: LoweringContext, field: sym.FieldSymbol) -> ir.UserField:
    return ir.UserField(
        name=field.name,
        span=field.span,
        comments=() if field.node is None else statement_comments(field.node),
        type=lower_type(field.type),
        default=class_default(ctx, field),
    )
