"""Indentation and blank lines of the whole text."""

from __future__ import annotations

from collections.abc import Sequence

from osc2tx.formatter.layout import INDENT_WIDTH, lay_out
from osc2tx.formatter.lines import LogicalLine

_MOST_AT_FILE_LEVEL = 2
_MOST_IN_BLOCKS = 1


def join_lines(lines: Sequence[LogicalLine]) -> str:
    """Return the text of all lines.

    Blank lines stay where they are, up to two between the statements of a file and one inside of
    blocks; none begins a block, and one sets a declaration with a block apart from its neighbours.
    """
    text: list[str] = []
    before: LogicalLine | None = None
    wants_blank = False  # a declaration with a block has ended
    for line in lines:
        wants_blank = wants_blank or (before is not None and _ends_block(before, line))
        starts_block = before is None or before.opens_block
        apart = before is not None and line.depth == 0 and line.opens_block
        for comment in line.above:
            least = (wants_blank or apart) and comment.depth == 0 and not comment.belongs_above
            _add_blanks(text, comment.comment.blank_lines, comment.depth, least, starts_block)
            text.append(_indented(comment.comment.text, comment.depth))
            starts_block = False
            if comment.depth == 0 and not comment.belongs_above:
                wants_blank = apart = False
        if line.pieces:
            least = (wants_blank or apart) and line.depth == 0
            _add_blanks(text, line.blank_lines, line.depth, least, starts_block)
            text += lay_out(line)
            wants_blank = False
        before = line
    return "".join(f"{line}\n" for line in text)


def _ends_block(before: LogicalLine, line: LogicalLine) -> bool:
    return before.depth > line.depth == 0


def _add_blanks(text: list[str], wanted: int, depth: int, least: bool, starts_block: bool) -> None:
    most = _MOST_IN_BLOCKS if depth else _MOST_AT_FILE_LEVEL
    number = 0 if starts_block else min(max(wanted, least), most)
    text += [""] * number


def _indented(comment: str, depth: int) -> str:
    return " " * (INDENT_WIDTH * depth) + comment
