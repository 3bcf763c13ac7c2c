"""Conditions of a `keep` that are joined by `and`."""

from __future__ import annotations

from itertools import pairwise

from osc2tx.diagnostics import Span
from osc2tx.diagnostics.fixes import Edit, Remedy, rewrite
from osc2tx.syntax import ast

AND = ast.BinaryOperator.AND


def conjuncts(expression: ast.Expression) -> tuple[ast.Expression, ...]:
    """Return the operands of a chain of `and`, left to right."""
    parts: list[ast.Expression] = []
    while isinstance(expression, ast.Binary) and expression.operator is AND:
        parts.append(expression.right)
        expression = expression.left
    return (expression, *reversed(parts))


def in_keeps_of_their_own(rule: ast.KeepConstraint) -> Remedy:
    """Return the remedy that writes each operand in a `keep` of its own.

    Only such a `keep` is an equality or a range, which replaces a default (§7.3.11.3.2).
    """
    help = "write a `keep` for each condition: a conjunction replaces no default"
    parts, source = conjuncts(rule.expression), rule.span.source
    gaps = [Span(source, first.span.end, second.span.start) for first, second in pairwise(parts)]
    if any(gap.text.strip() != "and" for gap in gaps):
        return Remedy(help)  # parentheses, comments: the author splits it
    indent = " " * (rule.span.column - 1)
    return rewrite((Edit(gap, f")\n{indent}keep(") for gap in gaps), help)
