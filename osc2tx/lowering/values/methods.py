"""Declarations of methods (§7.3.7): bodies, defaults, purity, and overriding ones.

A method of the scenario becomes a method of its class, and so does one of a user's struct or actor,
or one added to a plain type: its first parameter then is the object, which is `it` in the body.
The object decides which of several overriding methods a call means: the method of the general type
tests the object, and calls the one of its type.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from osc2tx import ir
from osc2tx.lowering.behavior.composed_behaviors import is_composed
from osc2tx.lowering.context import LoweringContext, Receiver
from osc2tx.lowering.value_types import BOOL, SCENARIO, lower_type
from osc2tx.lowering.values.method_kinds import lower_external, overriding_methods
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.syntax import ast


def method_name(method: sym.MethodSymbol) -> str:
    """Return the name of a type's method as a method of the scenario."""
    return method.name if method.owner is None else f"{method.owner.name}.{method.name}"


def is_pure(ctx: LoweringContext, method: sym.MethodSymbol) -> bool:
    """Whether a method computes its result from its arguments and from constants alone."""
    if method not in ctx.used.purity:
        known = set(ctx.used.purity)
        ctx.used.purity[method] = True  # a recursive method is as pure as the rest of it
        lowered = lower_method(ctx.quiet(), method)
        ctx.used.purity[method] = (
            lowered is not None
            and lowered.expression is not None
            and not ir.is_live(lowered.expression)
        )
        if not ctx.used.purity[method]:
            for other in ctx.used.purity.keys() - known - {method}:
                del ctx.used.purity[other]  # found out by a wrong assumption
    return ctx.used.purity[method]


def lower_method(
    ctx: LoweringContext, method: sym.MethodSymbol, comments: tuple[str, ...] = ()
) -> ir.Method | None:
    """Lower a method with a body; one of a type takes the object as its first parameter."""
    node = method.node
    overriding = overriding_methods(ctx, method)
    if node is None:
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
        expression = ctx.lower(node.body.expression)
    elif not overriding:
        type_ = lower_type(method.result)
        expression = ir.Undefined(span=node.span, type=type_, method=method.name)
    if expression is None and external is None and not is_undefined(method):
        return None
    if overriding and ctx.receiver is not None:
        expression = _dispatched(ctx, ctx.receiver.value, parameters, overriding, expression)
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
        name=parameter.name, type=lower_type(parameter.type), default=default_of(ctx, parameter)
    )


def _type_of(owner: sym.TypeSymbol) -> ir.ValueType:
    match owner:
        case sym.ActorSymbol():
            return lower_type(types.ActorType(owner))
        case sym.PrimitiveSymbol(name=name) if name in types.PRIMITIVES:
            return lower_type(types.PRIMITIVES[name])
        case _:
            return ir.ValueType(ir.Kind.STRUCT, owner.name)


def is_undefined(method: sym.MethodSymbol) -> bool:
    """Whether a method has no body."""
    return method.node is None or isinstance(method.node.body, ast.UndefinedBody)


def default_of(ctx: LoweringContext, parameter: sym.ParameterSymbol) -> ir.Expression | None:
    """Return the default of a parameter if the function itself can have it: a constant."""
    if parameter.default is None:
        return None
    lowered = ctx.quiet().lower(parameter.default)
    late = (ir.FieldRef, ir.ParameterRef, ir.ScenarioSelf)
    if lowered is None or any(isinstance(part, late) for part in ir.walk(lowered)):
        return None
    return None if ir.is_live(lowered) else lowered


def _dispatched(
    ctx: LoweringContext,
    object_: ir.Expression,
    arguments: Sequence[ir.MethodParameter],
    overriding: Iterable[sym.MethodSymbol],
    body: ir.Expression | None,
) -> ir.Expression | None:
    """Return the body of a method that other types override.

    Args:
        ctx: The checked program.
        object_: The object.
        arguments: The parameters of the method, the object first.
        overriding: The other methods, those of the most special types first.
        body: The body for all other objects; `None` if that is undefined.
    """
    result = body
    for method in reversed(tuple(overriding)):
        assert isinstance(method.owner, sym.ActorSymbol | sym.StructSymbol)
        special = _type_of(method.owner)
        call = _call(ctx, method, object_, special, arguments, is_certain=result is not None)
        if result is None:
            result = call  # for objects of no such type it is an error
            continue
        test = ir.TypeTest(span=object_.span, type=BOOL, operand=object_, tested=method.owner.name)
        result = ir.Conditional(
            span=call.span, type=call.type, condition=test, when_true=call, when_false=result
        )
    return result


def _call(
    ctx: LoweringContext,
    method: sym.MethodSymbol,
    object_: ir.Expression,
    special: ir.ValueType,
    parameters: Sequence[ir.MethodParameter],
    *,
    is_certain: bool,
) -> ir.MethodCall:
    span = object_.span
    if not is_certain:
        object_ = ir.Downcast(span=span, type=special, operand=object_)
    given = (
        object_,
        *(ir.ParameterRef(span=span, type=p.type, name=p.name) for p in parameters[1:]),
    )
    name = method_name(method)
    ctx.state.methods.setdefault(name, method)
    return ir.MethodCall(
        span=span,
        type=lower_type(method.result),
        base=ir.ScenarioSelf(span=span, type=SCENARIO),
        owner=method.owner.name if method.owner is not None else "",
        method=name,
        arguments=tuple(
            ir.Argument(parameter="", value=value, is_positional=True, span=span) for value in given
        ),
        is_pure=is_pure(ctx, method),
    )
