"""Walks over expressions of the IR."""

from __future__ import annotations

from osc2tx.ir.expressions import (
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
