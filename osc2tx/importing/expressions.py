"""Expressions of attributes: sums and products of numbers and parameters."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, TypeAlias

from osc2tx.xosc.arithmetic import Evaluation
from osc2tx_shared.classes import dataclass


class Untyped(Exception):
    """An expression that has no form in the language; its value has."""


class Term:
    """An expression as an operand of others."""

    __slots__ = ()

    def __add__(self, other: Expression) -> Expression:
        return _operation("+", self, other)

    def __sub__(self, other: Expression) -> Expression:
        return _operation("-", self, other)

    def __mul__(self, other: Expression) -> Expression:
        return _operation("*", self, other)

    def __truediv__(self, other: Expression) -> Expression:
        return _operation("/", self, other)

    def __neg__(self) -> Expression:
        return _operation("-", Number(0.0), self)


@dataclass(frozen=True, slots=True)
class Number(Term):
    """A number of an expression."""

    value: float


@dataclass(frozen=True, slots=True)
class Name(Term):
    """A parameter of an expression."""

    name: str


@dataclass(frozen=True, slots=True)
class Operation(Term):
    """Two operands of an expression with their sign."""

    sign: str
    left: Expression
    right: Expression


Expression: TypeAlias = Number | Name | Operation


class _Terms(Evaluation[Any]):
    """Sums and products as terms."""

    def _literal(self, token: str) -> Number:
        return Number(float(token))

    def _named(self, name: str) -> Name:
        return Name(name)


def parsed(text: str) -> Expression:
    """Return the expression of an attribute.

    Raises:
        Untyped: It has none of sums, products, numbers and parameters.
    """
    try:
        if text.startswith("${") and text.endswith("}"):
            found: Expression = _Terms(text[2:-1], {}).run()
            return found
        return Name(text[1:]) if text.startswith("$") else Number(float(text))
    except (ArithmeticError, ValueError):
        raise Untyped(text) from None


def _operation(sign: str, left: Any, right: Any) -> Expression:
    """Return an operation, computed if both operands are numbers; its sign comes first."""
    if isinstance(left, Number) and isinstance(right, Number):
        a, b = left.value, right.value
        computed = {"+": a + b, "-": a - b, "*": a * b}.get(sign)
        return Number(a / b if computed is None else computed)
    if sign in "*/":
        bare_left, bare_right = (without_sign(each) or each for each in (left, right))
        is_negative = (bare_left is left) != (bare_right is right)
        found: Expression = Operation(sign, bare_left, bare_right)
        if bare_right == Number(1.0):
            found = bare_left
        elif sign == "*" and bare_left == Number(1.0):
            found = bare_right
        return Operation("-", Number(0.0), found) if is_negative else found
    return Operation(sign, left, right)


def substituted(node: Expression, given: Mapping[str, Expression]) -> Expression:
    """Return an expression with others in the places of names."""
    if isinstance(node, Name):
        return given.get(node.name, node)
    if isinstance(node, Operation):
        left, right = substituted(node.left, given), substituted(node.right, given)
        return Operation(node.sign, left, right)
    return node


def without_sign(node: Expression) -> Expression | None:
    """Return what an expression is the negative of; `None`: it has no sign."""
    if isinstance(node, Number):
        return Number(-node.value) if node.value < 0.0 else None
    if isinstance(node, Name):
        return None
    if node.sign == "-" and node.left == Number(0.0):
        return node.right
    if node.sign not in "*/":
        return None
    left = without_sign(node.left)
    if left is not None:
        return Operation(node.sign, left, node.right)
    right = without_sign(node.right)
    return None if right is None else Operation(node.sign, node.left, right)


def names_in(node: Expression) -> Iterator[str]:
    """Yield the parameters in an expression."""
    if isinstance(node, Name):
        yield node.name
    elif isinstance(node, Operation):
        yield from names_in(node.left)
        yield from names_in(node.right)


def is_per_hour(node: Expression) -> bool:
    """Whether an expression divides kilometres per hour by 3.6."""
    return (
        isinstance(node, Operation)
        and node.sign == "/"
        and isinstance(node.right, Number)
        and abs(node.right.value - 3.6) < 1e-9
    )


def joined_by(word: str, texts: Sequence[str]) -> str:
    """Return expressions joined by `and` or `or`, those of the other one in brackets."""
    other = {"and": " or ", "or": " and "}[word]
    if len(texts) == 1:
        return texts[0]
    return f" {word} ".join(f"({text})" if other in text else text for text in texts)
