"""Names of unlabelled nodes, taken from the text of the module.

`self.ego.drive(speed(self.v_ego))` makes a node `ego.drive(speed(v_ego))`, `Wait(rise(lambda:
self.ego.speed > 3))` one named `wait rise(ego.speed > 3)`. Names only serve readers: if Python has
no positions (`PYTHONNODEBUGRANGES`) or the text is missing, they are shorter.
"""

from __future__ import annotations

import linecache
import re
import sys
from collections.abc import Callable, Iterator
from types import CodeType
from typing import Any

RUNTIME = __name__.partition(".")[0]
MAX_LENGTH = 90
MEMBER = re.compile(r" {8}self\.(\w+)")  # a statement of a method

MOST_KEPT = 64  # functions with a table of positions

Position = tuple[int | None, int | None, int | None, int | None]
_positions: dict[int, tuple[CodeType, tuple[Position, ...]]] = {}  # by identity of the code


def call_arguments() -> str:
    """Return the arguments, with their parentheses, of the call that led into this library."""
    frame = sys._getframe(1)
    while _package(frame.f_globals) == RUNTIME and frame.f_back is not None:
        frame = frame.f_back
    position = _position(frame.f_code, frame.f_lasti)
    text = _text(frame.f_code, frame.f_globals, position)
    return _shorten(text[text.index("(") :]) if "(" in text else ""


def function_text(function: Callable[..., object]) -> str:
    """Return the expression of a lambda, `ego.speed > 3`; of any other function its name."""
    code = getattr(function, "__code__", None)
    name = str(getattr(function, "__name__", "function"))
    if code is None or name != "<lambda>":
        return name
    known = list(_known(code))
    if not known:
        return "condition"
    first = min((line, column) for line, _, column, _ in known)
    last = max((line, column) for _, line, _, column in known)
    position = (first[0], last[0], first[1], last[1])
    text = _text(code, getattr(function, "__globals__", {}), position)
    return _shorten(re.sub(r"^lambda[^:]*: ", "", text)) or "condition"


def failing_part(error: BaseException) -> tuple[str, str]:
    """Return the expression of a module that raised an error, and the member that it computes.

    The member is `keep` for a constraint, a name for the value of one; both may be empty.
    """
    text = member = ""
    trace = error.__traceback__
    while trace is not None:
        code, names = trace.tb_frame.f_code, trace.tb_frame.f_globals
        if _package(names) != RUNTIME:
            position = _position(code, trace.tb_lasti)
            text = _shorten(_text(code, names, position))
            if code.co_name == "declare":
                member = _member_at(code.co_filename, trace.tb_lineno, names)
        trace = trace.tb_next
    return text, member


def _position(code: CodeType, offset: int) -> Position:
    """Return the position of an instruction; a table of all positions speeds up further calls."""
    known = _positions.get(id(code))
    if known is None or known[0] is not code:
        if len(_positions) == MOST_KEPT:
            _positions.clear()
        known = _positions[id(code)] = (code, tuple(code.co_positions()))
    return known[1][offset // 2]


def _member_at(file: str, line: int, names: dict[str, Any]) -> str:
    """Return the member at the start of the statement at a line."""
    while line > 0:
        found = MEMBER.match(linecache.getline(file, line, names))
        if found is not None:
            return found[1]
        line -= 1
    return ""


def _package(names: dict[str, Any]) -> str:
    return str(names.get("__name__", "")).partition(".")[0]


def _known(code: CodeType) -> Iterator[tuple[int, int, int, int]]:
    """Yield the positions of what code computes."""
    for line, end_line, column, end_column in code.co_positions():
        if line is None or end_line is None or column is None or end_column is None:
            continue
        if (line, column) < (end_line, end_column):
            yield line, end_line, column, end_column


def _text(code: CodeType, names: dict[str, Any], position: Position) -> str:
    """Return the text at a position on one line, without `self.`; empty if unknown."""
    line, end_line, column, end_column = position
    if line is None or end_line is None or column is None or end_column is None:
        return ""
    file = code.co_filename
    lines = [
        linecache.getline(file, number, names).encode() for number in range(line, end_line + 1)
    ]
    lines[-1] = lines[-1][:end_column]
    lines[0] = lines[0][column:]
    return _condense([part.decode(errors="replace") for part in lines])


def _condense(lines: list[str]) -> str:
    """Join lines as black would without a limit; comments are omitted."""
    kept = (line.strip() for line in lines if not line.lstrip().startswith("#"))
    joined = re.sub(r"\s+", " ", " ".join(kept))
    joined = re.sub(r"(?<=[(\[]) |,? (?=[)\]])", "", joined)
    joined = joined.replace(" // ", " / ")  # of whole numbers: the scenario has one division
    return re.sub(r"\bself\.|\blambda: ", "", joined)


def _shorten(text: str) -> str:
    return text if len(text) <= MAX_LENGTH else f"{text[: MAX_LENGTH - 1]}…"
