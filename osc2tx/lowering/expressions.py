"""Expressions: names become references to what they stand for, types become plain data."""

from __future__ import annotations

from collections.abc import Sequence
from typing import assert_never

from osc2tx import ir
from osc2tx.lowering.context import LoweringContext, present
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.semantics.model import Binding
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
        case types.ListType():
            return ir.ValueType(ir.Kind.LIST, str(type_))
        case types.RangeType():
            return ir.ValueType(ir.Kind.RANGE, str(type_))
        case _:
            return ir.ValueType(ir.Kind.STRUCT, str(type_))


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
            unit = ctx.model.units[node]
            is_standard = unit.origin == "library"
            lowered = ir.Unit(unit.name, unit.factor, unit.offset, is_standard)
            return ir.Quantity(span=span, type=type_, value=number, unit=lowered)
        case ast.EnumLiteral() | ast.NameExpression():
            return _lower_name(ctx, node, type_)
        case ast.MemberAccess(base=base, name=name):
            return _lower_member(ctx, node, base, name, type_)
        case ast.Call():
            return _lower_call(ctx, node, type_)
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
            parts = [lower_expression(ctx, element) for element in elements]
            return ir.ListValue(span=span, type=type_, elements=present(parts))
        case ast.RangeLiteral(lower=lower, upper=upper):
            bounds = lower_expression(ctx, lower), lower_expression(ctx, upper)
            if bounds[0] is None or bounds[1] is None:
                return None
            return ir.RangeValue(span=span, type=type_, lower=bounds[0], upper=bounds[1])
        case ast.ItExpression() | ast.Cast() | ast.TypeTest() | ast.Index():
            ctx.unsupported("OSC503", span, "this expression is not supported here yet")
            return None
        case _:
            assert_never(node)


def _lower_name(
    ctx: LoweringContext, node: ast.EnumLiteral | ast.NameExpression, type_: ir.ValueType
) -> ir.Expression | None:
    match ctx.model.symbol_of(node):
        case sym.EnumMemberSymbol(name=name, value=value, enum=enum):
            enum_type = ir.ValueType(ir.Kind.ENUM, enum.name)
            return ir.EnumValue(span=node.span, type=enum_type, member=name, value=value)
        case sym.FieldSymbol(node=None, name="actor"):
            return ir.FieldRef(span=node.span, type=type_, name="actor")
        case sym.FieldSymbol(owner=sym.ScenarioSymbol(), name=name) as own:
            changes = isinstance(own.default, ast.SampleExpression)
            return ir.FieldRef(span=node.span, type=type_, name=name, is_variable=changes)
        case sym.FieldSymbol(owner=None, name=name) as shared if shared.node is not None:
            ctx.globals.setdefault(name, shared)
            return ir.FieldRef(span=node.span, type=type_, name=name)
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
    lowered = lower_expression(ctx, base)
    if lowered is None:
        return None
    return ir.Attribute(
        span=node.span,
        type=type_,
        base=lowered,
        owner=field.owner.name if field.owner is not None else "",
        name=field.name,  # not as written: a dialect may know it by another name
        is_variable=field.is_variable,
    )


def _lower_call(ctx: LoweringContext, node: ast.Call, type_: ir.ValueType) -> ir.Expression | None:
    binding = ctx.model.bindings.get(node)
    callee = binding.callee if binding else None
    if binding is None or not isinstance(callee, sym.MethodSymbol) or callee.owner is None:
        ctx.unsupported("OSC503", node.span, f"`{node.callee.span.text}` is not supported here yet")
        return None
    if callee.origin == "user" and not is_own_method(callee):
        ctx.unsupported(
            "OSC503",
            node.span,
            f"method `{callee.name}` cannot be called yet",
            help="only methods of the scenario itself, with an expression as body, are supported",
        )
        return None
    base = _lower_receiver(ctx, node, binding.receiver)
    if base is None:
        return None
    return ir.MethodCall(
        span=node.span,
        type=type_,
        base=base,
        owner=callee.owner.name,
        method=callee.name,
        arguments=lower_arguments(ctx, binding, node.arguments),
    )


def is_own_method(method: sym.MethodSymbol) -> bool:
    """Whether a method belongs to a scenario and is an expression."""
    return (
        isinstance(method.owner, sym.ScenarioSymbol)
        and method.node is not None
        and isinstance(method.node.body, ast.ExpressionBody)
    )


def _lower_receiver(
    ctx: LoweringContext, node: ast.Call, receiver: ast.Expression | None
) -> ir.Expression | None:
    if receiver is None or isinstance(receiver, ast.ItExpression):
        return ir.ScenarioSelf(span=node.span, type=ir.ValueType(ir.Kind.STRUCT, "scenario"))
    return lower_expression(ctx, receiver)


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
        left = ir.Binary(
            span=current.span,
            type=lower_type(ctx.model.type_of(current)),
            operator=current.operator.value,
            left=left,
            right=right,
        )
    return left


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
