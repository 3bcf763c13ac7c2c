"""Conditions of conditional inheritance (§7.3.8.3)."""

from __future__ import annotations

from osc2tx.diagnostics.suggestions import name_meant
from osc2tx.semantics.assignability import check_value
from osc2tx.semantics.names.member_lookup import find_member, member_names
from osc2tx.semantics.resolution import Environment, Resolution, declared_here
from osc2tx.semantics.scope import Context
from osc2tx.semantics.symbols import (
    ActionSymbol,
    ActorSymbol,
    FieldSymbol,
    ScenarioSymbol,
    StructSymbol,
    TypeSymbol,
)
from osc2tx.semantics.types import BOOL, ERROR, EnumType
from osc2tx.syntax import ast


def check_inheritance_condition(r: Resolution, symbol: TypeSymbol) -> None:
    """Check `inherits base(field == value)`: a bool or enum field, and a literal."""
    if not isinstance(symbol, StructSymbol | ActorSymbol | ScenarioSymbol | ActionSymbol):
        return
    condition = symbol.condition
    if condition is None or symbol.base is None:
        return
    node = r.scope.nodes.get(symbol)
    context = r.scope.contexts.get(node, Context()) if node else Context()
    field = find_member(r, symbol.base, condition.field, context)
    if field is None:
        r.report(
            "OSC208",
            condition.field.span,
            f"`{symbol.base.name}` has no field `{condition.field}`",
            help=name_meant(condition.field.span, member_names(symbol.base)),
        )
        return
    r.references[condition.field] = field
    if not isinstance(field, FieldSymbol) or not (
        field.type in (BOOL, ERROR) or isinstance(field.type, EnumType)
    ):
        r.report(
            "OSC308",
            condition.field.span,
            f"`{condition.field}` is not a field of type bool or an enum",
            labels=declared_here(field),
        )
        return
    _check_literal(r, condition.value, field, Environment(context))


def _check_literal(
    r: Resolution,
    value: ast.EnumLiteral | ast.NameExpression | ast.BoolLiteral,
    field: FieldSymbol,
    env: Environment,
) -> None:
    if field.type == BOOL and isinstance(value, ast.NameExpression):
        r.report("OSC308", value.span, "the condition must be `true` or `false`")
        return
    check_value(r, value, field.type, env, f"`{field.name}`")
