"""The last step: black where it may differ, and a check that the module is Python."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Iterator

from osc2tx.diagnostics import InternalCompilerError

LINE_LENGTH = 100
INDENT = 4
_OTHERWISE = re.compile(r"""['\\]|,[)\]}]|:\S""")
"""What black may write otherwise: quotes, escapes, commas before a bracket, slices."""
_PARTS = re.compile(r" (?:[-+*/%<>]|//|[<>=!]=|and|or|in|is|if|for) |\)\.")
"""Where black breaks an argument beside a comment, however short it is."""


def is_plain(text: str) -> bool:
    """Whether black changes nothing of some code but where its lines break."""
    return text.isascii() and _OTHERWISE.search(text) is None


def format_module(text: str) -> str:
    """Return a module of the templates in black's style.

    They write most statements as black does (`layout`). It is asked for the others only, for it
    takes longer than all else of a compilation.

    Raises:
        InternalCompilerError: The templates made something that is not Python.
    """
    try:
        tree = ast.parse(text)
    except SyntaxError as error:
        raise InternalCompilerError(f"generated module is not valid Python: {error}") from error
    lines = text.split("\n")
    for statement in reversed([*_doubtful(tree.body, lines)]):
        first, last = _first_line(statement) - 1, statement.end_lineno
        lines[first:last] = _in_style(lines[first:last], statement.col_offset)
    return "\n".join(lines)


def _doubtful(body: Iterable[ast.stmt], lines: list[str]) -> Iterator[ast.stmt]:
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
            yield from _doubtful(inner, lines)


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


def _in_style(lines: list[str], column: int) -> list[str]:
    """Return what black makes of the lines of a statement, in classes down to its column."""
    from black import format_str
    from black.mode import Mode, TargetVersion

    around = [f"{' ' * indent}class _:" for indent in range(0, column, INDENT)]
    mode = Mode(line_length=LINE_LENGTH, target_versions={TargetVersion.PY311})
    formatted = format_str("\n".join((*around, *lines, "")), mode=mode)
    return formatted.split("\n")[len(around) : -1]
