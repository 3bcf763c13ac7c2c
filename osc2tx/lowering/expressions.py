"""Expressions: names become references to what they stand for, types become plain data."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import assert_never

from osc2tx import ir
from osc2tx.analysis.tape import Key
from osc2tx.diagnostics import Span
from osc2tx.lowering.context import LoweringContext
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.semantics.model import Binding
from osc2tx.semantics.scope import supertypes
from osc2tx.syntax import ast

PRIMITIVE_KINDS = {
    "bool": ir.Kind.BOOL,
    "int": ir.Kind.INTEGER,
    "uint": ir.Kind.INTEGER,
    "float": ir.Kind.FLOAT,
    "string": ir.Kind.STRING,
}


def lower_type(type_: types.Type) -> ir.ValueType:
    """Return the IR's view of a type."""
    match type_:
        case types.PrimitiveType(name=name):
            return ir.ValueType(PRIMITIVE_KINDS[name], name)
        case types.PhysicalType():
            return ir.ValueType(ir.Kind.QUANTITY, str(type_))
        case types.EnumType():
            return ir.ValueType(ir.Kind.ENUM, str(type_))
        case types.ActorType():
            return ir.ValueType(ir.Kind.ACTOR, str(type_))
        case types.ListType(element=element):
            return ir.ValueType(ir.Kind.LIST, str(type_), lower_type(element))
        case types.RangeType(element=element):
            return ir.ValueType(ir.Kind.RANGE, str(type_), lower_type(element))
        case _:
            return ir.ValueType(ir.Kind.STRUCT, str(type_))


def lower_unit(unit: sym.UnitSymbol) -> ir.Unit:
    """Return the IR's view of a unit."""
    return ir.Unit(unit.name, unit.factor, unit.offset, is_standard=unit.origin == "library")


def lower_expression(ctx: LoweringContext, node: ast.Expression) -> ir.Expression | None:
    """Lower an expression; `None` if a part of it was refused."""
    span, type_ = node.span, lower_type(ctx.model.type_of(node))
    match node:
        case (
            ast.BoolLiteral(value=value)
            | ast.IntegerLiteral(value=value)
            | ast.FloatLiteral(value=value)
            | ast.StringLiteral(value=value)
        ):
            return ir.Literal(span=span, type=type_, value=value)
        case ast.PhysicalLiteral(value=number):
            unit = lower_unit(ctx.model.units[node])
            return ir.Quantity(span=span, type=type_, value=number, unit=unit)
        case ast.EnumLiteral() | ast.NameExpression():
            return _lower_name(ctx, node, type_)
        case ast.MemberAccess(base=base, name=name):
            return _lower_member(ctx, node, base, name, type_)
        case ast.Call() | ast.Cast() | ast.TypeTest():
            return _lower_beyond(ctx, node)
        case ast.Index(base=base, index=index):
            lowered, which = lower_expression(ctx, base), lower_expression(ctx, index)
            if lowered is None or which is None:
                return None
            return ir.Index(span=span, type=type_, base=lowered, index=which)
        case ast.Unary(operator=operator, operand=operand):
            inner = lower_expression(ctx, operand)
            if inner is None:
                return None
            return ir.Unary(span=span, type=type_, operator=operator.value, operand=inner)
        case ast.Binary():
            return _lower_binary(ctx, node)
        case ast.Conditional():
            return _lower_conditional(ctx, node, type_)
        case ast.ListLiteral(elements=elements):
            parts: list[ir.Expression] = []
            for element in elements:
                part = lower_expression(ctx, element)
                if part is None:
                    return None
                parts.extend(part.elements if isinstance(part, ir.ListValue) else [part])
            return ir.ListValue(span=span, type=type_, elements=tuple(parts))
        case ast.RangeLiteral(lower=lower, upper=upper):
            bounds = lower_expression(ctx, lower), lower_expression(ctx, upper)
            if bounds[0] is None or bounds[1] is None:
                return None
            return ir.RangeValue(span=span, type=type_, lower=bounds[0], upper=bounds[1])
        case ast.ItExpression() if ctx.it is not None:
            return replace(ctx.it, span=span)
        case ast.ItExpression() if ctx.place is not None and ctx.place.it is not None:
            return lower_key(ctx, ctx.place.it, span)
        case ast.ItExpression():
            return ir.ScenarioSelf(span=span, type=type_)
        case _:
            assert_never(node)


