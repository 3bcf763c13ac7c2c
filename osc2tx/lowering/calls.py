"""Calls of methods (§7.3.7): the library's, the scenario's own, and those of its types.

A method of the scenario becomes a method of its class, and so does one of a user's struct or actor,
or one added to a plain type: its first parameter then is the object, which is `it` in the body.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TypeAlias

from osc2tx import ir
from osc2tx.lowering.composed_behaviors import is_composed
from osc2tx.lowering.context import LoweringContext, Receiver
from osc2tx.lowering.expressions import lower_arguments, lower_expression
from osc2tx.lowering.external import lower_external
from osc2tx.lowering.method_overriding import dispatched, overriding_methods
from osc2tx.lowering.shape_arguments import is_left_open
from osc2tx.lowering.value_types import lower_type
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
    | {f"any_{kind}_shape.compute" for kind in ("acceleration", "lateral", "position", "speed")}
    | {"any_shape.duration"}
    | {"position_3d.norm", "translational_velocity_3d.norm", "translational_acceleration_3d.norm"}
)

# Of these the ones that ask not even their object.
STATIC_METHODS = frozenset({"environment.local_to_unix_time"})


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
    if binding.receiver is not None and is_left_open(ctx, callee, binding.receiver):
        _report_undefined(ctx, node, callee)
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
        needs_no_object=f"{callee.owner.name}.{callee.name}" in STATIC_METHODS,
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
    if _is_undefined(callee) and not overriding_methods(ctx, callee):
        _report_undefined(ctx, node, callee)
        return None
    arguments = lower_arguments(ctx, binding, node.arguments)
    if callee.node is not None and isinstance(callee.node.body, ast.ExternalBody):
        arguments = _in_order(ctx, callee, arguments)
    if isinstance(callee.owner, sym.ModifierSymbol):
        arguments += tuple(_late_defaults(ctx, callee, arguments))
        return _in_place(ctx, node, callee, arguments)
    name, inside = callee.name, ctx
    if not is_composed(callee.owner) and callee.owner is not None:
        name = method_name(callee)
        base = _receiver(ctx, node, binding.receiver)
        if base is None:
            return None
        inside = ctx.inside(Receiver(callee.owner, base))
        object_ = ir.Argument(parameter="", value=base, is_positional=True, span=base.span)
        arguments = (object_, *arguments)
        ctx.methods.setdefault(name, callee)
    arguments += tuple(_late_defaults(inside, callee, arguments))
    return ir.MethodCall(
        span=node.span,
        type=lower_type(callee.result),
        base=ir.ScenarioSelf(span=node.span, type=SELF),
        owner="" if callee.owner is None else callee.owner.name,
        method=name,
        arguments=arguments,
        is_pure=is_pure(ctx, callee),
    )


def _late_defaults(
    ctx: LoweringContext, callee: sym.MethodSymbol, given: tuple[ir.Argument, ...]
) -> Iterator[ir.Argument]:
    """Yield what a call leaves out and only the call can compute (§7.3.7)."""
    names = {argument.parameter for argument in given}
    for parameter in callee.parameters:
        if parameter.name in names or parameter.default is None or _default(ctx, parameter):
            continue
        value = lower_expression(ctx, parameter.default)
        if value is not None:
            yield ir.Argument(
                parameter=parameter.name, value=value, is_positional=False, span=value.span
            )


def _default(ctx: LoweringContext, parameter: sym.ParameterSymbol) -> ir.Expression | None:
    """Return the default of a parameter if the function itself can have it: a constant."""
    if parameter.default is None:
        return None
    lowered = lower_expression(ctx.quiet(), parameter.default)
    late = (ir.FieldRef, ir.ParameterRef, ir.ScenarioSelf)
    if lowered is None or any(isinstance(part, late) for part in ir.walk(lowered)):
        return None
    return None if ir.is_live(lowered) else lowered


def _in_place(
    ctx: LoweringContext,
    node: CallNode,
    callee: sym.MethodSymbol,
    given: tuple[ir.Argument, ...],
) -> ir.Expression | None:
    """Return the body of a modifier's method: like the modifier, it belongs to one invocation."""
    body = None if callee.node is None else callee.node.body
    if not isinstance(body, ast.ExpressionBody) or callee.name in ctx.expanding:
        ctx.unsupported(
            "OSC503",
            node.span,
            f"`{callee.name}` of a modifier is no plain expression",
            help="declare it in the scenario",
        )
        return None
    ctx = replace(ctx, expanding=(*ctx.expanding, callee.name))
    for argument in _in_order(ctx, callee, given):
        ctx = ctx.with_local(argument.parameter, argument.value)
    return lower_expression(ctx, body.expression)


def _report_undefined(ctx: LoweringContext, node: CallNode, callee: sym.MethodSymbol) -> None:
    ctx.unsupported(
        "OSC503",
        node.span,
        f"method `{callee.name}` is undefined",
        help="override it, `is only expression …`, in a type that extends this one",
    )


def _is_undefined(method: sym.MethodSymbol) -> bool:
    return method.node is None or isinstance(method.node.body, ast.UndefinedBody)


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
    overriding = overriding_methods(ctx, method)
    if node is None or (_is_undefined(method) and not overriding):
        return None
    parameters = tuple(_parameter(ctx, parameter) for parameter in method.parameters)
    name = method.name
    if method.owner is not None and not is_composed(method.owner):
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
    elif isinstance(node.body, ast.ExpressionBody):
        expression = lower_expression(ctx, node.body.expression)
    if expression is None and external is None and not _is_undefined(method):
        return None
    if overriding and ctx.receiver is not None:
        expression = dispatched(ctx, ctx.receiver.value, parameters, overriding, expression)
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
    return ir.MethodParameter(
        name=parameter.name, type=lower_type(parameter.type), default=_default(ctx, parameter)
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
