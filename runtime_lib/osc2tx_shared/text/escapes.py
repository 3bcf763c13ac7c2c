"""Unsafe characters, and their escapes."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable
from functools import cache

# Control, format (direction overrides, zero width, tags), surrogate, line and paragraph separator.
_UNSAFE = frozenset({"Cc", "Cf", "Cs", "Zl", "Zp"})

# What CI servers obey: GitHub `::name::` after blanks at the beginning of a line, and `##[name]`
# anywhere; Azure Pipelines and TeamCity `##vso[…]` and `##teamcity[…]`.
_LEADING_COMMAND = re.compile(r"\A(\s*)::")
_MARKED_COMMAND = re.compile(r"##(?=\w*\[)")


def visible(text: str) -> str:
    r"""Return a text that stays on its line and steers nothing, escaped as in a Python literal.

    A backslash stays as it is: this is for readers, and not to be undone.
    """
    return text if text.isprintable() else _replaced(text, lambda char: ascii(char)[1:-1])


def without_commands(line: str) -> str:
    """Return a line in which no CI server finds a command."""
    if "##" in line:
        line = _MARKED_COMMAND.sub(r"\\x23#", line)
    return _LEADING_COMMAND.sub(r"\1\\x3a:", line) if "::" in line else line


def in_json(document: str) -> str:
    r"""Return a JSON document of the same meaning, with unsafe characters as `\u` escapes."""
    lines = _MARKED_COMMAND.sub(r"\\u0023#", document).split("\n")
    return "\n".join(x if x.isprintable() else _replaced(x, _json_escape) for x in lines)


def in_xml(document: str) -> str:
    """Return an XML document of the same meaning, with unsafe characters as references.

    It must have no comments: references mean nothing there.
    """
    lines = document.split("\n")
    return "\n".join(x if x.isprintable() else _replaced(x, _xml_escape) for x in lines)


def _json_escape(char: str) -> str:
    units = char.encode("utf-16-be", "surrogatepass").hex()
    return "".join(f"\\u{units[at : at + 4]}" for at in range(0, len(units), 4))


def _xml_escape(char: str) -> str:
    return char if char == "\t" else f"&#{ord(char)};"


def _replaced(text: str, escape: Callable[[str], str]) -> str:
    return "".join(escape(char) if _is_unsafe(char) else char for char in text)


@cache
def _is_unsafe(char: str) -> bool:
    return unicodedata.category(char) in _UNSAFE
