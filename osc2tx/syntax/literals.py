"""Values of literals (§7.2.1.5.2): escapes, numbers and the limits of their types."""

from __future__ import annotations

import re

MAX_UINT = 2**64 - 1
MAX_NEGATED = 2**63

_ESCAPE = re.compile(
    r"\\(?:(\r\n|\r|\n)|x([0-9a-fA-F]{2})|u([0-9a-fA-F]{4})|U([0-9a-fA-F]{8})|([0-7]{1,3})|(.))",
    re.DOTALL,
)
_SIMPLE = {"n": "\n", "t": "\t", "r": "\r", "a": "\a", "b": "\b", "f": "\f", "v": "\v"}
_NUMBER = re.compile(r"0x[0-9a-fA-F]++|[0-9]*+(?:\.[0-9]++)?(?:[eE][+-]?[0-9]++)?")
_MAX_DIGITS = 400


def string_value(literal: str) -> str:
    """Return the value of a string literal; escapes are those of Python.

    A backslash before any other character denotes that character (the standard calls each such pair
    an escape sequence without naming its value).
    """
    quotes = 3 if literal.startswith(('"""', "'''")) and len(literal) >= 6 else 1
    closed = len(literal) >= 2 * quotes and literal.endswith(literal[:quotes])
    body = literal[quotes:-quotes] if closed else literal[quotes:]
    if "\r" in body:
        body = body.replace("\r\n", "\n").replace("\r", "\n")
    return _ESCAPE.sub(_unescape, body) if "\\" in body else body


def _unescape(match: re.Match[str]) -> str:
    line_end, *codes, octal, other = match.groups()
    if line_end:
        return ""
    for digits in codes:
        if digits:
            value = int(digits, 16)
            is_character = value <= 0x10FFFF and not 0xD800 <= value <= 0xDFFF
            return chr(value) if is_character else "\ufffd"
    if octal:
        return chr(int(octal, 8))
    return _SIMPLE.get(other, other)


def is_integer(number: str) -> bool:
    """Whether a number has neither point nor exponent."""
    return number.isdigit() or number.startswith("0x")


def integer_value(literal: str) -> int | None:
    """Return the value of an integer literal; `None` if it has too many digits for any type."""
    if literal.startswith("0x"):
        return int(literal, 16)
    return int(literal) if len(literal) <= _MAX_DIGITS else None


def split_physical(literal: str) -> tuple[str, str]:
    """Split `35kph` into number and unit."""
    match = _NUMBER.match(literal)
    assert match is not None
    end = match.end()
    if not literal[end:]:  # pragma: no cover - the scanner always finds a unit
        return literal, ""
    return literal[:end], literal[end:]


def split_name(text: str) -> tuple[str | None, str]:
    """Split a possibly qualified identifier into namespace and name, bars removed."""
    if "::" not in text or (text.startswith("|") and text.count("|") == 2 and text.endswith("|")):
        return None, text.strip("|")
    prefix, _, name = text.rpartition("::")
    return prefix.strip("|") or "null", name.strip("|")
