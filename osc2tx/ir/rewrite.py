"""Expressions with some of their parts replaced, and modifiers with their parameters."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import fields
from typing import Any

from osc2tx.ir.behaviors import ModifierCall
from osc2tx.ir.expressions import Argument, Expression, ParameterRef
from osc2tx.ir.values import ExpressionBase
from osc2tx_classes import replace


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
