"""Symbolic numbers: arithmetic on open parameters as expressions of the document.

A `Symbol` is a number, the nominal value of an open parameter or what is computed from it, that
remembers how: sums, differences, products and quotients of symbols are symbols. Whatever else is
done with one sees the nominal value. Whether a document made so is right for the other values too
is not known before `parameters` has compared it with documents made for them.
"""

from __future__ import annotations

import operator
from collections.abc import Callable

from osc2tx.diagnostics import InternalCompilerError
from osc2tx.xosc.numbers import number_text

LONGEST = 160
"""Characters of an expression; what is longer is no help to a reader."""

SUM, PRODUCT, ATOM = 1, 2, 3


class Symbol(float):
    """A number with the expression that gives it.

    Attributes:
        text: The expression, without `${}`.
        binding: How tightly its outermost operator binds.
        has_expressions: Whether the version has expressions; else only names are symbols.
    """

    __slots__ = ("binding", "has_expressions", "text")

    text: str
    binding: int
    has_expressions: bool

    def __new__(
        cls, value: float, text: str, binding: int = ATOM, *, has_expressions: bool = True
    ) -> Symbol:
        """Take the nominal value and the expression."""
        made = super().__new__(cls, value)
        made.text = text
        made.binding = binding
        made.has_expressions = has_expressions
        return made

    @property
    def attribute(self) -> str:
        """The text of an attribute that has this value."""
        return self.text if self.binding == ATOM else f"${{{self.text}}}"

    def __reduce__(self) -> str:
        raise InternalCompilerError("symbols do not leave the back end")

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Symbol) and self.text == other.text

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        return hash(self.text)

    def __add__(self, other: float) -> float:
        return _joined(self, "+", other, operator.add, SUM)

    def __radd__(self, other: float) -> float:
        return _joined(other, "+", self, operator.add, SUM)

    def __sub__(self, other: float) -> float:
        return _joined(self, "-", other, operator.sub, SUM)

    def __rsub__(self, other: float) -> float:
        return _joined(other, "-", self, operator.sub, SUM)

    def __mul__(self, other: float) -> float:
        return _joined(self, "*", other, operator.mul, PRODUCT)

    def __rmul__(self, other: float) -> float:
        return _joined(other, "*", self, operator.mul, PRODUCT)

    def __truediv__(self, other: float) -> float:
        return _joined(self, "/", other, operator.truediv, PRODUCT)

    def __rtruediv__(self, other: float) -> float:
        return _joined(other, "/", self, operator.truediv, PRODUCT)

    def __neg__(self) -> float:
        return _joined(-1.0, "*", self, operator.mul, PRODUCT)

    def __pos__(self) -> float:
        return self

    def __abs__(self) -> float:
        return self if float(self) >= 0.0 else -self

    def __round__(self, digits: int | None = None) -> float:  # type: ignore[override]
        """Stay as it is: a tool computes it, and rounds it as it likes."""
        return round(float(self)) if digits is None else self


def _joined(
    left: float, sign: str, right: float, compute: Callable[[float, float], float], binding: int
) -> float:
    """Return the result of an operation; a plain number where the symbol says nothing more."""
    if not isinstance(left, (int, float)) or not isinstance(right, (int, float)):
        return NotImplemented
    value = compute(float(left), float(right))
    known = next(each for each in (left, right) if isinstance(each, Symbol))
    neutral = {"+": 0.0, "-": 0.0, "*": 1.0, "/": 1.0}[sign]
    if left is known and not isinstance(right, Symbol) and right == neutral:
        return known
    if right is known and sign in "+*" and left == neutral:
        return known
    if sign == "-" and left == right:
        return 0.0
    text = f"{_operand(left, binding, False)} {sign} {_operand(right, binding, sign in '-/')}"
    if not known.has_expressions or len(text) > LONGEST:
        return value
    return Symbol(value, text, binding)


def _operand(value: float, binding: int, is_strict: bool) -> str:
    """Return the text of an operand, in brackets where the operator binds more tightly."""
    if not isinstance(value, Symbol):
        text = number_text(float(value))
        return f"({text})" if text.startswith("-") else text
    is_loose = value.binding < binding or (is_strict and value.binding == binding)
    return f"({value.text})" if is_loose else value.text
