"""Arguments that are modifiers: `drive(50kph)`, `drive(speed: 50kph)`, `lane(1, speed: 2mps)`."""

from __future__ import annotations

from typing import TypeAlias

from osc2tx.catalogue import catalogue
from osc2tx.diagnostics import Span
from osc2tx.diagnostics.fixes import Edit, Remedy, rewrite
from osc2tx.semantics.symbols import ActionSymbol, Symbol
from osc2tx.syntax import ast

Applied: TypeAlias = ast.Invocation | ast.ModifierApplication


def modifiers_of(invoked: Symbol | None) -> str | None:
    """Return a line of help with the modifiers of an action of the library."""
    name = invoked.qualified_name if isinstance(invoked, ActionSymbol) else ""
    action = catalogue().actions.get(name)
    if action is None or not action.modifiers:
        return None
    listed = ", ".join(f"`{each}`" for each in sorted(action.modifiers))
    return f"the modifiers of `{name}` are {listed}"


def move_out(node: ast.Node, value: ast.Expression, name: str) -> Remedy:
    """Return the remedy that makes a modifier of an argument.

    Args:
        node: The owner of the argument. The modifier follows in the `with:` block of an invocation,
            or beside another modifier.
        value: The value of the argument.
        name: Name of the modifier.
    """
    text = f"{name}({value.span.text})"
    if isinstance(node, ast.ModifierApplication):
        help_ = f"`{name}` is a modifier of its own: write `{text}` on the next line"
    else:
        help_ = f"`{name}` is a modifier: end the line with `with:`, and write `{text}` below"
    if not isinstance(node, Applied):
        return Remedy(help_)
    return rewrite([_without(node, value), _with(node, text)], help_, is_safe=False)


def _without(node: Applied, value: ast.Expression) -> Edit:
    """Return the edit that deletes an argument and its comma."""
    arguments = list(node.arguments)
    index = next(n for n, argument in enumerate(arguments) if argument.value is value)
    span = arguments[index].span
    if index + 1 < len(arguments):
        span = Span(span.source, span.start, arguments[index + 1].span.start)
    elif index > 0:
        span = Span(span.source, arguments[index - 1].span.end, span.end)
    return Edit(span, "")


def _with(node: Applied, text: str) -> Edit:
    """Return the edit that inserts a modifier behind another one, or into a `with:` block."""
    if isinstance(node, ast.Invocation) and node.with_members:
        first = node.with_members[0].span
        return Edit(Span(first.source, first.start, first.start), f"{text}\n{_indentation(first)}")
    behind = Span(node.span.source, node.span.end, node.span.end)
    if isinstance(node, ast.ModifierApplication):
        return Edit(behind, f"\n{_indentation(node.span)}{text}")
    head = (node.label or node).span
    return Edit(behind, f" with:\n{_indentation(head)}    {text}")


def _indentation(span: Span) -> str:
    return " " * (span.source.position(span.start)[1] - 1)
