"""Symbolic numbers: arithmetic on open parameters as expressions of the document.

A `Symbol` is a number, the nominal value of an open parameter or of an expression over it, with
this expression: sums, differences, products and quotients of symbols are symbols. All other
operations use the nominal value. Whether a document made so is right for the other values too is
not known before `parameters` has compared it with documents made for them.

A symbol is a sum of factors with coefficients: constants are combined, and zero terms vanish.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping
from typing import NamedTuple

from osc2tx.diagnostics import InternalCompilerError
from osc2tx.xosc.numbers import number_text

LONGEST = 160
"""Maximum length of an expression that a reader understands."""

NOISE = 1e-12
"""Share of two coefficients that their difference may have by rounding alone."""


class Sum(NamedTuple):
    """Coefficients of factors, in order of occurrence, and a constant.

    Attributes:
        terms: Coefficients by the text of the factor: a parameter, a product or a quotient.
        constant: The constant term.
    """

    terms: Mapping[str, float]
    constant: float

    @property
    def text(self) -> str:
        """The sum as an expression; equal coefficients are factored out."""
        sizes = {abs(each) for each in self.terms.values()}
        if len(self.terms) > 1 and len(sizes) == 1 and sizes != {1.0}:
            (size,) = sizes
            signs = {factor: each / size for factor, each in self.terms.items()}
            return Sum({f"({Sum(signs, 0.0).text})": size}, self.constant).text
        added = [_scaled(factor, each) for factor, each in self.terms.items() if each > 0.0]
        if self.constant > 0.0:
            added.append(number_text(self.constant))
        taken = [(factor, -each) for factor, each in self.terms.items() if each < 0.0]
        if not added and taken:
            (factor, each), *taken = taken
            added.append(f"(-{number_text(each)}) * {factor}")
        text = " + ".join(added)
        for factor, each in taken:
            text = f"{text} - {_scaled(factor, each)}"
        return f"{text} - {number_text(-self.constant)}" if self.constant < 0.0 else text

    @property
    def factor(self) -> str:
        """The sum as a factor of a product."""
        text = self.text
        return text if text in self.terms else f"({text})"

    @property
    def divisor(self) -> str:
        """The sum as a divisor."""
        text = self.text
        return text if _is_name(text) else f"({text})"

    def plus(self, other: Sum, sign: float) -> Sum:
        """Return the sum with another one, or the difference from it (`sign` is -1)."""
        terms = dict(self.terms)
        for factor, each in other.terms.items():
            terms[factor] = _rounded(terms.get(factor, 0.0), sign * each)
        terms = {factor: each for factor, each in terms.items() if each}
        return Sum(terms, _rounded(self.constant, sign * other.constant))

    def times(self, scale: float) -> Sum:
        """Return a multiple of the sum."""
        if not scale:
            return Sum({}, 0.0)
        return Sum({f: scale * each for f, each in self.terms.items()}, scale * self.constant)

    def over(self, other: Sum) -> float | None:
        """Return the constant ratio to another sum; `None` if there is none."""
        if self.terms.keys() != other.terms.keys():
            return None
        shares = [each / other.terms[factor] for factor, each in self.terms.items()]
        first = shares[0]
        pairs = [(share, first) for share in shares]
        pairs.append((self.constant, first * other.constant))
        return first if all(not _rounded(a, -b) for a, b in pairs) else None


def _rounded(a: float, b: float) -> float:
    """Return the sum of two numbers; zero where they differ by rounding alone."""
    total = a + b
    return 0.0 if abs(total) <= NOISE * max(abs(a), abs(b)) else total


def _scaled(factor: str, scale: float) -> str:
    """Return a factor with its coefficient above 0, as what is shorter: product or quotient."""
    if abs(scale - 1.0) <= NOISE:
        return factor
    times, over = number_text(scale), number_text(1.0 / scale)
    return f"{factor} / {over}" if len(over) < len(times) else f"{times} * {factor}"


def _is_name(text: str) -> bool:
    return text.startswith("$") and text[1:].isidentifier()


class Symbol(float):
    """A number with the expression that gives it.

    Attributes:
        sum: How it is computed.
        has_expressions: Whether the version has expressions; else only names are symbols.
    """

    __slots__ = ("has_expressions", "sum")

    sum: Sum
    has_expressions: bool

    def __new__(cls, value: float, of: str | Sum, *, has_expressions: bool = True) -> Symbol:
        """Store the nominal value, and the parameter (`$name`) or expression."""
        made = super().__new__(cls, value)
        made.sum = Sum({of: 1.0}, 0.0) if isinstance(of, str) else of
        made.has_expressions = has_expressions
        return made

    @property
    def text(self) -> str:
        """The expression, without `${}`."""
        return self.sum.text

    @property
    def attribute(self) -> str:
        """The text of an attribute that has this value."""
        text = self.text
        return text if _is_name(text) else f"${{{text}}}"

    def __reduce__(self) -> str:
        raise InternalCompilerError("symbols do not leave the back end")

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Symbol) and self.text == other.text

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        return hash(self.text)

    def __add__(self, other: float) -> float:
        return _joined(self, "+", other)

    def __radd__(self, other: float) -> float:
        return _joined(other, "+", self)

    def __sub__(self, other: float) -> float:
        return _joined(self, "-", other)

    def __rsub__(self, other: float) -> float:
        return _joined(other, "-", self)

    def __mul__(self, other: float) -> float:
        return _joined(self, "*", other)

    def __rmul__(self, other: float) -> float:
        return _joined(other, "*", self)

    def __truediv__(self, other: float) -> float:
        return _joined(self, "/", other)

    def __rtruediv__(self, other: float) -> float:
        return _joined(other, "/", self)

    def __neg__(self) -> float:
        return _joined(-1.0, "*", self)

    def __pos__(self) -> float:
        return self

    def __abs__(self) -> float:
        return self if float(self) >= 0.0 else -self

    def __round__(self, digits: int | None = None) -> float:  # type: ignore[override]
        """Stay unchanged: a tool computes it, and rounds it in its own way."""
        return round(float(self)) if digits is None else self


_COMPUTE: Mapping[str, Callable[[float, float], float]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
}


def _joined(left: float, sign: str, right: float) -> float:
    """Return the result of an operation; a plain number where no parameter is left in it."""
    if not isinstance(left, (int, float)) or not isinstance(right, (int, float)):
        return NotImplemented
    known = next(each for each in (left, right) if isinstance(each, Symbol))
    found = _combined(_sum_of(left), sign, _sum_of(right))
    if isinstance(found, float):
        return found
    if found == known.sum:
        return known
    if not found.terms:
        return found.constant
    value = _COMPUTE[sign](float(left), float(right))
    made = Symbol(value, found, has_expressions=known.has_expressions)
    if _is_name(made.text):
        return made
    return made if known.has_expressions and len(made.text) <= LONGEST else value


def _sum_of(value: float) -> Sum:
    return value.sum if isinstance(value, Symbol) else Sum({}, float(value))


def _combined(left: Sum, sign: str, right: Sum) -> Sum | float:
    """Return the result of an operation; a number if it does not depend on parameters."""
    match sign:
        case "+" | "-":
            return left.plus(right, 1.0 if sign == "+" else -1.0)
        case "*" if not left.terms:
            return right.times(left.constant)
        case "*" if not right.terms:
            return left.times(right.constant)
        case "*":
            return Sum({f"{left.factor} * {right.factor}": 1.0}, 0.0)
        case _ if not right.terms:
            return left.times(1.0 / right.constant)
        case _ if not left.terms:
            size = f"{number_text(abs(left.constant))} / {right.divisor}"
            return Sum({size: 1.0}, 0.0).times(math.copysign(1.0, left.constant))
    ratio = left.over(right)
    return Sum({f"{left.factor} / {right.divisor}": 1.0}, 0.0) if ratio is None else ratio
