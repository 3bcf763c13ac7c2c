"""Domains: the values that a parameter or expression can still have.

Numbers are intervals in SI, with Python integers for `int` and `uint`, floats for the rest. Bools,
enums and strings are finite sets or their complements. An interval states for each bound whether
it is excluded, and whether NaN is in the set: comparisons drop it, their negations do not.
"""

from __future__ import annotations

import math
from typing import TypeAlias

from osc2tx_shared.classes import dataclass, replace

Number: TypeAlias = int | float
Value: TypeAlias = int | float | bool | str

# Values of different unit or order of evaluation that differ by less count as one value. It only
# keeps back reports: an intersection that is empty by less than this is taken as not empty.
RELATIVE_SLACK = 1e-9
ABSOLUTE_SLACK = 1e-12

INT_RANGE = (-(2**63), 2**63 - 1)
UINT_RANGE = (0, 2**64 - 1)


class EmptyDomainError(Exception):
    """No value is left."""


@dataclass(frozen=True, slots=True)
class Interval:
    """The numbers from `lower` to `upper`; and NaN, if `nan`."""

    lower: Number
    upper: Number
    lower_open: bool = False
    upper_open: bool = False
    nan: bool = False

    @property
    def is_point(self) -> bool:
        """Whether exactly one number is left."""
        return self.lower == self.upper and not self.nan

    def contains(self, number: Number) -> bool:
        """Whether a number is in it."""
        if number != number:
            return self.nan
        above = number > self.lower or (number == self.lower and not self.lower_open)
        return above and (number < self.upper or (number == self.upper and not self.upper_open))


@dataclass(frozen=True, slots=True)
class Choice:
    """The values of a set, or with `excluded` all others; enum members are their numbers."""

    values: frozenset[Value]
    excluded: bool = False

    @property
    def is_point(self) -> bool:
        """Whether exactly one value is left."""
        return not self.excluded and len(self.values) == 1


Domain: TypeAlias = Interval | Choice

ANY_FLOAT = Interval(-math.inf, math.inf, nan=True)
ANY_INT = Interval(*INT_RANGE)
ANY_UINT = Interval(*UINT_RANGE)
ANY_BOOL = Choice(frozenset({False, True}))
TRUE = Choice(frozenset({True}))
FALSE = Choice(frozenset({False}))
ANYTHING = Choice(frozenset(), excluded=True)


def point(value: Value) -> Domain:
    """Return the set of one value."""
    if isinstance(value, bool | str):
        return Choice(frozenset({value}))
    if value != value:
        return Interval(math.inf, -math.inf, nan=True)
    return Interval(value, value)


def intersect(first: Domain, second: Domain) -> Domain:
    """Return the intersection.

    Raises:
        EmptyDomainError: Nothing is.
    """
    if isinstance(first, Interval) and isinstance(second, Interval):
        return _intersect_intervals(first, second)
    if isinstance(first, Choice) and isinstance(second, Choice):
        return _intersect_choices(first, second)
    return first  # never for programs that type-check; nothing is known then


def _intersect_choices(first: Choice, second: Choice) -> Choice:
    match first.excluded, second.excluded:
        case True, True:
            return Choice(first.values | second.values, excluded=True)
        case True, False:
            left = second.values - first.values
        case False, True:
            left = first.values - second.values
        case _:
            left = first.values & second.values
    if not left:
        raise EmptyDomainError
    return Choice(left)


def _intersect_intervals(first: Interval, second: Interval) -> Interval:
    """Return the common part; an operand itself if it lies within the other."""
    lower, upper = _later_start(first, second), _earlier_end(first, second)
    nan = first.nan and second.nan
    if lower is upper and lower.nan == nan and not is_void(lower):
        return lower
    if not _is_empty(lower, upper):
        return Interval(lower.lower, upper.upper, lower.lower_open, upper.upper_open, nan)
    if nan:
        return Interval(math.inf, -math.inf, nan=True)
    if lower.lower > upper.upper and _is_slack(lower.lower, upper.upper):
        return Interval(upper.upper, lower.lower)
    raise EmptyDomainError


def _later_start(first: Interval, second: Interval) -> Interval:
    if first.lower == second.lower:
        return second if second.lower_open and not first.lower_open else first
    return first if first.lower > second.lower else second


def _earlier_end(first: Interval, second: Interval) -> Interval:
    if first.upper == second.upper:
        return second if second.upper_open and not first.upper_open else first
    return first if first.upper < second.upper else second


def _is_empty(lower: Interval, upper: Interval) -> bool:
    """Whether no number is both above the start of one interval and below the end of another."""
    if lower.lower == upper.upper:
        return lower.lower_open or upper.upper_open
    return lower.lower > upper.upper


def is_above(left: Interval, right: Interval) -> bool:
    """Whether every number of one interval is greater than every one of the other, by enough."""
    if not _is_empty(left, right):
        return False
    return left.lower == right.upper or not _is_slack(left.lower, right.upper)


def _is_slack(first: Number, second: Number) -> bool:
    if isinstance(first, int) and isinstance(second, int):
        return False
    if math.isinf(first) or math.isinf(second):
        return False
    size = max(abs(first), abs(second))
    return abs(first - second) <= max(ABSOLUTE_SLACK, RELATIVE_SLACK * size)


def join(first: Domain, second: Domain) -> Domain:
    """Return a set that holds both."""
    if isinstance(first, Interval) and isinstance(second, Interval):
        lower, lower_open = min(_lower_key(first), _lower_key(second))
        upper, not_open = max(_upper_key(first), _upper_key(second))
        return Interval(lower, upper, lower_open, not not_open, first.nan or second.nan)
    if isinstance(first, Choice) and isinstance(second, Choice):
        match first.excluded, second.excluded:
            case False, False:
                return Choice(first.values | second.values)
            case True, True:
                return Choice(first.values & second.values, excluded=True)
            case True, False:
                return Choice(first.values - second.values, excluded=True)
            case _:
                return Choice(second.values - first.values, excluded=True)
    return first


def _lower_key(interval: Interval) -> tuple[Number, bool]:
    return interval.lower, interval.lower_open


def _upper_key(interval: Interval) -> tuple[Number, bool]:
    return interval.upper, not interval.upper_open


def is_disjoint(first: Domain, second: Domain) -> bool:
    """Whether two sets have nothing in common; NaN never counts, as it equals nothing."""
    if isinstance(first, Interval) and isinstance(second, Interval):
        lower, upper = _later_start(first, second), _earlier_end(first, second)
        return is_above(lower, upper)
    try:
        intersect(first, second)
    except EmptyDomainError:
        return True
    return False


def numbers_of(interval: Interval) -> Interval:
    """Return an interval without NaN."""
    return replace(interval, nan=False) if interval.nan else interval


def is_void(interval: Interval) -> bool:
    """Whether there is no number in it: it is NaN."""
    return interval.lower > interval.upper


def close(first: Number, second: Number) -> bool:
    """Whether two numbers count as one value."""
    return first == second or _is_slack(first, second)
