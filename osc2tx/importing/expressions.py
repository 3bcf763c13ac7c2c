"""Expressions of attributes: sums and products of numbers and parameters."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import TypeAlias

from osc2tx.xosc.arithmetic import CONSTANTS
from osc2tx_shared.classes import dataclass

_TOKEN = re.compile(r"\s*(\$?[A-Za-z_]\w*|(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?|[-+*/(),%])")


class Untyped(Exception):
    """An expression that has no form in the language; its value has."""


@dataclass(frozen=True, slots=True)
class Number:
    """A number of an expression."""

    value: float


@dataclass(frozen=True, slots=True)
class Name:
    """A parameter of an expression."""

    name: str


@dataclass(frozen=True, slots=True)
class Operation:
    """Two operands of an expression with their sign."""

    sign: str
    left: Expression
    right: Expression


Expression: TypeAlias = Number | Name | Operation


def parsed(text: str) -> Expression:
    """Return the expression of an attribute.

    Raises:
        Untyped: It has none of sums, products, numbers and parameters.
    """
    if text.startswith("${") and text.endswith("}"):
        return _Parser(text[2:-1]).run()
    if text.startswith("$"):
        return Name(text[1:])
    try:
        return Number(float(text))
    except ValueError:
        raise Untyped(text) from None


class _Parser:
    """Recursive descent over sums and products."""

    def __init__(self, text: str) -> None:
        self._tokens = _TOKEN.findall(text)
        if "".join(self._tokens) != re.sub(r"\s", "", text):
            raise Untyped(text)
        self._at = 0
        self._depth = 0

    def run(self) -> Expression:
        found = self._sum()
        if self._at < len(self._tokens):
            raise Untyped(self._next)
        return found

    @property
    def _next(self) -> str:
        return self._tokens[self._at] if self._at < len(self._tokens) else ""

    def _sum(self) -> Expression:
        value = self._product()
        while self._next in ("+", "-"):
            sign = self._take()
            value = _operation(sign, value, self._product())
        return value

    def _product(self) -> Expression:
        value = self._atom()
        while self._next in ("*", "/"):
            sign = self._take()
            value = _operation(sign, value, self._atom())
        return value

    def _take(self) -> str:
        token = self._next
        self._at += 1
        return token

    def _atom(self) -> Expression:
        self._depth += 1
        token = self._take()
        if self._depth > 50:
            raise Untyped("too deep")
        try:
            if token in ("-", "+"):
                inner = self._atom()
                return inner if token == "+" else _operation("-", Number(0.0), inner)
            if token == "(":
                inner = self._sum()
                if self._take() != ")":
                    raise Untyped("(")
                return inner
            if token.startswith("$"):
                return Name(token[1:])
            if token in CONSTANTS:
                return Number(CONSTANTS[token])
            if token[:1].isdigit() or token[:1] == ".":
                return Number(float(token))
            raise Untyped(token)
        finally:
            self._depth -= 1


def _operation(sign: str, left: Expression, right: Expression) -> Expression:
    """Return an operation, computed if both operands are numbers; its sign comes first."""
    if isinstance(left, Number) and isinstance(right, Number):
        a, b = left.value, right.value
        if sign == "/" and b == 0.0:
            raise Untyped("division by zero")
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
