"""The last step: black where it may differ, and a check that the module is Python."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache
from typing import NamedTuple

from osc2tx.diagnostics import InternalCompilerError

LINE_LENGTH = 100
INDENT = 4
_OTHERWISE = re.compile(r"""['\\]|,[)\]}]|:\S""")
"""Text that black may change: quotes, escapes, commas before a bracket, slices."""
_PARTS = re.compile(r" (?:[-+*/%<>]|//|[<>=!]=|and|or|in|is|if|for) |\)\.")
"""Where black breaks an argument beside a comment, however short it is."""


def is_plain(text: str) -> bool:
    """Whether black changes nothing of some code but where its lines break."""
    return text.isascii() and _OTHERWISE.search(text) is None


def format_module(text: str) -> str:
    """Return a module of the templates in black's style.

    The templates write most statements as black does (`layout`). Only the others are formatted by
    black, which takes longer than the rest of a compilation.

    Raises:
        InternalCompilerError: The output of the templates is not Python.
    """
    try:
        tree = ast.parse(text)
    except SyntaxError as error:
        raise InternalCompilerError(f"generated module is not valid Python: {error}") from error
    lines = text.split("\n")
    parts = [part for each in _uncertain(tree.body, lines) for part in _parts(each, lines)]
    for part in reversed(parts):
        written = tuple(lines[part.first : part.last])
        in_style = _argument_in_style if part.is_argument else _in_style
        lines[part.first : part.last] = in_style(written, part.column)
    return "\n".join(lines)


class _Part(NamedTuple):
    """Lines that black formats.

    Attributes:
        first: The first line, from 0 on.
        last: The line behind the last one.
        column: Their column.
        is_argument: They are not a statement, but one of several arguments, with its comma.
    """

    first: int
    last: int
    column: int
    is_argument: bool


def _parts(statement: ast.stmt, lines: Sequence[str]) -> list[_Part]:
    """Return the parts of a statement that black formats: uncertain arguments, or all of it.

    Black lays each of several arguments out by itself, once their call has several lines.
    """
    assert statement.end_lineno is not None, "it was parsed"
    whole = _Part(_first_line(statement) - 1, statement.end_lineno, statement.col_offset, False)
    arguments = sorted(_arguments(statement, lines), key=lambda part: part.last - part.first)
    found: set[_Part] = set()
    for number in range(whole.first, whole.last):
        if _may_change(lines[number], *_beside(lines, number, number + 1)):
            around = (each for each in arguments if each.first <= number < each.last)
            found.add(next(around, whole))
    outer = [each for each in found if not any(_is_inside(each, other) for other in found)]
    return sorted(outer) if outer else [whole]


def _is_inside(part: _Part, other: _Part) -> bool:
    return part != other and other.first <= part.first and part.last <= other.last


def _arguments(statement: ast.stmt, lines: Sequence[str]) -> Iterator[_Part]:
    """Yield the arguments that have lines of their own, with a comma, and no comments beside."""
    for call in ast.walk(statement):
        if not isinstance(call, ast.Call):
            continue
        arguments: list[ast.expr | ast.keyword] = [*call.args, *call.keywords]
        for each in arguments if len(arguments) > 1 else ():
            assert each.end_lineno is not None, "it was parsed"
            first, last = each.lineno - 1, each.end_lineno
            is_alone = not lines[first][: each.col_offset].strip()
            has_comma = lines[last - 1].encode()[each.end_col_offset :] == b","
            if is_alone and has_comma and not any(map(_is_comment, _beside(lines, first, last))):
                yield _Part(first, last, each.col_offset, True)


def _beside(lines: Sequence[str], first: int, last: int) -> tuple[str, str]:
    """Return the line above some lines, and the one below them."""
    return lines[first - 1] if first else "", lines[last] if last < len(lines) else ""


def _uncertain(body: Iterable[ast.stmt], lines: list[str]) -> Iterator[ast.stmt]:
    """Yield the statements that black may write otherwise, the innermost ones."""
    for statement in body:
        inner: list[ast.stmt] = getattr(statement, "body", [])
        first, last = _first_line(statement) - 1, statement.end_lineno
        head = lines[first : _first_line(inner[0]) - 1 if inner else last]
        if _is_docstring(statement):
            if any(line.startswith(" " * (statement.col_offset + 1)) for line in head[1:]):
                yield statement
        elif any(map(_may_change, head, ("", *head), (*head[1:], ""))):
            yield statement
        else:
            yield from _uncertain(inner, lines)


def _first_line(statement: ast.stmt) -> int:
    decorators: list[ast.expr] = getattr(statement, "decorator_list", [])
    return decorators[0].lineno if decorators else statement.lineno


def _is_docstring(statement: ast.stmt) -> bool:
    match statement:
        case ast.Expr(value=ast.Constant(value=str())):
            return True
    return False


def _may_change(line: str, above: str, below: str) -> bool:
    """Whether black may change a line; it counts up to two columns for a character."""
    if _is_comment(line):
        return False
    if _OTHERWISE.search(line):
        return True
    if (_is_comment(above) or _is_comment(below)) and _PARTS.search(line):
        return True
    return len(line) * (1 if line.isascii() else 2) > LINE_LENGTH


def _is_comment(line: str) -> bool:
    return line.lstrip().startswith("#")


@lru_cache(maxsize=1024)  # many scenarios of a project have the same conditions
def _argument_in_style(lines: tuple[str, ...], column: int) -> list[str]:
    """Return an argument beside another one, formatted by black."""
    outer, inner = " " * (column - INDENT), " " * column
    return _in_style((f"{outer}_(", f"{inner}_,", *lines, f"{outer})"), column - INDENT)[2:-1]


def _in_style(lines: tuple[str, ...], column: int) -> list[str]:
    """Return the lines of a statement, formatted by black inside classes down to its column."""
    from black import format_str
    from black.mode import Mode, TargetVersion

    around = [f"{' ' * indent}class _:" for indent in range(0, column, INDENT)]
    mode = Mode(line_length=LINE_LENGTH, target_versions={TargetVersion.PY311})
    formatted = format_str("\n".join((*around, *lines, "")), mode=mode)
    return formatted.split("\n")[len(around) : -1]
