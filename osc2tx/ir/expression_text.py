"""Expressions of the IR as text of the language."""

from __future__ import annotations

from typing import assert_never

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
    Undefined,
    UserShape,
)


def show_arguments(arguments: tuple[Argument, ...]) -> str:
    """Return arguments as DSL text, all of them by name."""
    return ", ".join(f"{a.parameter}: {show(a.value)}" for a in arguments)


def show(expression: Expression) -> str:
    """Return an expression as DSL text, fully parenthesised."""
    match expression:
        case Literal(value=value):
            return str(value).lower() if isinstance(value, bool) else repr(value)
        case Quantity(value=value, unit=unit):
            return f"{value}{unit.name}"
        case EnumValue(member=member, type=type_):
            return f"{type_.name}!{member}"
        case FieldRef(name=name):
            return name
        case ParameterRef(name=name):
            return name
        case ScenarioSelf():
            return "it"
        case EventArgument(event=event, parameter=parameter):
            return f"@{event}.{parameter}"
        case InvokedValue(label=label, name=name):
            return f"{label}.{name}"
        case Attribute(base=base, name=name):
            return f"{show(base)}.{name}"
        case MethodCall(base=base, method=method, arguments=arguments):
            return f"{show(base)}.{method}({show_arguments(arguments)})"
        case Element(depth=depth):
            return f"element {depth}" if depth else "element"
        case ListOperation(base=base, operator=list_operator, argument=argument):
            inner = "" if argument is None else show(argument)
            return f"{show(base)}.{list_operator.value}({inner})"
        case Index(base=base, index=index):
            return f"{show(base)}[{show(index)}]"
        case Conversion(operand=operand, type=type_) | Downcast(operand=operand, type=type_):
            return f"{show(operand)}.as({type_.name})"
        case UserShape(operand=operand):
            return show(operand)
        case Lookup(operand=operand, type=type_):
            return f"{show(operand)}.as({type_.name})"
        case TypeTest(operand=operand, tested=tested):
            return f"{show(operand)}.is({tested})"
        case Unary(operator=operator, operand=operand):
            return f"({operator} {show(operand)})"
        case Binary(operator=operator, left=left, right=right):
            return f"({show(left)} {operator} {show(right)})"
        case Conditional(condition=condition, when_true=when_true, when_false=when_false):
            return f"({show(condition)} ? {show(when_true)} : {show(when_false)})"
        case ListValue(elements=elements):
            return f"[{', '.join(show(element) for element in elements)}]"
        case RangeValue(lower=lower, upper=upper):
            return f"[{show(lower)}..{show(upper)}]"
        case Undefined(method=method):
            return f"undefined {method}"
        case HalfRange(bound=bound, is_lower=True):
            return f"[{show(bound)}..]"
        case HalfRange(bound=bound):
            return f"[..{show(bound)}]"
        case Choices(elements=elements):
            return f"{{{', '.join(show(element) for element in elements)}}}"
        case _:
            assert_never(expression)