def _lower_beyond(
    ctx: LoweringContext, node: ast.Call | ast.Cast | ast.TypeTest
) -> ir.Expression | None:
    """Lower what is made of expressions itself: modules that import this one."""
    from osc2tx.lowering.calls import lower_call
    from osc2tx.lowering.casts import lower_cast, lower_type_test

    match node:
        case ast.Call():
            return lower_call(ctx, node)
        case ast.Cast():
            return lower_cast(ctx, node)
        case ast.TypeTest():
            return lower_type_test(ctx, node)


def _lower_name(
    ctx: LoweringContext, node: ast.EnumLiteral | ast.NameExpression, type_: ir.ValueType
) -> ir.Expression | None:
    match ctx.model.symbol_of(node):
        case sym.EnumMemberSymbol(value=value, enum=enum):
            # Members of equal value are one (§7.3.3): the first of them stands for all.
            name = next(m.name for m in enum.members.values() if m.value == value)
            enum_type = ir.ValueType(ir.Kind.ENUM, enum.name)
            return ir.EnumValue(span=node.span, type=enum_type, member=name, value=value)
        case sym.FieldSymbol(node=None, name="actor") if ctx.actor is not None:
            return replace(ctx.actor, span=node.span)
        case sym.FieldSymbol() if (given := _given(ctx, node)) is not None:
            return replace(given, span=node.span)
        case sym.FieldSymbol(node=None, name="actor"):
            return ir.FieldRef(span=node.span, type=type_, name="actor")
        case sym.FieldSymbol() as member if (base := _base_of(ctx, member)) is not None:
            return member_of(ctx, base, member, node.span)
        case sym.FieldSymbol(owner=sym.ScenarioSymbol(), name=name) as own:
            changes = isinstance(own.default, ast.SampleExpression)
            return ir.FieldRef(span=node.span, type=type_, name=name, is_variable=changes)
        case sym.FieldSymbol(owner=None, name=name) as shared if shared.node is not None:
            ctx.globals.setdefault(name, shared)
            return ir.FieldRef(span=node.span, type=type_, name=name)
        case sym.ParameterSymbol(name=name) if name in ctx.locals:
            return replace(ctx.locals[name], span=node.span)
        case sym.ParameterSymbol(name=name):
            return ir.ParameterRef(span=node.span, type=type_, name=name)
        case _:
            ctx.unsupported("OSC503", node.span, f"`{node.span.text}` cannot be used here yet")
            return None


def _lower_member(
    ctx: LoweringContext,
    node: ast.MemberAccess,
    base: ast.Expression,
    name: ast.Name,
    type_: ir.ValueType,
) -> ir.Expression | None:
    event = ctx.event_fields.get(id(ctx.model.symbol_of(base)))
    if event is not None:
        return ir.EventArgument(span=node.span, type=type_, event=event, parameter=name.text)
    field = ctx.model.symbol_of(node)
    if not isinstance(field, sym.FieldSymbol):
        ctx.unsupported("OSC503", node.span, f"`{node.span.text}` cannot be used here yet")
        return None
    key = ctx.place.locate(node) if ctx.place is not None else None
    if key is not None and not isinstance(key[0], sym.FieldSymbol):
        return lower_key(ctx, key, node.span)
    lowered = lower_expression(ctx, base)
    return None if lowered is None else member_of(ctx, lowered, field, node.span)


def member_of(
    ctx: LoweringContext, base: ir.Expression, field: sym.FieldSymbol, span: Span
) -> ir.Expression:
    """Return a field of an object."""
    type_ = lower_type(field.type)
    if isinstance(base, ir.ScenarioSelf):
        return ir.FieldRef(span=span, type=type_, name=field.name)
    return ir.Attribute(
        span=span,
        type=type_,
        base=base,
        owner=field.owner.name if field.owner is not None else "",
        name=field.name,  # not as written: a dialect may know it by another name
        is_variable=field.is_variable,
    )


