"""Fields of actors and structs that the scenario's files declare.

A class has the fields that have a default or that some text speaks of. The default is part of the
class if it needs nothing else; one that reads other fields or globals belongs to each object.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

from osc2tx import ir
from osc2tx.lowering.context import LoweringContext, Receiver
from osc2tx.lowering.expressions import lower_expression
from osc2tx.lowering.value_types import lower_type
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.semantics.model import SemanticModel
from osc2tx.syntax import ast

TypeSymbol: TypeAlias = sym.ActorSymbol | sym.StructSymbol

# Sorts of values that a setting of a run can give.
PLAIN = frozenset(
    {ir.Kind.BOOL, ir.Kind.INTEGER, ir.Kind.FLOAT, ir.Kind.STRING, ir.Kind.QUANTITY, ir.Kind.ENUM}
)

# What an expression may not read to be a default of a class.
_OF_OBJECTS = (ir.FieldRef, ir.ParameterRef, ir.ScenarioSelf)


def mentioned_fields(model: SemanticModel) -> frozenset[sym.FieldSymbol]:
    """Return the fields that some expression of a program speaks of."""
    return frozenset(
        symbol
        for node, symbol in model.references.items()
        if isinstance(symbol, sym.FieldSymbol)
        and isinstance(node, ast.NameExpression | ast.MemberAccess)
    )


def user_fields(ctx: LoweringContext, symbol: TypeSymbol) -> Iterator[sym.FieldSymbol]:
    """Yield the fields that the class of an own type adds to those of its base."""
    for member in symbol.members.values():
        if not isinstance(member, sym.FieldSymbol) or isinstance(
            member.default, ast.SampleExpression
        ):
            continue
        if member.default is not None or member.constraints or member in ctx.mentioned:
            yield member


def user_lineage(symbol: TypeSymbol) -> tuple[TypeSymbol, ...]:
    """Return a type and its bases, as far as they are not the library's."""
    found = []
    current: TypeSymbol | None = symbol
    while current is not None and current.origin == "user":
        found.append(current)
        current = current.base
    return tuple(found)


def class_default(ctx: LoweringContext, field: sym.FieldSymbol) -> ir.Expression | None:
    """Return the default of a field if it is the same for all objects; `None` if not, or none.

    Lists and ranges belong to each object too: Python would share one list among all of them.
    """
    if not is_plain(field.type):
        return None
    lowered = object_default(
        ctx.quiet(), field, ir.ParameterRef(span=field.span, type=_OWNER, name="")
    )
    if lowered is None or any(isinstance(part, _OF_OBJECTS) for part in ir.walk(lowered)):
        return None
    return lowered


def object_default(
    ctx: LoweringContext, field: sym.FieldSymbol, owner: ir.Expression
) -> ir.Expression | None:
    """Return the default of a field of an object."""
    if field.default is None or isinstance(field.default, ast.SampleExpression):
        return None
    assert isinstance(field.owner, sym.ActorSymbol | sym.StructSymbol)
    inside = ctx.inside(Receiver(field.owner, owner))
    return lower_expression(inside, field.default)


def is_plain(type_: types.Type) -> bool:
    """Whether a setting of a run can give a value of a type."""
    return lower_type(type_).kind in PLAIN


_OWNER = ir.ValueType(ir.Kind.STRUCT, "owner")
