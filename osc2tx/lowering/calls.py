"""Calls of methods (§7.3.7): the library's, the scenario's own, and those of its types.

A method of the scenario becomes a method of its class, and so does one of a user's struct or actor,
or one added to a plain type: its first parameter then is the object, which is `it` in the body.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TypeAlias

from osc2tx import ir
from osc2tx.lowering.context import LoweringContext, Receiver
from osc2tx.lowering.expressions import lower_arguments, lower_expression, lower_type
from osc2tx.lowering.external import lower_external
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.semantics.model import Binding
from osc2tx.syntax import ast

CallNode: TypeAlias = ast.Call | ast.CallDirective

SELF = ir.ValueType(ir.Kind.STRUCT, "scenario")

# Methods of the library that make a value of their arguments; all others ask world or map.
PURE_METHODS = frozenset(
    {"environment.local_to_unix_time", "map.create_route"}
    | {f"map.create_{name}" for name in ("route_point", "xyz_point", "odr_point")}
    | {f"map.create_path{name}" for name in ("", "_odr_points", "_route_points")}
    | {f"map.create_trajectory{name}" for name in ("", "_odr_points", "_route_points")}
)


def lower_call(ctx: LoweringContext, node: CallNode) -> ir.Expression | None:
    """Lower a call; `None` if it was refused."""
    binding = ctx.model.bindings.get(node)
    callee = binding.callee if binding else None
    if binding is None or not isinstance(callee, sym.MethodSymbol):
        ctx.unsupported("OSC503", node.span, f"`{node.span.text}` is not supported here yet")
        return None
    if callee.origin == "builtin" and isinstance(node, ast.Call):
        return _lower_operator(ctx, node, binding, callee)
    if callee.origin == "user":
        return _lower_own(ctx, node, binding, callee)
    base = _receiver(ctx, node, binding.receiver)
    if base is None or callee.owner is None:
        return None
    return ir.MethodCall(
        span=node.span,
        type=lower_type(callee.result),
        base=base,
        owner=callee.owner.name,
        method=callee.name,
        arguments=lower_arguments(ctx, binding, node.arguments),
        is_pure=isinstance(callee.owner, sym.PrimitiveSymbol)
        or f"{callee.owner.name}.{callee.name}" in PURE_METHODS,
    )


def _lower_operator(
    ctx: LoweringContext, node: ast.Call, binding: Binding, callee: sym.MethodSymbol
) -> ir.Expression | None:
    """Lower an operator of lists or ranges."""
    base = None if binding.receiver is None else lower_expression(ctx, binding.receiver)
    if base is None or binding.receiver is None:
        return None
    type_ = lower_type(ctx.model.type_of(node))
    receiver = ctx.model.type_of(binding.receiver)
    if not isinstance(receiver, types.ListType):
        return ir.MethodCall(
            span=node.span,
            type=type_,
            base=base,
            owner="range",
            method=callee.name,
            arguments=(),
            is_pure=True,
        )
    argument = None
    depth = ctx.it.depth + 1 if isinstance(ctx.it, ir.Element) else 0
    if binding.arguments:
        ((_, value),) = binding.arguments
        element = ir.Element(span=node.span, type=lower_type(receiver.element), depth=depth)
        argument = lower_expression(ctx.with_it(element), value)
        if argument is None:
            return None
    operator = ir.ListOperator(callee.name)
    return ir.ListOperation(
        span=node.span, type=type_, base=base, operator=operator, argument=argument, depth=depth
    )


def _lower_own(
    ctx: LoweringContext, node: CallNode, binding: Binding, callee: sym.MethodSymbol
) -> ir.Expression | None:
    if callee.node is None or isinstance(callee.node.body, ast.UndefinedBody):
        ctx.unsupported(
            "OSC503",
            node.span,
            f"method `{callee.name}` is undefined",
            help="override it, `is only expression …`, in a type that extends this one",
        )
        return None
    arguments = lower_arguments(ctx, binding, node.arguments)
    if isinstance(callee.node.body, ast.ExternalBody):
        arguments = _in_order(ctx, callee, arguments)
    name = callee.name
    if not isinstance(callee.owner, sym.ScenarioSymbol):
        name = method_name(callee)
        base = _receiver(ctx, node, binding.receiver)
        if base is None:
            return None
        object_ = ir.Argument(parameter="", value=base, is_positional=True, span=base.span)
        arguments = (object_, *arguments)
        ctx.methods.setdefault(name, callee)
    return ir.MethodCall(
        span=node.span,
        type=lower_type(callee.result),
        base=ir.ScenarioSelf(span=node.span, type=SELF),
        owner="" if callee.owner is None else callee.owner.name,
        method=name,
        arguments=arguments,
        is_pure=is_pure(ctx, callee),
    )


def _in_order(
    ctx: LoweringContext, callee: sym.MethodSymbol, given: tuple[ir.Argument, ...]
) -> tuple[ir.Argument, ...]:
    """Return all arguments by position: code of the user may name its parameters as it likes."""
    by_name = {argument.parameter: argument for argument in given}
    ordered = []
    for parameter in callee.parameters:
        argument = by_name.get(parameter.name)
        if argument is None and parameter.default is not None:
            value = lower_expression(ctx, parameter.default)
            if value is None:
                continue
            argument = ir.Argument(
                parameter=parameter.name, value=value, is_positional=True, span=value.span
            )
        if argument is not None:
            ordered.append(replace(argument, is_positional=True))
    return tuple(ordered)


def method_name(method: sym.MethodSymbol) -> str:
    """Return the name of a type's method as a method of the scenario."""
    return method.name if method.owner is None else f"{method.owner.name}.{method.name}"


