"""Calls of methods (§7.3.7): of the library, of the scenario, and of its types."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

from osc2tx import ir
from osc2tx.lowering.behavior.composed_behaviors import is_composed
from osc2tx.lowering.context import LoweringContext, Receiver
from osc2tx.lowering.value_types import SCENARIO, lower_type
from osc2tx.lowering.values.arguments import lower_arguments
from osc2tx.lowering.values.method_kinds import listed_arguments
from osc2tx.lowering.values.methods import default_of, is_pure, method_name
from osc2tx.lowering.values.shape_arguments import is_left_open
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.semantics.model import Binding
from osc2tx.syntax import ast
from osc2tx_shared.classes import replace

CallNode: TypeAlias = ast.Call | ast.CallDirective

# Methods of the library that compute a value of their arguments; all others read world or map.
PURE_METHODS = frozenset(
    {"environment.local_to_unix_time", "map.create_route"}
    | {f"map.create_{name}" for name in ("route_point", "xyz_point", "odr_point")}
    | {f"map.create_path{name}" for name in ("", "_odr_points", "_route_points")}
    | {f"map.create_trajectory{name}" for name in ("", "_odr_points", "_route_points")}
    | {f"any_{kind}_shape.compute" for kind in ("acceleration", "lateral", "position", "speed")}
    | {"any_shape.duration"}
    | {"position_3d.norm", "translational_velocity_3d.norm", "translational_acceleration_3d.norm"}
)

# Of these the ones that do not read their object.
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
    base = None if binding.receiver is None else ctx.lower(binding.receiver)
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
        argument = ctx.with_it(element).lower(value)
        if argument is None:
            return None
    operator = ir.ListOperator(callee.name)
    return ir.ListOperation(
        span=node.span, type=type_, base=base, operator=operator, argument=argument, depth=depth
    )


def _lower_own(
    ctx: LoweringContext, node: CallNode, binding: Binding, callee: sym.MethodSymbol
) -> ir.Expression | None:
    arguments = lower_arguments(ctx, binding, node.arguments)
    if callee.node is not None and isinstance(callee.node.body, ast.ExternalBody):
        arguments = _in_order(ctx, callee, arguments)
    if isinstance(callee.owner, sym.ModifierSymbol):
        arguments += tuple(_late_defaults(ctx, callee, arguments))
        return _in_place(ctx, node, callee, arguments)
    name, inside = callee.name, ctx
    is_of_type = callee.owner is not None and not is_composed(callee.owner)
    if is_of_type and callee.node is not None and listed_arguments(callee.node.body):
        name = method_name(callee)
        ctx.state.methods.setdefault(name, callee)
    elif is_of_type and callee.owner is not None:
        name = method_name(callee)
        base = _receiver(ctx, node, binding.receiver)
        if base is None:
            return None
        inside = ctx.inside(Receiver(callee.owner, base))
        object_ = ir.Argument(parameter="", value=base, is_positional=True, span=base.span)
        arguments = (object_, *arguments)
        ctx.state.methods.setdefault(name, callee)
    arguments += tuple(_late_defaults(inside, callee, arguments))
    return ir.MethodCall(
        span=node.span,
        type=lower_type(callee.result),
        base=ir.ScenarioSelf(span=node.span, type=SCENARIO),
        owner="" if callee.owner is None else callee.owner.name,
        method=name,
        arguments=arguments,
        is_pure=is_pure(ctx, callee),
    )


def _late_defaults(
    ctx: LoweringContext, callee: sym.MethodSymbol, given: tuple[ir.Argument, ...]
) -> Iterator[ir.Argument]:
    """Yield the arguments left out by a call, which only the call can compute (§7.3.7)."""
    names = {argument.parameter for argument in given}
    for parameter in callee.parameters:
        if parameter.name in names or parameter.default is None or default_of(ctx, parameter):
            continue
        value = ctx.lower(parameter.default)
        if value is not None:
            yield ir.Argument(
                parameter=parameter.name, value=value, is_positional=False, span=value.span
            )


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
    ctx = ctx.in_method(callee.name)
    for argument in _in_order(ctx, callee, given):
        ctx = ctx.with_local(argument.parameter, argument.value)
    return ctx.lower(body.expression)


def _report_undefined(ctx: LoweringContext, node: CallNode, callee: sym.MethodSymbol) -> None:
    ctx.unsupported(
        "OSC503",
        node.span,
        f"method `{callee.name}` is undefined",
        help="override it, `is only expression …`, in a type that extends this one",
    )


def _in_order(
    ctx: LoweringContext, callee: sym.MethodSymbol, given: tuple[ir.Argument, ...]
) -> tuple[ir.Argument, ...]:
    """Return all arguments by position: code of the user may name its parameters freely."""
    by_name = {argument.parameter: argument for argument in given}
    ordered = []
    for parameter in callee.parameters:
        argument = by_name.get(parameter.name)
        if argument is None and parameter.default is not None:
            value = ctx.lower(parameter.default)
            if value is None:
                continue
            argument = ir.Argument(
                parameter=parameter.name, value=value, is_positional=True, span=value.span
            )
        if argument is not None:
            ordered.append(replace(argument, is_positional=True))
    return tuple(ordered)


def _receiver(
    ctx: LoweringContext, node: CallNode, receiver: ast.Expression | None
) -> ir.Expression | None:
    """Return the object of a call; without one it is the object around the call."""
    if receiver is not None:
        return ctx.lower(receiver)
    if ctx.receiver is not None:
        return ctx.receiver.value
    return ir.ScenarioSelf(span=node.span, type=SCENARIO)