def lower_key(ctx: LoweringContext, key: Key, span: Span) -> ir.Expression | None:
    """Return what a path of the analysis stands for; an empty one is the scenario itself."""
    if not key:
        return ir.ScenarioSelf(span=span, type=ir.ValueType(ir.Kind.STRUCT, "scenario"))
    first, *rest = key
    expression: ir.Expression
    if isinstance(first, sym.FieldSymbol):
        if first.owner is None and first.node is not None:
            ctx.globals.setdefault(first.name, first)
        expression = ir.FieldRef(span=span, type=lower_type(first.type), name=first.name)
    elif lengths := [n for n in range(2, len(key) + 1) if key[:n] in ctx.given]:
        expression, rest = ctx.given[key[: lengths[0]]], list(key[lengths[0] :])
    else:
        ctx.unsupported(
            "OSC502", span, "this constraint is about something that has no value of its own"
        )
        return None
    for field in rest:
        if isinstance(field, sym.FieldSymbol):
            expression = member_of(ctx, expression, field, span)
    return expression


def _given(ctx: LoweringContext, node: ast.Expression) -> ir.Expression | None:
    """Return the value of a parameter of an invocation or modifier, in what that says."""
    key = None if ctx.place is None else ctx.place.locate(node)
    return None if key is None else ctx.given.get(key)


def _base_of(ctx: LoweringContext, field: sym.FieldSymbol) -> ir.Expression | None:
    """Return the object whose member a plain name means, if that is not the scenario."""
    place, receiver = ctx.place, ctx.receiver
    if receiver and field.owner and field.owner in supertypes(receiver.owner):
        return receiver.value
    if place is None or field.owner is None:
        return None
    if place.owner is not None and field.owner in supertypes(place.owner):
        return lower_key(ctx, place.prefix, field.span) if place.prefix else None
    if place.it and place.it_type and field.owner in supertypes(place.it_type):
        return lower_key(ctx, place.it, field.span)
    return None


def lower_arguments(
    ctx: LoweringContext, binding: Binding, written: Sequence[ast.Argument]
) -> tuple[ir.Argument, ...]:
    """Lower the arguments of a call, each with the parameter it is for."""
    nodes = {id(argument.value): argument for argument in written}
    lowered = []
    for parameter, value in binding.arguments:
        expression = lower_expression(ctx, value)
        argument = nodes.get(id(value))
        if expression is not None:
            lowered.append(
                ir.Argument(
                    parameter=parameter.name,
                    value=expression,
                    is_positional=argument is not None and argument.name is None,
                    span=argument.span if argument else value.span,
                )
            )
    return tuple(lowered)


def _lower_binary(ctx: LoweringContext, node: ast.Binary) -> ir.Expression | None:
    """Lower a chain of operators; its left spine may be long, so it is walked in a loop."""
    spine = [node]
    while isinstance(spine[-1].left, ast.Binary):
        spine.append(spine[-1].left)
    left = lower_expression(ctx, spine[-1].left)
    for current in reversed(spine):
        right = lower_expression(ctx, current.right)
        if left is None or right is None:
            return None
        known = _known_logic(current.operator, left, right)
        if known is not None:
            left = known
            continue
        left = ir.Binary(
            span=current.span,
            type=lower_type(ctx.model.type_of(current)),
            operator=current.operator.value,
            left=left,
            right=right,
        )
    return left


def _known_logic(
    operator: ast.BinaryOperator, left: ir.Expression, right: ir.Expression
) -> ir.Expression | None:
    """Return what `and` or `or` comes to if one side is known when compiling, such as `.is(T)`."""
    if operator not in (ast.BinaryOperator.AND, ast.BinaryOperator.OR):
        return None
    decisive = operator is ast.BinaryOperator.OR
    for side, other in ((left, right), (right, left)):
        if isinstance(side, ir.Literal) and isinstance(side.value, bool):
            return side if side.value is decisive else other
    return None


def _lower_conditional(
    ctx: LoweringContext, node: ast.Conditional, type_: ir.ValueType
) -> ir.Expression | None:
    condition = lower_expression(ctx, node.condition)
    when_true = lower_expression(ctx, node.when_true)
    when_false = lower_expression(ctx, node.when_false)
    if condition is None or when_true is None or when_false is None:
        return None
    return ir.Conditional(
        span=node.span, type=type_, condition=condition, when_true=when_true, when_false=when_false
    )
