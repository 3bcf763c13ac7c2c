"""Forward evaluation: the domain of each operation from the domains of its operands."""

from __future__ import annotations

from collections.abc import Sequence

from osc2tx.analysis.constraints import interval_arithmetic as arithmetic
from osc2tx.analysis.constraints.domains import (
    ANY_BOOL,
    FALSE,
    TRUE,
    Choice,
    Domain,
    Interval,
    Number,
    is_above,
    is_disjoint,
    is_void,
    join,
)
from osc2tx.analysis.constraints.operation_list import Operation


def evaluate(operation: Operation, operands: Sequence[Domain]) -> Domain:
    """Return the values that an operation can have."""
    match operation.name:
        case "const" | "any" | "var":
            return operation.initial
        case "not":
            return negated(operands[0])
        case "and":
            return _all(operands)
        case "or":
            return negated(_all([negated(o) for o in operands]))
        case "=>":
            return negated(_all([operands[0], negated(operands[1])]))
        case "?":
            return _conditional(operands)
        case "in list":
            return _in_list(operands)
        case "convert":
            return _convert(operation, operands[0])
        case "==" | "!=" | "<" | "<=" | ">" | ">=":
            return _compare(operation.name, operands[0], operands[1])
        case _ if all(isinstance(o, Interval) for o in operands):
            return _numeric(operation, [o for o in operands if isinstance(o, Interval)])
        case _:
            return operation.initial


def negated(domain: Domain) -> Domain:
    """Return the negation of a truth value."""
    if domain == TRUE:
        return FALSE
    return TRUE if domain == FALSE else ANY_BOOL


def _all(operands: Sequence[Domain]) -> Domain:
    if any(o == FALSE for o in operands):
        return FALSE
    return TRUE if all(o == TRUE for o in operands) else ANY_BOOL


def _conditional(operands: Sequence[Domain]) -> Domain:
    condition, first, second = operands
    if condition == TRUE:
        return first
    return second if condition == FALSE else join(first, second)


def _in_list(operands: Sequence[Domain]) -> Domain:
    value, *elements = operands
    equal = [_equal(value, element) for element in elements]
    if TRUE in equal:
        return TRUE
    return FALSE if all(e == FALSE for e in equal) else ANY_BOOL


def _convert(operation: Operation, operand: Domain) -> Domain:
    if not isinstance(operand, Interval):
        return operation.initial
    if operation.kind == "float":
        return arithmetic.to_float(operand)
    return arithmetic.wrapped(operand, operation.kind)


def _compare(name: str, left: Domain, right: Domain) -> Domain:
    match name:
        case "==":
            return _equal(left, right)
        case "!=":
            return negated(_equal(left, right))
        case "<":
            return _less(left, right)
        case ">":
            return _less(right, left)
        case "<=":
            return _less_or_equal(left, right)
        case _:
            return _less_or_equal(right, left)


def _equal(left: Domain, right: Domain) -> Domain:
    if is_disjoint(left, right):
        return FALSE
    if isinstance(left, Interval) and isinstance(right, Interval):
        same = left.is_point and right.is_point and left.lower == right.lower
        return TRUE if same else ANY_BOOL
    if isinstance(left, Choice) and left.is_point and left == right:
        return TRUE
    return ANY_BOOL


def _less(left: Domain, right: Domain) -> Domain:
    if not isinstance(left, Interval) or not isinstance(right, Interval):
        return ANY_BOOL
    if is_void(left) or is_void(right):
        return FALSE
    if left.lower == right.upper or is_above(left, right):
        return FALSE
    touching = left.upper_open or right.lower_open
    below = left.upper < right.lower or (left.upper == right.lower and touching)
    return TRUE if below and not (left.nan or right.nan) else ANY_BOOL


def _less_or_equal(left: Domain, right: Domain) -> Domain:
    if not isinstance(left, Interval) or not isinstance(right, Interval):
        return ANY_BOOL
    if is_void(left) or is_void(right) or is_above(left, right):
        return FALSE
    return TRUE if left.upper <= right.lower and not (left.nan or right.nan) else ANY_BOOL


def _numeric(operation: Operation, operands: Sequence[Interval]) -> Domain:
    a, b = operands[0], operands[-1]
    kind = operation.kind
    match operation.name:
        case "-" if len(operands) == 1:
            return arithmetic.wrapped(arithmetic.negate(a), kind)
        case "+":
            return arithmetic.wrapped(arithmetic.add(a, b), kind)
        case "-":
            return arithmetic.wrapped(arithmetic.subtract(a, b), kind)
        case "*":
            return arithmetic.wrapped(arithmetic.multiply(a, b), kind)
        case "/" if kind == "float":
            return arithmetic.divide(a, b)
        case "/":
            return arithmetic.divide_integers(a, b, kind)
        case "%":
            return arithmetic.remainder(a, b, kind)
        case "in range":
            return _in_range(a, operands[1], b)
        case _:
            return operation.initial


def _in_range(value: Interval, first: Interval, second: Interval) -> Domain:
    """Judge membership; the bounds may be given in either order."""
    if is_void(value):
        return FALSE
    if is_void(first) or is_void(second):
        return ANY_BOOL
    whole = range_between(first, second)
    if is_disjoint(value, whole):
        return FALSE
    inner = sorted((first, second), key=lambda i: i.lower)
    is_sorted = inner[0].upper <= inner[1].lower
    within = inner[0].upper <= value.lower and value.upper <= inner[1].lower
    known = not (value.nan or first.nan or second.nan)
    return TRUE if is_sorted and within and known else ANY_BOOL


def range_between(first: Interval, second: Interval) -> Interval:
    """Return all numbers that can lie in a range with these bounds."""
    return Interval(min(first.lower, second.lower), max(first.upper, second.upper))


def exact_result(operation: Operation, operands: Sequence[Interval]) -> Number:
    """Return the result of an operation on single integers without wrap-around."""
    a, b = operands[0].lower, operands[-1].lower
    match operation.name:
        case "+":
            return a + b
        case "-":
            return a - b if len(operands) == 2 else -a
        case "*":
            return a * b
        case _:
            return a
