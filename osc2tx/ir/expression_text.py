"""Expressions of the IR as text of the language."""

from __future__ import annotations

from typing import assert_never

from osc2tx.ir import expressions as expr


def show_arguments(arguments: tuple[expr.Argument, ...]) -> str:
    """Return arguments as DSL text, all of them by name."""
    return ", ".join(f"{a.parameter}: {show(a.value)}" for a in arguments)


def show(expression: expr.Expression) -> str:
    """Return an expression as DSL text, fully parenthesised."""
    match expression:
        case expr.Literal(value=value):
            return str(value).lower() if isinstance(value, bool) else repr(value)
        case expr.Quantity(value=value, unit=unit):
            return f"{value}{unit.name}"
        case expr.EnumValue(member=member, type=type_):
            return f"{type_.name}!{member}"
        case expr.FieldRef(name=name):
            return name
        case expr.ParameterRef(name=name):
            return name
        case expr.ScenarioSelf():
            return "it"
        case expr.EventArgument(event=event, parameter=parameter):
            return f"@{event}.{parameter}"
        case expr.InvokedValue(label=label, name=name):
            return f"{label}.{name}"
        case expr.Attribute(base=base, name=name):
            return f"{show(base)}.{name}"
        case expr.MethodCall(base=base, method=method, arguments=arguments):
            return f"{show(base)}.{method}({show_arguments(arguments)})"
        case expr.Element(depth=depth):
            return f"element {depth}" if depth else "element"
        case expr.ListOperation(base=base, operator=list_operator, argument=argument):
            inner = "" if argument is None else show(argument)
            return f"{show(base)}.{list_operator.value}({inner})"
        case expr.Index(base=base, index=index):
            return f"{show(base)}[{show(index)}]"
        case expr.Conversion(operand=operand, type=type_) | expr.Downcast(
            operand=operand, type=type_
        ):
            return f"{show(operand)}.as({type_.name})"
        case expr.UserShape(operand=operand):
            return show(operand)
        case expr.Lookup(operand=operand, type=type_):
            return f"{show(operand)}.as({type_.name})"
        case expr.TypeTest(operand=operand, tested=tested):
            return f"{show(operand)}.is({tested})"
        case expr.Unary(operator=operator, operand=operand):
            return f"({operator} {show(operand)})"
        case expr.Binary(operator=operator, left=left, right=right):
            return f"({show(left)} {operator} {show(right)})"
        case expr.Conditional(condition=condition, when_true=when_true, when_false=when_false):
            return f"({show(condition)} ? {show(when_true)} : {show(when_false)})"
        case expr.ListValue(elements=elements):
            return f"[{', '.join(show(element) for element in elements)}]"
        case expr.RangeValue(lower=lower, upper=upper):
            return f"[{show(lower)}..{show(upper)}]"
        case expr.Undefined(method=method):
            return f"undefined {method}"
        case expr.HalfRange(bound=bound, is_lower=True):
            return f"[{show(bound)}..]"
        case expr.HalfRange(bound=bound):
            return f"[..{show(bound)}]"
        case expr.Choices(elements=elements):
            return f"{{{', '.join(show(element) for element in elements)}}}"
        case _:
            assert_never(expression)
