"""Formats scenario files after the style guide of the standard (§9.2).

Input: a `SourceFile` without syntax errors. Output: the same tokens and comments in the same order,
laid out anew; nothing is renamed, reordered or dropped.

Stages, in order:

1. `read_lines` (`lines`): tokens and the text between them to logical lines.
2. `lay_out` (`layout`): a logical line to one or several physical lines, with the blanks of
   `spacing`.
3. `join_lines`: indentation and blank lines between them.

Invariants: formatting a formatted text changes nothing; its tokens and comments are those
of the source, which is checked before the text is returned.
"""

from __future__ import annotations

from collections.abc import Sequence

from osc2tx.diagnostics import DiagnosticSink, InternalCompilerError, SourceFile
from osc2tx.formatter.layout import INDENT_WIDTH, lay_out
from osc2tx.formatter.lines import LogicalLine, read_lines
from osc2tx.syntax.token_source import TokenSource
from osc2tx.syntax.tokens import TokenTable

__all__ = ["format_source"]


def format_source(source: SourceFile) -> str:
    """Return the text of a file in the style of the guide (§9.2.2), with LF line ends.

    Args:
        source: The text, without syntax errors.
    """
    table = _scan(source)
    formatted = join_lines(read_lines(table))
    if _content(_scan(SourceFile(source.name, formatted))) != _content(table):
        raise InternalCompilerError(f"formatting changes the content of {source.name}")
    return formatted


def _scan(source: SourceFile) -> TokenTable:
    return TokenSource(source, DiagnosticSink(), allow=("OSC111",)).scan()


def _content(table: TokenTable) -> tuple[object, ...]:
    """The content that formatting keeps: the tokens, and the comments at their owners."""
    layout = {
        index
        for index, text in enumerate(map(table.text, range(len(table.types))))
        if not text.strip()
    }  # line ends and blocks: their types count, not their characters
    tokens = [
        (kind, "" if index in layout else table.text(index))
        for index, kind in enumerate(table.types)
    ]
    return tokens, [(comment.before, comment.text) for comment in table.comments]


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
