"""Values of attributes: numbers, parameters, and arithmetic over these in `${…}`.

An expression is computed here by its grammar; it never becomes code. Booleans (`and`, `or`, `not`)
are not supported.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Generic, NamedTuple, TypeAlias, TypeVar

Shown: TypeAlias = Mapping[str, float]
"""Values of the parameters of a document, by their names there."""

DEEPEST = 50
"""Brackets and signs in one another."""

_FUNCTIONS: Mapping[str, tuple[int, Callable[..., float]]] = {
    "abs": (1, abs),
    "acos": (1, math.acos),
    "asin": (1, math.asin),
    "atan": (1, math.atan),
    "ceil": (1, math.ceil),
    "cos": (1, math.cos),
    "floor": (1, math.floor),
    "max": (2, max),
    "min": (2, min),
    "pow": (2, math.pow),
    "round": (1, lambda value: math.floor(value + 0.5)),
    "sign": (1, lambda value: (value > 0.0) - (value < 0.0)),
    "sin": (1, math.sin),
    "sqrt": (1, math.sqrt),
    "tan": (1, math.tan),
}
"""Number of operands, and the function of them; those of angles are in tools, not in a version."""

CONSTANTS: Mapping[str, float] = {"pi": math.pi}
"""Names that no version has, and that tools and libraries take for numbers."""

_TOKEN = re.compile(r"\s*(\$?[A-Za-z_]\w*|(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|[-+*/%(),])")

_PART = re.compile(r"\$?[\w .:]+")  # of texts that are joined


def evaluated(text: str, shown: Shown) -> float | None:
    """Return the number of an attribute for values of parameters; `None` if it is not a number."""
    try:
        if text.startswith("${") and text.endswith("}"):
            return float(_Numbers(text[2:-1], shown).run())
        return shown[text[1:]] if text.startswith("$") else float(text)
    except (ArithmeticError, KeyError, ValueError):
        return None


def text_value(text: str, values: Mapping[str, str]) -> str | None:
    """Return the text of an attribute with its parameters; `None` if it has no value.

    `${abc + $name}` joins texts where it is no arithmetic, as esmini does.

    Args:
        text: The attribute.
        values: Texts of the parameters, by their names.
    """
    if not text.startswith("$"):
        return text
    if text[1:] in values:
        return values[text[1:]]
    numbers: dict[str, float] = {}
    for name, value in values.items():
        try:
            numbers[name] = float(value)
        except ValueError:  # a name or a truth value
            continue
    number = evaluated(text, numbers)
    return _joined(text, values) if number is None else repr(number)


def _joined(text: str, values: Mapping[str, str]) -> str | None:
    parts = [part.strip() for part in text.removeprefix("${").removesuffix("}").split("+")]
    if len(parts) == 1 or not all(_PART.fullmatch(part) for part in parts):
        return None
    found = [values.get(part[1:]) if part.startswith("$") else part for part in parts]
    return None if None in found else "".join(filter(None, found))


class Range(NamedTuple):
    """Between which numbers a value lies; arithmetic may give more, never less than there is."""

    low: float
    high: float

    def __add__(self, other: Range) -> Range:  # type: ignore[override]
        return Range(self.low + other.low, self.high + other.high)

    def __sub__(self, other: Range) -> Range:
        return Range(self.low - other.high, self.high - other.low)

    def __neg__(self) -> Range:
        return Range(-self.high, -self.low)

    def __mul__(self, other: Range) -> Range:  # type: ignore[override]
        ends = [a * b for a in self for b in other]
        return Range(min(ends), max(ends))

    def __truediv__(self, other: Range) -> Range:
        if other.low <= 0.0 <= other.high:
            raise ZeroDivisionError
        return self * Range(1.0 / other.high, 1.0 / other.low)


def range_of(text: str, ranges: Mapping[str, Range]) -> Range | None:
    """Return between which numbers an attribute is where the parameters are in their ranges.

    `None`: it may have no value. A divisor that might be 0 counts as one that is, and parameters
    without a range are no numbers.
    """
    try:
        if text.startswith("${") and text.endswith("}"):
            return _Ranges(text[2:-1], ranges).run()
        return ranges[text[1:]] if text.startswith("$") else Range(float(text), float(text))
    except (ArithmeticError, KeyError, ValueError):
        return None


N = TypeVar("N", float, Range)


class Evaluation(Generic[N]):
    """Computes an expression, by recursive descent: a number, or whatever stands for one.

    Raises:
        ValueError: It is none.
        KeyError: A parameter has no value.
        ArithmeticError: It has no value.
    """

    def __init__(self, text: str, shown: Mapping[str, N]) -> None:
        self._tokens = _TOKEN.findall(text)
        if "".join(self._tokens) != re.sub(r"\s", "", text):
            raise ValueError(text)
        self._at = 0
        self._depth = 0
        self._shown: Mapping[str, N] = shown

    def _literal(self, token: str) -> N:
        """Return the value of a number."""
        raise NotImplementedError

    def _named(self, name: str) -> N:
        """Return the value of a parameter."""
        return self._shown[name]

    def _remainder(self, value: N, other: N) -> N:
        raise ValueError("%")

    def _result(self, function: str, operands: Sequence[N]) -> N:
        raise ValueError(function)

    def run(self) -> N:
        """Return the value of all of it."""
        value = self._sum()
        if self._at < len(self._tokens):
            raise ValueError(self._next)
        return value

    @property
    def _next(self) -> str:
        return self._tokens[self._at] if self._at < len(self._tokens) else ""

    def _take(self, expected: str = "") -> str:
        token = self._next
        if expected and token != expected:
            raise ValueError(token)
        self._at += 1
        return token

    def _sum(self) -> N:
        value = self._product()
        while self._next in ("+", "-"):
            sign = self._take()
            other = self._product()
            value = value + other if sign == "+" else value - other
        return value

    def _product(self) -> N:
        value = self._atom()
        while self._next in ("*", "/", "%"):
            sign = self._take()
            other = self._atom()
            if sign == "*":
                value = value * other
            else:
                value = value / other if sign == "/" else self._remainder(value, other)
        return value

    def _atom(self) -> N:
        self._depth += 1
        if self._depth > DEEPEST:
            raise ValueError("too deep")
        try:
            return self._operand(self._take())
        finally:
            self._depth -= 1

    def _operand(self, token: str) -> N:
        if token in ("-", "+"):
            value = self._atom()
            return -value if token == "-" else value
        if token == "(":
            value = self._sum()
            self._take(")")
            return value
        if token in _FUNCTIONS:
            count, _ = _FUNCTIONS[token]
            self._take("(")
            operands = [self._sum()]
            for _ in range(count - 1):
                self._take(",")
                operands.append(self._sum())
            self._take(")")
            return self._result(token, operands)
        if token.startswith("$"):
            return self._named(token[1:])
        if token in CONSTANTS:
            return self._literal(repr(CONSTANTS[token]))
        if token[:1].isalpha():  # `inf` is a number to Python alone
            raise ValueError(token)
        return self._literal(token)


class _Numbers(Evaluation[float]):
    def _literal(self, token: str) -> float:
        return float(token)

    def _remainder(self, value: float, other: float) -> float:
        return math.fmod(value, other)

    def _result(self, function: str, operands: Sequence[float]) -> float:
        return float(_FUNCTIONS[function][1](*operands))


class _Ranges(Evaluation[Range]):
    """The operators that osc2tx writes: sums, products and quotients."""

    def _literal(self, token: str) -> Range:
        return Range(float(token), float(token))
