"""Walks over expressions of the IR."""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterable, Mapping
from dataclasses import fields
from math import inf
from types import MappingProxyType
from typing import Any, TypeAlias

from osc2tx.ir import expressions as expr
from osc2tx.ir.behaviors import ModifierCall
from osc2tx.ir.expressions import Expression
from osc2tx.ir.values import ExpressionBase
from osc2tx_shared.classes import replace

Bounds: TypeAlias = tuple[float, float]

OPERATIONS: Mapping[str, Callable[[float, float], float]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
}


def constant(expression: Expression) -> float | None:
    """Return the value of an expression of numbers alone; `None` if it has others in it."""
    found = bounds(expression)
    return None if found is None else found[0]


def bounds(
    expression: Expression, values: Mapping[str, Expression] = MappingProxyType({})
) -> Bounds | None:
    """Return the least and the greatest value of an expression of numbers; `None` if unknown.

    Args:
        expression: The expression.
        values: Values and domains of parameters, by name.
    """
    found: list[Bounds] = []
    for part in _postfix(expression):
        match part:
            case expr.Literal(value=int() | float() as value) if not isinstance(value, bool):
                found.append((value, value))
            case expr.Quantity():
                found.append((part.si, part.si))
            case expr.FieldRef(name=name) if name in values:
                of_parameter = _bounds_of_domain(values[name])
                if of_parameter is None:
                    return None
                found.append(of_parameter)
            case expr.Unary(operator="-"):
                low, high = found.pop()
                found.append((-high, -low))
            case expr.Binary(operator=sign) if sign in OPERATIONS:
                right, left = found.pop(), found.pop()
                if sign == "/" and right[0] <= 0.0 <= right[1]:
                    return None
                corners = [OPERATIONS[sign](one, other) for one in left for other in right]
                found.append((min(corners), max(corners)))
            case _:
                return None
    return found[0]


def _bounds_of_domain(domain: Expression) -> Bounds | None:
    """Return the least and the greatest of a value, a range or a set of numbers."""
    match domain:
        case expr.RangeValue(lower=lower, upper=upper):
            ends = [bounds(lower), bounds(upper)]
        case expr.HalfRange(bound=bound, is_lower=is_lower):
            end = constant(bound)
            if end is None:
                return None
            return (end, inf) if is_lower else (-inf, end)
        case expr.Choices(elements=elements):
            ends = [bounds(element) for element in elements]
        case _:
            return bounds(domain)
    known = [end for end in ends if end is not None]
    if not known or len(known) < len(ends):
        return None
    return min(low for low, _ in known), max(high for _, high in known)


def _postfix(expression: Expression) -> list[Expression]:
    """Return the parts, operands before operators; without recursion, for chains are long."""
    ordered: list[Expression] = []
    pending = [expression]
    while pending:
        current = pending.pop()
        ordered.append(current)
        match current:
            case expr.Unary(operand=operand):
                pending.append(operand)
            case expr.Binary(left=left, right=right):
                pending.extend((left, right))
            case _:
                pass
    ordered.reverse()
    return ordered


_LEAVES = (
    *(expr.Literal, expr.Quantity, expr.EnumValue, expr.FieldRef, expr.ParameterRef),
    *(expr.ScenarioSelf, expr.EventArgument, expr.InvokedValue, expr.Element, expr.Undefined),
)
_LEAF_TYPES = frozenset[type](_LEAVES)


def children(expression: Expression) -> tuple[Expression, ...]:
    """Return the direct sub-expressions, left to right."""
    if isinstance(expression, _LEAVES):
        return ()
    match expression:
        case expr.Attribute(base=base):
            return (base,)
        case expr.MethodCall(base=base, arguments=arguments):
            values = tuple(argument.value for argument in arguments)
            return values if expression.needs_no_object else (base, *values)
        case expr.ListOperation(base=base, argument=argument):
            return (base,) if argument is None else (base, argument)
        case expr.Index(base=base, index=index):
            return (base, index)
        case (
            expr.Unary(operand=operand)
            | expr.Conversion(operand=operand)
            | expr.Lookup(operand=operand)
            | expr.TypeTest(operand=operand)
            | expr.Downcast(operand=operand)
            | expr.UserShape(operand=operand)
        ):
            return (operand,)
        case expr.Binary(left=left, right=right):
            return (left, right)
        case expr.Conditional(condition=condition, when_true=when_true, when_false=when_false):
            return (condition, when_true, when_false)
        case expr.ListValue(elements=elements) | expr.Choices(elements=elements):
            return elements
        case expr.HalfRange(bound=bound):
            return (bound,)
        case expr.RangeValue(lower=lower, upper=upper):
            return (lower, upper)


def walk(expression: Expression) -> tuple[Expression, ...]:
    """Return the expression and everything below it, without recursion."""
    if expression.__class__ in _LEAF_TYPES:
        return (expression,)
    found: list[Expression] = []
    pending = [expression]
    while pending:
        current = pending.pop()
        found.append(current)
        if current.__class__ not in _LEAF_TYPES:
            pending.extend(reversed(children(current)))
    return tuple(found)


def is_live(expression: Expression) -> bool:
    """Whether the value depends on the state of the world, so that it must be read late."""
    return any(
        isinstance(part, expr.EventArgument)
        or (isinstance(part, expr.MethodCall) and not part.is_pure)
        or (isinstance(part, expr.Attribute | expr.FieldRef) and part.is_variable)
        for part in walk(expression)
    )


def rewrite(
    expression: Expression, replacement: Callable[[Expression], Expression | None]
) -> Expression:
    """Return an expression with its outermost parts replaced that have a replacement.

    Args:
        expression: The expression.
        replacement: Returns the replacement of a part; `None` to keep it and visit its parts.
    """
    found = replacement(expression)
    if found is not None:
        return found

    def changed(value: Any) -> Any:
        match value:
            case ExpressionBase():
                return rewrite(value, replacement)  # type: ignore[arg-type]  # all of them are
            case expr.Argument():
                return replace(value, value=rewrite(value.value, replacement))
            case tuple():
                parts = tuple(changed(part) for part in value)
                kept = all(new is old for new, old in zip(parts, value, strict=True))
                return value if kept else parts
            case _:
                return value

    old = {field.name: getattr(expression, field.name) for field in fields(expression)}
    new = {name: made for name, value in old.items() if (made := changed(value)) is not value}
    return replace(expression, **new) if new else expression


def applied_with(
    calls: Iterable[ModifierCall], values: Mapping[str, Expression]
) -> tuple[ModifierCall, ...]:
    """Return the result of a user-defined function for values of its parameters."""

    def value_of(part: Expression) -> Expression | None:
        return values.get(part.name) if isinstance(part, expr.ParameterRef) else None

    def filled(arguments: tuple[expr.Argument, ...]) -> tuple[expr.Argument, ...]:
        return tuple(replace(each, value=rewrite(each.value, value_of)) for each in arguments)

    return tuple(
        replace(
            call,
            arguments=filled(call.arguments),
            applied=tuple(replace(a, arguments=filled(a.arguments)) for a in call.applied),
        )
        for call in calls
    )
