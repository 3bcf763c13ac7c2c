"""Python source fragments that scenario text cannot break out of.

Everything a template places into a module is one of these types, and each can be made only by
a constructor that checks or quotes. Raw text of a scenario never is a `PyExpr` or a `PyName`.
"""

from __future__ import annotations

import keyword
import math
from decimal import Decimal

from osc2tx_shared.classes import dataclass
from osc2tx_shared.text import visible

LONGEST_DIGITS = 10  # a number that takes more characters is written with an exponent


@dataclass(frozen=True, slots=True)
class PyName:
    """A Python identifier."""

    text: str

    def __post_init__(self) -> None:
        """Reject texts that are no identifier.

        Raises:
            ValueError: The text is no identifier, or a keyword.
        """
        if not self.text.isidentifier() or keyword.iskeyword(self.text):
            raise ValueError(f"{self.text!r} is not a Python identifier")

    def __str__(self) -> str:
        """The identifier."""
        return self.text


@dataclass(frozen=True, slots=True)
class PyExpr:
    """A Python expression.

    Attributes:
        text: The source.
        level: How tightly its outermost operator binds, see `Level`.
    """

    text: str
    level: int

    def __str__(self) -> str:
        """The source."""
        return self.text

    def within(self, level: int) -> str:
        """Return the source, in parentheses if it binds less tightly than `level`."""
        return self.text if self.level >= level else f"({self.text})"


class Level:
    """Precedence levels of Python's grammar, loosest first."""

    LAMBDA = 0
    CONDITIONAL = 1
    OR = 2
    AND = 3
    NOT = 4
    COMPARISON = 5
    SUM = 6
    TERM = 7
    UNARY = 8
    ATOM = 9


def literal(value: bool | int | float | str) -> PyExpr:
    """Return a literal; strings are quoted as black does it, infinities and NaN spelled out."""
    if isinstance(value, float) and not math.isfinite(value):
        return PyExpr(f'float("{value!r}")', Level.ATOM)
    if isinstance(value, str):
        return PyExpr(_string(value), Level.ATOM)
    text = _float(value) if isinstance(value, float) else repr(value)
    return PyExpr(text, Level.UNARY if text.startswith("-") else Level.ATOM)


def _string(value: str) -> str:
    """Quote a string; with `'` only where it has quotes itself."""
    quoted = repr(value)
    return quoted if '"' in value or quoted.startswith('"') else f'"{quoted[1:-1]}"'


def _float(value: float) -> str:
    """Spell a finite number as a person would: `0.0000475`, and `4.75e-9` where that is long."""
    mantissa, _, exponent = repr(value).partition("e")
    if not exponent:
        return mantissa
    digits = format(Decimal(repr(value)), "f")
    return digits if len(digits) <= LONGEST_DIGITS else f"{mantissa}e{int(exponent)}"


def name_expression(name: PyName) -> PyExpr:
    """Return a bare name as an expression."""
    return PyExpr(name.text, Level.ATOM)


def self_attribute(name: PyName) -> PyExpr:
    """Return `self.name`."""
    return PyExpr(f"self.{name}", Level.ATOM)


@dataclass(frozen=True, slots=True)
class PyComment:
    """One line for a `#` comment, or part of a docstring."""

    text: str

    @classmethod
    def of(cls, text: str) -> PyComment:
        """Make a comment of one line of text."""
        return cls(visible(text.rstrip().replace("\t", " ")))

    def __str__(self) -> str:
        """`# text`, or a bare `#` for an empty line."""
        return f"# {self.text}" if self.text else "#"


@dataclass(frozen=True, slots=True)
class PyDocLine:
    """One line of a docstring, unable to end it."""

    text: str

    @classmethod
    def of(cls, text: str) -> PyDocLine:
        """Make a docstring line of one line of text."""
        plain = visible(text.rstrip().replace("\t", " "))
        escaped = plain.replace("\\", "\\\\").replace('"""', r"\"\"\"")
        return cls(f"{escaped} " if escaped.endswith('"') else escaped)  # `"""` may come next

    def __str__(self) -> str:
        """The escaped line."""
        return self.text
