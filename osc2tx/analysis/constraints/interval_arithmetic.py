"""Interval arithmetic, sound for IEEE 754 numbers and for 64-bit integers.

Forward: rounding is monotonic, so bounds that are computed as the numbers are computed enclose all
results. Backward (operands from the result) the result is widened by the rounding error of the
operation first. An integer result that may leave its type wraps round, so nothing is known about
it.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from osc2tx.analysis.constraints.domains import (
    ANY_FLOAT,
    ANY_INT,
    ANY_UINT,
    INT_RANGE,
    UINT_RANGE,
    Interval,
    Number,
    is_void,
)

INF = math.inf
EXACT_INTEGERS = 2**53

WHOLE: dict[str, Interval] = {"int": ANY_INT, "uint": ANY_UINT, "float": ANY_FLOAT}


def fits(interval: Interval, kind: str) -> bool:
    """Whether all numbers of an interval belong to an integer type."""
    lower, upper = INT_RANGE if kind == "int" else UINT_RANGE
    return lower <= interval.lower and interval.upper <= upper


def wrapped(interval: Interval, kind: str) -> Interval:
    """Return an integer result, or all of its type if it may have left it."""
    if kind == "float" or fits(interval, kind):
        return interval
    return WHOLE[kind]


def widened(interval: Interval) -> Interval:
    """Return an interval with its bounds moved out by the least step there is."""
    return Interval(
        math.nextafter(interval.lower, -INF), math.nextafter(interval.upper, INF), nan=interval.nan
    )


def negate(a: Interval) -> Interval:
    """Return `-a`."""
    return Interval(-a.upper, -a.lower, a.upper_open, a.lower_open, a.nan)


def add(a: Interval, b: Interval) -> Interval:
    """Return `a + b`."""
    if is_void(a) or is_void(b):
        return ANY_FLOAT
    nan = a.nan or b.nan or _opposite_infinities(a, b)
    return Interval(
        _or(a.lower + b.lower, -INF),
        _or(a.upper + b.upper, INF),
        _stays_open(a.lower_open or b.lower_open, a.lower, b.lower),
        _stays_open(a.upper_open or b.upper_open, a.upper, b.upper),
        nan,
    )


def _stays_open(is_open: bool, *bounds: Number) -> bool:
    """Whether a bound of a sum is excluded; rounding can reach it, exact integers cannot."""
    return is_open and all(isinstance(b, int) for b in bounds)


def _opposite_infinities(a: Interval, b: Interval) -> bool:
    return (a.upper == INF and b.lower == -INF) or (a.lower == -INF and b.upper == INF)


def _or(number: Number, otherwise: float) -> Number:
    return otherwise if number != number else number


def subtract(a: Interval, b: Interval) -> Interval:
    """Return `a - b`."""
    return add(a, negate(b))


def multiply(a: Interval, b: Interval) -> Interval:
    """Return `a * b`."""
    if is_void(a) or is_void(b):
        return ANY_FLOAT
    products = [_product(x, y) for x in (a.lower, a.upper) for y in (b.lower, b.upper)]
    nan = a.nan or b.nan or _zero_by_infinity(a, b) or _zero_by_infinity(b, a)
    return Interval(min(products), max(products), nan=nan)


def _product(x: Number, y: Number) -> Number:
    product = x * y
    return 0.0 if product != product else product  # zero by infinity: the bound is zero


def _zero_by_infinity(a: Interval, b: Interval) -> bool:
    return a.lower <= 0 <= a.upper and (b.upper == INF or b.lower == -INF)


def divide(a: Interval, b: Interval) -> Interval:
    """Return `a / b` of floats; nothing is known if `b` may be zero."""
    if is_void(a) or is_void(b) or b.lower <= 0 <= b.upper:
        return ANY_FLOAT
    if _is_infinite(a) and _is_infinite(b):
        return ANY_FLOAT
    return _bounds(a, b, lambda x, y: x / y, nan=a.nan or b.nan)


def _is_infinite(a: Interval) -> bool:
    return a.upper == INF or a.lower == -INF


def _bounds(
    a: Interval, b: Interval, compute: Callable[[Number, Number], Number], *, nan: bool = False
) -> Interval:
    results = [compute(x, y) for x in (a.lower, a.upper) for y in (b.lower, b.upper)]
    return Interval(min(results), max(results), nan=nan)


def divide_integers(a: Interval, b: Interval, kind: str) -> Interval:
    """Return `a / b` of integers, with any rounding (which the standard leaves open)."""
    if b.lower <= 0 <= b.upper:
        return WHOLE[kind]
    results = [
        rounded(x, y)
        for x in (a.lower, a.upper)
        for y in (b.lower, b.upper)
        for rounded in (_floor_division, _ceiling_division)
    ]
    return wrapped(Interval(min(results), max(results)), kind)


def _floor_division(x: Number, y: Number) -> Number:
    return x // y


def _ceiling_division(x: Number, y: Number) -> Number:
    return -(-x // y)


def remainder(a: Interval, b: Interval, kind: str) -> Interval:
    """Return `a % b`; the standard leaves its sign open unless both are positive."""
    if is_void(a) or is_void(b) or b.lower <= 0 <= b.upper:
        return WHOLE[kind]
    if _is_infinite(a) or _is_infinite(b):
        return WHOLE[kind]
    if a.lower >= 0 and b.lower > 0:
        if a.lower == a.upper and b.lower == b.upper:
            value = a.lower % b.lower
            return Interval(value, value, nan=a.nan or b.nan)
        return Interval(0 * a.lower, min(a.upper, b.upper), nan=a.nan or b.nan)
    size = max(abs(b.lower), abs(b.upper))
    return wrapped(Interval(-size, size, nan=a.nan or b.nan), kind)


# --- backward: domain of an operand, given the result `z` and the other operand ---


def addend(z: Interval, other: Interval, kind: str) -> Interval:
    """Return the possible `x` in `x + other = z`."""
    if kind != "float":
        return wrapped(subtract(z, other), kind)  # also right if the sum wraps round
    return _loose(subtract(widened(z), other))


def minuend(z: Interval, other: Interval, kind: str) -> Interval:
    """Return the possible `x` in `x - other = z`."""
    if kind != "float":
        return wrapped(add(z, other), kind)
    return _loose(add(widened(z), other))


def subtrahend(z: Interval, other: Interval, kind: str) -> Interval:
    """Return the possible `x` in `other - x = z`."""
    if kind != "float":
        return wrapped(subtract(other, z), kind)
    return _loose(subtract(other, widened(z)))


def factor(z: Interval, other: Interval) -> Interval:
    """Return the possible `x` in `x * other = z` of floats."""
    z = widened(z)
    if other.lower < 0 < other.upper or (
        z.lower <= 0 <= z.upper and other.lower <= 0 <= other.upper
    ):
        return ANY_FLOAT
    if is_void(z) or is_void(other) or (_is_infinite(z) and _is_infinite(other)):
        return ANY_FLOAT
    if other.lower == 0 or other.upper == 0:
        return _loose(_by_touching_zero(z, other))
    return _loose(divide(z, other))


def _by_touching_zero(z: Interval, other: Interval) -> Interval:
    """Divide a non-zero interval by one that ends at zero."""
    edge = other.upper if other.lower == 0 else other.lower
    if edge == 0:
        return ANY_FLOAT
    least = min(abs(z.lower / edge), abs(z.upper / edge))
    positive = (z.lower > 0) == (edge > 0)
    return Interval(least, INF) if positive else Interval(-INF, -least)


def integer_factor(z: Interval, other: Interval, kind: str) -> Interval:
    """Return the possible `x` in `x * other = z` of integers that do not wrap round."""
    if other.lower <= 0 <= other.upper:
        return WHOLE[kind]
    return divide_integers(z, other, kind)


def dividend(z: Interval, divisor: Interval) -> Interval:
    """Return the possible `x` in `x / divisor = z` of floats."""
    if divisor.lower <= 0 <= divisor.upper:
        return ANY_FLOAT
    return _loose(multiply(widened(z), divisor))


def divisor(z: Interval, dividend: Interval) -> Interval:
    """Return the possible `x` in `dividend / x = z` of floats."""
    return _loose(divide(dividend, widened(z)))


def _loose(interval: Interval) -> Interval:
    """Widen a result that was computed backward."""
    return ANY_FLOAT if is_void(interval) else widened(interval)


# --- conversions ---


def to_float(a: Interval) -> Interval:
    """Return integers as floats."""
    return Interval(float(a.lower), float(a.upper))


def integers_within(z: Interval) -> Interval | None:
    """Return the integers whose floats lie in an interval; `None` if floats are too coarse."""
    if is_void(z) or any(
        math.isfinite(bound) and abs(bound) > EXACT_INTEGERS for bound in (z.lower, z.upper)
    ):
        return None
    lower: Number = z.lower if math.isinf(z.lower) else math.ceil(z.lower)
    upper: Number = z.upper if math.isinf(z.upper) else math.floor(z.upper)
    return Interval(
        lower + (z.lower_open and lower == z.lower), upper - (z.upper_open and upper == z.upper)
    )
