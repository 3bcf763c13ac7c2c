"""Precedence, literals and spans of expressions."""

import math

import pytest

from osc2tx.syntax import ast
from osc2tx.syntax.literals import integer_value, split_name, split_physical, string_value
from tests.unit.syntax.helpers import expression, infix, parsed


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("a + b * c - d", "((a + (b * c)) - d)"),
        ("a * b / c % d", "(((a * b) / c) % d)"),
        ("a - b - c", "((a - b) - c)"),
        ("-a * -b", "((- a) * (- b))"),
        ("- -a", "(- (- a))"),
        ("not a == b", "(not (a == b))"),
        ("not not a", "(not (not a))"),
        ("not a and b", "((not a) and b)"),
        ("a < b == c", "((a < b) == c)"),
        ("a in b and c or d", "(((a in b) and c) or d)"),
        ("a => b => c", "(a => (b => c))"),
        ("a or b => c or d", "((a or b) => (c or d))"),
        ("a ? b : c ? d : e", "(a ? b : (c ? d : e))"),
        ("a => b ? c : d", "((a => b) ? c : d)"),
        ("(a + b) * c", "((a + b) * c)"),
        ("a + -b + c", "((a + (- b)) + c)"),
        ("-a + b < c", "(((- a) + b) < c)"),
    ],
)
def test_precedence(text: str, expected: str) -> None:
    assert infix(expression(text)) == expected


def test_spans_include_parentheses_of_operands() -> None:
    node = expression("(a + b) * (c)")
    assert isinstance(node, ast.Binary)
    assert node.span.text == "(a + b) * (c)"
    assert node.left.span.text == "a + b"
    member = expression("(a).b")
    assert member.span.text == "(a).b"


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("0", 0),
        ("0x1F", 31),
        ("18446744073709551615", 2**64 - 1),
        (".5", 0.5),
        ("1e3", 1000.0),
        ("inf", math.inf),
        ("true", True),
        (r"'a\n\t\\\'\x41\u0042\103'", "a\n\t\\'ABC"),
        ("'\\q'", "q"),
        ('"""a\r\nb"""', "a\nb"),
        ("'''a\\\nb'''", "ab"),
    ],
)
def test_literals(text: str, value: object) -> None:
    node = expression(f"x == {text}")
    assert isinstance(node, ast.Binary)
    assert node.right.value == value  # type: ignore[union-attr]
    assert type(node.right.value) is type(value)  # type: ignore[union-attr]


def test_physical_literals_keep_their_kind_of_number() -> None:
    for text, number, unit in [("35kph", 35, "kph"), ("3.0|km/h|", 3.0, "km/h"), ("2em", 2, "em")]:
        node = expression(text)
        assert isinstance(node, ast.PhysicalLiteral)
        assert (node.value, type(node.value), node.unit.text) == (number, type(number), unit)
        assert node.unit.span.text == text.lstrip("0123456789.")


@pytest.mark.parametrize(
    "text", ["18446744073709551616", "-9223372036854775809", "1e999", "9" * 9999]
)
def test_limits(text: str) -> None:
    assert [d.code for d in parsed(f"struct s:\n    keep(a == {text})\n")[1]] == ["OSC107"]


def test_the_least_integer_fits() -> None:
    node = expression("-9223372036854775808")
    assert isinstance(node, ast.Unary) and isinstance(node.operand, ast.IntegerLiteral)
    assert node.operand.value == 2**63


def test_literal_helpers() -> None:
    assert split_physical("1.5e3std::|a b|") == ("1.5e3", "std::|a b|")
    assert split_name("::a") == ("null", "a")
    assert split_name("|a::b|") == (None, "a::b")
    assert split_name("|a b|::|c|") == ("a b", "c")
    assert integer_value("1" * 5000) is None
    assert string_value("'\\ud800\\U7FFFFFFF'") == "\ufffd\ufffd"
    assert string_value('"open') == "open"


@pytest.mark.parametrize(
    ("text", "length"),
    [("a" + " + a" * 20_000, 20_000), ("a" + ".b" * 20_000, 0), ("a" + " => a" * 20_000, 20_000)],
)
def test_long_chains(text: str, length: int) -> None:
    node = expression(text)
    count = 0
    while isinstance(node, ast.Binary):
        node = node.right if isinstance(node.right, ast.Binary) else node.left
        count += 1
    assert count == length
