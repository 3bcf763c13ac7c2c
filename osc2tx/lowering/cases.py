"""What a parameter is in each of some cases: `wet => v == 50kph`, `v == 1mps or v == 2mps`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TypeAlias

from osc2tx import ir
from osc2tx.analysis.collect import Constraint
from osc2tx.analysis.operation_list import Key
from osc2tx.analysis.tree_walk import nodes_below
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.expressions import lower_expression
from osc2tx.lowering.parameter_domains import all_values, as_type
from osc2tx.lowering.value_types import lower_type
from osc2tx.semantics import types
from osc2tx.syntax import ast
from osc2tx_classes import dataclass

Op = ast.BinaryOperator

Value: TypeAlias = bool | int
"""Of an enum, or a truth value."""


@dataclass(frozen=True, slots=True)
class Case:
    """One implication that sets a parameter.

    Attributes:
        constraint: The whole of it.
        selector: The parameter that its condition is about.
        values: For which values of that one the condition holds.
        condition: The condition.
        value: What it sets the parameter to.
    """

    constraint: Constraint
    selector: Key
    values: frozenset[Value]
    condition: ir.Expression
    value: ir.Expression


def value_by_cases(cases: Sequence[Case]) -> ir.Expression | None:
    """Return one expression for cases of which exactly one always holds, in their order."""
    *first, last = cases
    value = last.value
    for case in reversed(first):
        value = ir.Conditional(
            span=case.value.span,
            type=value.type,
            condition=case.condition,
            when_true=case.value,
            when_false=value,
        )
    return value


def cases_of(
    ctx: LoweringContext, constraints: Iterable[Constraint], key: Key, type_: types.Type
) -> list[Case]:
    """Return the cases of a parameter, if exactly one of them always holds; else nothing."""
    by_selector: dict[Key, list[Case]] = {}
    wholes: dict[Key, frozenset[Value]] = {}
    for constraint in constraints:
        found = _case(ctx, constraint, key, type_)
        if found is not None:
            case, whole = found
            by_selector.setdefault(case.selector, []).append(case)
            wholes[case.selector] = whole
    for selector, cases in by_selector.items():
        covered = [value for case in cases for value in case.values]
        if len(covered) == len(wholes[selector]) == len(set(covered)):
            return cases
    return []


def alternatives(
    ctx: LoweringContext, constraint: Constraint, key: Key, type_: types.Type
) -> ir.Choices | None:
    """Return the values of a constraint that lists them: `x == a or x == b`."""
    node = constraint.node
    if not isinstance(node, ast.KeepConstraint) or constraint.is_default:
        return None
    values = [_set_to(ctx, constraint, part, key, type_) for part in _parts(node.expression)]
    elements = tuple(value for value in values if value is not None)
    if len(elements) != len(values) or len(elements) < 2:
        return None
    return ir.Choices(span=constraint.span, type=lower_type(type_), elements=elements)


def _parts(expression: ast.Expression) -> Iterator[ast.Expression]:
    """Yield the operands of a chain of `or`, left to right."""
    if isinstance(expression, ast.Binary) and expression.operator is Op.OR:
        yield from _parts(expression.left)
        yield from _parts(expression.right)
    else:
        yield expression


def _case(
    ctx: LoweringContext, constraint: Constraint, key: Key, type_: types.Type
) -> tuple[Case, frozenset[Value]] | None:
    """Return an implication as a case, and all values that its selector can have."""
    node = constraint.node
    if not isinstance(node, ast.KeepConstraint) or constraint.is_default:
        return None
    implication = node.expression
    if not isinstance(implication, ast.Binary) or implication.operator is not Op.IMPLIES:
        return None
    value = _set_to(ctx, constraint, implication.right, key, type_)
    condition = lower_expression(ctx.at(constraint.place), implication.left)
    held = _held(ctx, constraint, implication.left)
    if value is None or condition is None or held is None or held[0] == key:
        return None
    selector, values, whole = held
    return Case(constraint, selector, values, condition, value), whole


def _set_to(
    ctx: LoweringContext, constraint: Constraint, part: ast.Expression, key: Key, type_: types.Type
) -> ir.Expression | None:
    """Return what an equality sets a parameter to; `None` for anything else."""
    if not isinstance(part, ast.Binary) or part.operator is not Op.EQUAL:
        return None
    for side, other in ((part.left, part.right), (part.right, part.left)):
        if constraint.place.locate(side) == key and not _mentions(constraint, other, key):
            value = lower_expression(ctx.at(constraint.place), other)
            return None if value is None else as_type(value, type_)
    return None


def _mentions(constraint: Constraint, node: ast.Expression, key: Key) -> bool:
    return any(
        constraint.place.locate(part) == key
        for part in nodes_below(node)
        if isinstance(part, ast.NameExpression | ast.MemberAccess | ast.ItExpression)
    )


def _held(
    ctx: LoweringContext, constraint: Constraint, node: ast.Expression
) -> tuple[Key, frozenset[Value], frozenset[Value]] | None:
    """Return what a condition is about, the values for which it holds, and all there are."""
    if isinstance(node, ast.Unary) and node.operator is ast.UnaryOperator.NOT:
        inner = _held(ctx, constraint, node.operand)
        return None if inner is None else (inner[0], inner[2] - inner[1], inner[2])
    if isinstance(node, ast.Binary) and node.operator in (Op.EQUAL, Op.NOT_EQUAL):
        for side, other in ((node.left, node.right), (node.right, node.left)):
            whole = _all_of(ctx, side)
            value = _constant(ctx, constraint, other)
            key = constraint.place.locate(side)
            if key is not None and whole and value is not None:
                one = frozenset({value})
                return key, one if node.operator is Op.EQUAL else whole - one, whole
        return None
    key = constraint.place.locate(node)
    whole = _all_of(ctx, node)
    return None if key is None or not whole else (key, frozenset({True}), whole)


def _all_of(ctx: LoweringContext, node: ast.Expression) -> frozenset[Value]:
    """Return all values of an enum or a truth value; nothing for other types."""
    choices = all_values(ctx.model.type_of(node), node.span)
    values = (_plain(element) for element in choices.elements) if choices else ()
    return frozenset(value for value in values if value is not None)


def _constant(ctx: LoweringContext, constraint: Constraint, node: ast.Expression) -> Value | None:
    lowered = lower_expression(ctx.at(constraint.place), node)
    return None if lowered is None else _plain(lowered)


def _plain(expression: ir.Expression) -> Value | None:
    match expression:
        case ir.EnumValue(value=value):
            return value
        case ir.Literal(value=bool() as value):
            return value
        case _:
            return None
