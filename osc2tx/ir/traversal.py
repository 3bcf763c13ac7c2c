"""Walks over expressions of the IR."""

from __future__ import annotations

import operator
from collections.abc import Callable, Iterable, Mapping
from dataclasses import fields
from typing import Any

from osc2tx.ir.behaviors import ModifierCall
from osc2tx.ir.expressions import (
    Argument,
    Attribute,
    Binary,
    Choices,
    Conditional,
    Conversion,
    Downcast,
    Element,
    EnumValue,
    EventArgument,
    Expression,
    FieldRef,
    HalfRange,
    Index,
    InvokedValue,
    ListOperation,
    ListValue,
    Literal,
    Lookup,
    MethodCall,
    ParameterRef,
    Quantity,
    RangeValue,
    ScenarioSelf,
    TypeTest,
    Unary,
    UserShape,
)
from osc2tx.ir.values import ExpressionBase
from osc2tx_shared.classes import replace

OPERATIONS: Mapping[str, Callable[[float, float], float]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
}


def constant(expression: Expression) -> float | None:
    """Return the value of an expression of numbers alone; `None` if it has others in it."""
    values: list[float] = []
    for part in _postfix(expression):
        match part:
            case Literal(value=int() | float() as value) if not isinstance(value, bool):
                values.append(value)
            case Quantity():
                values.append(part.si)
            case Unary(operator="-"):
                values.append(-values.pop())
            case Binary(operator=sign) if sign in OPERATIONS:
                right, left = values.pop(), values.pop()
                if sign == "/" and right == 0.0:
                    return None
                values.append(OPERATIONS[sign](left, right))
            case _:
                return None
    return values[0]


def _postfix(expression: Expression) -> list[Expression]:
    """Return the parts, operands before operators; without recursion, for chains are long."""
    ordered: list[Expression] = []
    pending = [expression]
    while pending:
        current = pending.pop()
        ordered.append(current)
        match current:
            case Unary(operand=operand):
                pending.append(operand)
            case Binary(left=left, right=right):
                pending.extend((left, right))
            case _:
                pass
    ordered.reverse()
    return ordered


def children(expression: Expression) -> tuple[Expression, ...]:
    """Return the direct sub-expressions, left to right."""
    match expression:
        case (
            Literal()
            | Quantity()
            | EnumValue()
            | FieldRef()
            | ParameterRef()
            | ScenarioSelf()
            | EventArgument()
            | InvokedValue()
            | Element()
        ):
            return ()
        case Attribute(base=base):
            return (base,)
        case MethodCall(base=base, arguments=arguments):
            values = tuple(argument.value for argument in arguments)
            return values if expression.needs_no_object else (base, *values)
        case ListOperation(base=base, argument=argument):
            return (base,) if argument is None else (base, argument)
        case Index(base=base, index=index):
            return (base, index)
        case (
            Unary(operand=operand)
            | Conversion(operand=operand)
            | Lookup(operand=operand)
            | TypeTest(operand=operand)
            | Downcast(operand=operand)
            | UserShape(operand=operand)
        ):
            return (operand,)
        case Binary(left=left, right=right):
            return (left, right)
        case Conditional(condition=condition, when_true=when_true, when_false=when_false):
            return (condition, when_true, when_false)
        case ListValue(elements=elements) | Choices(elements=elements):
            return elements
        case HalfRange(bound=bound):
            return (bound,)
        case RangeValue(lower=lower, upper=upper):
            return (lower, upper)


def walk(expression: Expression) -> tuple[Expression, ...]:
    """Return the expression and everything below it, without recursion."""
    found: list[Expression] = []
    pending = [expression]
    while pending:
        current = pending.pop()
        found.append(current)
        pending.extend(reversed(children(current)))
    return tuple(found)


def is_live(expression: Expression) -> bool:
    """Whether the value depends on the state of the world, so that it must be read late."""
    return any(
        isinstance(part, EventArgument)
        or (isinstance(part, MethodCall) and not part.is_pure)
        or (isinstance(part, Attribute | FieldRef) and part.is_variable)
        for part in walk(expression)
    )


def rewrite(
    expression: Expression, replacement: Callable[[Expression], Expression | None]
) -> Expression:
    """Return an expression with its outermost parts replaced that have a replacement.

    Args:
        expression: The expression.
        replacement: Gives what a part becomes; `None` if it stays, and its parts are looked at.
    """
    found = replacement(expression)
    if found is not None:
        return found

    def changed(value: Any) -> Any:
        match value:
            case ExpressionBase():
                return rewrite(value, replacement)  # type: ignore[arg-type]  # all of them are
            case Argument():
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
    """Return what a function of the user's own stands for, with values for its parameters."""

    def value_of(part: Expression) -> Expression | None:
        return values.get(part.name) if isinstance(part, ParameterRef) else None

    def filled(arguments: tuple[Argument, ...]) -> tuple[Argument, ...]:
        return tuple(replace(each, value=rewrite(each.value, value_of)) for each in arguments)

    return tuple(
        replace(
            call,
            arguments=filled(call.arguments),
            applied=tuple(replace(a, arguments=filled(a.arguments)) for a in call.applied),
        )
        for call in calls
    )