def is_pure(ctx: LoweringContext, method: sym.MethodSymbol) -> bool:
    """Whether a method computes its result from its arguments and from constants alone."""
    if method not in ctx.purity:
        ctx.purity[method] = False  # one that calls itself
        lowered = lower_method(ctx.quiet(), method)
        ctx.purity[method] = (
            lowered is not None
            and lowered.expression is not None
            and not ir.is_live(lowered.expression)
        )
    return ctx.purity[method]


def lower_method(
    ctx: LoweringContext, method: sym.MethodSymbol, comments: tuple[str, ...] = ()
) -> ir.Method | None:
    """Lower a method with a body; one of a type takes the object as its first parameter."""
    node = method.node
    if node is None or isinstance(node.body, ast.UndefinedBody):
        return None
    parameters = tuple(_parameter(ctx, parameter) for parameter in method.parameters)
    name = method.name
    if method.owner is not None and not isinstance(method.owner, sym.ScenarioSymbol):
        name = method_name(method)
        is_plain = isinstance(method.owner, sym.PrimitiveSymbol)
        own = ir.MethodParameter(
            name="value" if is_plain else method.owner.name,
            type=_type_of(method.owner),
            default=None,
        )
        parameters = (own, *parameters)
        it = ir.ParameterRef(span=node.span, type=own.type, name=own.name)
        ctx = ctx.inside(Receiver(method.owner, it))
    expression, external = None, None
    if isinstance(node.body, ast.ExternalBody):
        external = lower_external(ctx, method, node.body)
    else:
        expression = lower_expression(ctx, node.body.expression)
    if expression is None and external is None:
        return None
    return ir.Method(
        name=name,
        span=node.span,
        parameters=parameters,
        result=None if method.result == types.VOID else lower_type(method.result),
        expression=expression,
        external=external,
        comments=comments,
    )


def _parameter(ctx: LoweringContext, parameter: sym.ParameterSymbol) -> ir.MethodParameter:
    default = parameter.default
    return ir.MethodParameter(
        name=parameter.name,
        type=lower_type(parameter.type),
        default=None if default is None else lower_expression(ctx, default),
    )


def _type_of(owner: sym.TypeSymbol) -> ir.ValueType:
    match owner:
        case sym.ActorSymbol():
            return lower_type(types.ActorType(owner))
        case sym.PrimitiveSymbol(name=name) if name in types.PRIMITIVES:
            return lower_type(types.PRIMITIVES[name])
        case _:
            return ir.ValueType(ir.Kind.STRUCT, owner.name)


def _receiver(
    ctx: LoweringContext, node: CallNode, receiver: ast.Expression | None
) -> ir.Expression | None:
    """Return the object of a call; without one it is the object around the call."""
    if receiver is not None:
        return lower_expression(ctx, receiver)
    if ctx.receiver is not None:
        return ctx.receiver.value
    return ir.ScenarioSelf(span=node.span, type=SELF)
