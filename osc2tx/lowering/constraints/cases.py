"""Values of a parameter in each of some cases: `wet => v == 50kph`, `v == 1mps or v == 2mps`."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TypeAlias

from osc2tx import ir
from osc2tx.analysis.constraints.constraint import Constraint
from osc2tx.analysis.constraints.operation_list import Key, kind_of
from osc2tx.analysis.tree_walk import nodes_below
from osc2tx.lowering.constraints.parameter_domains import all_values, as_type
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.value_types import lower_type
from osc2tx.lowering.values.expressions import lower_expression
from osc2tx.semantics import types
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass, replace

Op = ast.BinaryOperator

Value: TypeAlias = bool | int
"""Of an enum, or a truth value."""

NUMBERS = ("int", "uint", "float")
"""Kinds of types that have bounds."""

ValueOf: TypeAlias = Callable[
    [LoweringContext, Constraint, ast.Expression, Key, types.Type], ir.Expression | None
]
"""Returns the value that a part of a constraint gives a parameter; `None` if it gives none."""


@dataclass(frozen=True, slots=True)
class Case:
    """One implication that sets a parameter.

    Attributes:
        constraint: The whole of it.
        selector: The parameter that its condition is about.
        values: For which values of that one the condition holds.
        condition: The condition.
        value: The value of the parameter.
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
    ctx: LoweringContext,
    constraints: Iterable[Constraint],
    key: Key,
    type_: types.Type,
    value_of: ValueOf | None = None,
) -> list[Case]:
    """Return the cases of a parameter, if exactly one of them always holds; else nothing."""
    by_selector: dict[Key, list[Case]] = {}
    wholes: dict[Key, frozenset[Value]] = {}
    for constraint in constraints:
        found = _case(ctx, constraint, key, type_, value_of or _set_to)
        if found is not None:
            case, whole = found
            by_selector.setdefault(case.selector, []).append(case)
            wholes[case.selector] = whole
    for selector, cases in by_selector.items():
        covered = [value for case in cases for value in case.values]
        if len(covered) == len(wholes[selector]) == len(set(covered)):
            return cases
    return []


def range_by_cases(
    ctx: LoweringContext, constraints: Iterable[Constraint], key: Key, type_: types.Type
) -> tuple[ir.RangeValue, list[Constraint]] | None:
    """Return the domain of a number that has bounds in each case, and the cases."""
    cases = cases_of(ctx, constraints, key, type_, _within)
    ranges = [case.value for case in cases if isinstance(case.value, ir.RangeValue)]
    bounds = []
    for values in ([each.lower for each in ranges], [each.upper for each in ranges]):
        of_bound = [replace(c, value=value) for c, value in zip(cases, values, strict=True)]
        bounds.append(value_by_cases(of_bound) if of_bound else None)
    lower, upper = bounds
    if lower is None or upper is None:
        return None
    drawn = ir.RangeValue(span=ranges[0].span, type=ranges[0].type, lower=lower, upper=upper)
    return drawn, [case.constraint for case in cases]


def range_in_a_case(
    ctx: LoweringContext, constraints: Iterable[Constraint], key: Key, type_: types.Type
) -> ir.RangeValue | None:
    """Return the bounds that a number has in some case; where it has none, these do as well."""
    for constraint in constraints:
        found = _case(ctx, constraint, key, type_, _range)
        if found is not None and isinstance(found[0].value, ir.RangeValue):
            return found[0].value
    return None


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
    ctx: LoweringContext, constraint: Constraint, key: Key, type_: types.Type, value_of: ValueOf
) -> tuple[Case, frozenset[Value]] | None:
    """Return an implication as a case, and all values that its selector can have."""
    node = constraint.node
    if not isinstance(node, ast.KeepConstraint) or constraint.is_default:
        return None
    implication = node.expression
    if not isinstance(implication, ast.Binary) or implication.operator is not Op.IMPLIES:
        return None
    value = value_of(ctx, constraint, implication.right, key, type_)
    condition = lower_expression(ctx.at(constraint.place), implication.left)
    held = _held(ctx, constraint, implication.left)
    if value is None or condition is None or held is None or held[0] == key:
        return None
    selector, values, whole = held
    return Case(constraint, selector, values, condition, value), whole


def _set_to(
    ctx: LoweringContext, constraint: Constraint, part: ast.Expression, key: Key, type_: types.Type
) -> ir.Expression | None:
    """Return the value that an equality gives a parameter; `None` for anything else."""
    if not isinstance(part, ast.Binary) or part.operator is not Op.EQUAL:
        return None
    for side, other in ((part.left, part.right), (part.right, part.left)):
        if constraint.place.locate(side) == key and not _mentions(constraint, other, key):
            value = lower_expression(ctx.at(constraint.place), other)
            return None if value is None else as_type(value, type_)
    return None


def _within(
    ctx: LoweringContext, constraint: Constraint, part: ast.Expression, key: Key, type_: types.Type
) -> ir.Expression | None:
    """Return the range that a number lies in; one value is a range, too."""
    value = None if kind_of(type_) not in NUMBERS else _set_to(ctx, constraint, part, key, type_)
    if value is not None:
        return as_type(value, types.RangeType(type_))
    return _range(ctx, constraint, part, key, type_)


def _range(
    ctx: LoweringContext, constraint: Constraint, part: ast.Expression, key: Key, type_: types.Type
) -> ir.Expression | None:
    """Return the range that a constraint gives a number."""
    if not isinstance(part, ast.Binary) or kind_of(type_) not in NUMBERS:
        return None
    is_range = part.operator is Op.IN and isinstance(part.right, ast.RangeLiteral)
    if not is_range or constraint.place.locate(part.left) != key:
        return None
    return lower_expression(ctx.at(constraint.place), part.right)


def _mentions(constraint: Constraint, node: ast.Expression, key: Key) -> bool:
    return any(
        constraint.place.locate(part) == key
        for part in nodes_below(node)
        if isinstance(part, ast.NameExpression | ast.MemberAccess | ast.ItExpression)
    )


def _held(
    ctx: LoweringContext, constraint: Constraint, node: ast.Expression
) -> tuple[Key, frozenset[Value], frozenset[Value]] | None:
    """Return the parameter of a condition, the values for which it holds, and all its values."""
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
