"""Actors and structs that the scenario's own files declare, as classes of the module.

A class has the fields that have a default or that an instance fixes; one that is neither has no
value that anybody could read.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TypeAlias

from osc2tx import ir
from osc2tx.lowering.context import LoweringContext, present, statement_comments
from osc2tx.lowering.expressions import lower_expression, lower_type
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast

TypeSymbol: TypeAlias = sym.ActorSymbol | sym.StructSymbol
Instance: TypeAlias = ir.Actor | ir.Struct

# Sorts of values that a field can have.
PLAIN = frozenset(
    {ir.Kind.BOOL, ir.Kind.INTEGER, ir.Kind.FLOAT, ir.Kind.STRING, ir.Kind.QUANTITY, ir.Kind.ENUM}
)


def lower_types(
    ctx: LoweringContext, used: Iterable[TypeSymbol], scenarios: Sequence[ir.Scenario]
) -> tuple[ir.OwnType, ...]:
    """Lower the types of declared objects that are not the library's, bases first.

    Args:
        ctx: The checked program.
        used: Types of declared objects.
        scenarios: Where the objects are.
    """
    instances = [d for s in scenarios for d in s.declarations if isinstance(d, Instance)]
    symbols: dict[str, TypeSymbol] = {}
    for symbol in used:
        for each in reversed(_own_lineage(symbol)):
            if symbols.setdefault(each.name, each) is not each:
                ctx.unsupported(
                    "OSC501", each.span, f"another type of the module has the name `{each.name}`"
                )
    lowered = tuple(_lower_type(ctx, symbol, instances) for symbol in symbols.values())
    _require_values(ctx, lowered, instances)
    return lowered


def _own_lineage(symbol: TypeSymbol) -> list[TypeSymbol]:
    """Return a type and its bases, as far as they are not the library's."""
    found = []
    current: TypeSymbol | None = symbol
    while current is not None and current.origin == "user":
        found.append(current)
        current = current.base
    return found


def _lower_type(
    ctx: LoweringContext, symbol: TypeSymbol, instances: Sequence[Instance]
) -> ir.OwnType:
    given = {v.path for each in instances if symbol.name in each.lineage for v in each.values}
    members = (m for m in symbol.members.values() if isinstance(m, sym.FieldSymbol))
    fields = [_lower_field(ctx, m) for m in members if m.default is not None or (m.name,) in given]
    node = next((s for s in _declarations(ctx) if s.name.span == symbol.span), None)
    return ir.OwnType(
        name=symbol.name,
        span=symbol.span,
        comments=() if node is None else statement_comments(node),
        base=None if symbol.base is None else symbol.base.name,
        is_actor=isinstance(symbol, sym.ActorSymbol),
        fields=present(fields),
    )


def _declarations(ctx: LoweringContext) -> Iterable[ast.ActorDeclaration | ast.StructDeclaration]:
    for file in ctx.model.files:
        for statement in file.statements:
            if isinstance(statement, ast.ActorDeclaration | ast.StructDeclaration):
                yield statement


def _lower_field(ctx: LoweringContext, field: sym.FieldSymbol) -> ir.OwnField | None:
    type_ = lower_type(field.type)
    if field.is_variable or type_.kind not in PLAIN:
        return None
    default = None
    if field.default is not None and not isinstance(field.default, ast.SampleExpression):
        default = lower_expression(ctx, field.default)
        if default is not None and any(isinstance(p, ir.FieldRef) for p in ir.walk(default)):
            ctx.unsupported("OSC501", default.span, "this default needs a scenario to be known")
    comments = () if field.node is None else statement_comments(field.node)
    return ir.OwnField(
        name=field.name, span=field.span, comments=comments, type=type_, default=default
    )


def _require_values(
    ctx: LoweringContext, types: Sequence[ir.OwnType], instances: Sequence[Instance]
) -> None:
    """Report an instance that leaves open what others of its type fix."""
    by_name = {each.name: each for each in types}
    for instance in instances:
        if isinstance(instance, ir.Struct) and instance.value is not None:
            continue
        given = {value.path for value in instance.values}
        for name in instance.lineage:
            for field in by_name[name].fields if name in by_name else ():
                if field.default is None and (field.name,) not in given:
                    ctx.unsupported(
                        "OSC501",
                        instance.span,
                        f"`{instance.name}` does not say its `{field.name}`",
                        help=f"give it a default in `{name}`, or `keep(it.{field.name} == value)`",
                    )
