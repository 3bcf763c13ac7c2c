"""Backward propagation: domains of operands from the domain of the result.

Each function returns new domains for some operands, as pairs of position and domain. The other
operands are unchanged.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import reduce
from typing import TypeAlias

from osc2tx.analysis.constraints import interval_arithmetic as arithmetic
from osc2tx.analysis.constraints.domains import (
    FALSE,
    TRUE,
    Choice,
    Domain,
    EmptyDomainError,
    Interval,
    is_disjoint,
    is_void,
    join,
    numbers_of,
)
from osc2tx.analysis.constraints.forward import negated, range_between
from osc2tx.analysis.constraints.operation_list import Operation
from osc2tx_shared.classes import replace

Narrowings: TypeAlias = Iterator[tuple[int, Domain]]

INF = float("inf")
SWAPPED = {"<": ">", "<=": ">=", ">": "<", ">=": "<="}
NEGATED = {"<": ">=", "<=": ">", ">": "<=", ">=": "<", "==": "!=", "!=": "=="}


def narrow(operation: Operation, result: Domain, operands: Sequence[Domain]) -> Narrowings:
    """Yield the consequences for the operands; positions count from the first operand."""
    match operation.name:
        case "not":
            yield 0, negated(result)
        case "and":
            yield from _conjunction(result, operands)
        case "or":
            yield from _flipped(_conjunction(negated(result), [negated(o) for o in operands]))
        case "=>":
            flipped = [operands[0], negated(operands[1])]
            for index, domain in _conjunction(negated(result), flipped):
                yield index, domain if index == 0 else negated(domain)
        case "?":
            yield from _conditional(result, operands)
        case "==" | "!=" | "<" | "<=" | ">" | ">=":
            if result in (TRUE, FALSE):
                yield from _comparison(operation.name, result == TRUE, operands)
        case "in range":
            if result == TRUE:
                yield from _in_range(operands)
        case "in list":
            if result == TRUE:
                yield from _in_list(operands)
        case "convert":
            yield from _convert(operation, result, operands[0])
        case _ if isinstance(result, Interval) and operands:
            intervals = [o for o in operands if isinstance(o, Interval)]
            if len(intervals) == len(operands):
                yield from _numeric(operation, result, intervals)


def _flipped(narrowings: Narrowings) -> Narrowings:
    for index, domain in narrowings:
        yield index, negated(domain)


def _conjunction(result: Domain, operands: Sequence[Domain]) -> Narrowings:
    if result == TRUE:
        yield from ((index, TRUE) for index in range(len(operands)))
    elif result == FALSE:
        open_ones = [index for index, o in enumerate(operands) if o != TRUE]
        if not open_ones:
            raise EmptyDomainError
        if len(open_ones) == 1:
            yield open_ones[0], FALSE


def _conditional(result: Domain, operands: Sequence[Domain]) -> Narrowings:
    condition, first, second = operands
    if condition == TRUE:
        yield 1, result
    elif condition == FALSE:
        yield 2, result
    elif not _may_be(first, result):
        yield 0, FALSE
    elif not _may_be(second, result):
        yield 0, TRUE


def _may_be(domain: Domain, result: Domain) -> bool:
    """Whether a branch can be the result; two NaN are one result."""
    if isinstance(domain, Interval) and isinstance(result, Interval) and domain.nan and result.nan:
        return True
    return not is_disjoint(domain, result)


def _comparison(name: str, holds: bool, operands: Sequence[Domain]) -> Narrowings:
    left, right = operands
    if isinstance(left, Choice) or isinstance(right, Choice):
        if isinstance(left, Choice) and isinstance(right, Choice):
            yield from _choices(name if holds else NEGATED[name], left, right)
        return
    relation = name if holds else NEGATED[name]
    if not holds and name in SWAPPED and (left.nan or right.nan):
        if not (left.nan and right.nan):  # the comparison is false for NaN and any number
            yield from _with_nan(relation, left, right)
        return
    yield from _order(relation, left, right)


def _with_nan(relation: str, left: Interval, right: Interval) -> Narrowings:
    """Narrow the side that may be NaN to the values that the other side allows."""
    if is_void(left) or is_void(right):
        return
    for index, domain in _order(relation, left, right):
        if (left if index == 0 else right).nan:
            yield index, _allow_nan(domain)


def _allow_nan(domain: Domain) -> Domain:
    return replace(domain, nan=True) if isinstance(domain, Interval) else domain


def _order(relation: str, left: Interval, right: Interval) -> Narrowings:
    if relation == "!=":
        yield from _unequal(left, right)
        return
    if is_void(left) or is_void(right):
        raise EmptyDomainError  # NaN compares with nothing
    if relation == "==":
        yield 0, numbers_of(right)
        yield 1, numbers_of(left)
        return
    yield 0, _side(relation, right)
    yield 1, _side(SWAPPED[relation], left)


def _side(relation: str, other: Interval) -> Interval:
    """Return the numbers that have a relation to some number of an interval."""
    strict = relation in ("<", ">")
    if relation in ("<", "<="):
        if strict and isinstance(other.upper, int):
            return Interval(-INF, other.upper - 1)
        return Interval(-INF, other.upper, False, strict or other.upper_open)
    if strict and isinstance(other.lower, int):
        return Interval(other.lower + 1, INF)
    return Interval(other.lower, INF, strict or other.lower_open)


def _unequal(left: Interval, right: Interval) -> Narrowings:
    """Cut a single number off the ends of an interval."""
    for index, domain, other in ((0, left, right), (1, right, left)):
        if not other.is_point or is_void(domain):
            continue
        number = other.lower
        if domain.is_point and domain.lower == number:
            raise EmptyDomainError
        if isinstance(number, int):
            lower = domain.lower + (domain.lower == number)
            yield index, Interval(lower, domain.upper - (domain.upper == number))
        else:
            yield (
                index,
                replace(
                    domain,
                    lower_open=domain.lower_open or domain.lower == number,
                    upper_open=domain.upper_open or domain.upper == number,
                ),
            )


def _choices(relation: str, left: Choice, right: Choice) -> Narrowings:
    if relation == "==":
        yield 0, right
        yield 1, left
    elif relation == "!=":
        if left.is_point:
            yield 1, Choice(left.values, excluded=True)
        if right.is_point:
            yield 0, Choice(right.values, excluded=True)


def _in_range(operands: Sequence[Domain]) -> Narrowings:
    _, first, second = operands
    if isinstance(first, Interval) and isinstance(second, Interval):
        if is_void(first) or is_void(second):
            return
        yield 0, range_between(first, second)


def _in_list(operands: Sequence[Domain]) -> Narrowings:
    value, *elements = operands
    possible = [e for e in elements if not is_disjoint(value, e)]
    if not possible:
        raise EmptyDomainError
    whole: Domain = reduce(join, possible)
    yield 0, _without_nan(whole)


def _without_nan(domain: Domain) -> Domain:
    return replace(domain, nan=False) if isinstance(domain, Interval) else domain


def _convert(operation: Operation, result: Domain, operand: Domain) -> Narrowings:
    if not isinstance(result, Interval) or not isinstance(operand, Interval):
        return
    if operation.kind == "float":
        integers = arithmetic.integers_within(result)
        if integers is not None:
            yield 0, integers
    elif arithmetic.fits(operand, operation.kind):
        yield 0, result


def _numeric(operation: Operation, z: Interval, operands: Sequence[Interval]) -> Narrowings:
    kind = operation.kind
    if is_void(z):
        return
    if len(operands) == 1:
        negative = arithmetic.negate(z)
        if kind == "float" or arithmetic.fits(arithmetic.negate(operands[0]), kind):
            yield 0, negative
        return
    for index, domain in _binary(operation.name, kind, z, operands[0], operands[1]):
        if not z.nan:  # else nothing is known of the numbers behind it
            yield index, replace(domain, nan=False)


def _binary(
    name: str, kind: str, z: Interval, a: Interval, b: Interval
) -> Iterator[tuple[int, Interval]]:
    if is_void(a) or is_void(b):
        return
    match name:
        case "+":
            yield 0, arithmetic.addend(z, b, kind)
            yield 1, arithmetic.addend(z, a, kind)
        case "-":
            yield 0, arithmetic.minuend(z, b, kind)
            yield 1, arithmetic.subtrahend(z, a, kind)
        case "*" if kind == "float":
            yield 0, arithmetic.factor(z, b)
            yield 1, arithmetic.factor(z, a)
        case "*" if arithmetic.fits(arithmetic.multiply(a, b), kind):
            yield 0, arithmetic.integer_factor(z, b, kind)
            yield 1, arithmetic.integer_factor(z, a, kind)
        case "/" if kind == "float":
            yield 0, arithmetic.dividend(z, b)
            yield 1, arithmetic.divisor(z, a)
