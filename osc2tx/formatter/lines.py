"""Logical lines: tokens up to the next line end, with comments."""

from __future__ import annotations

import re
from dataclasses import field

from osc2tx.syntax.comments import Between, share
from osc2tx.syntax.tokens import DEDENT, EOF, INDENT, NEWLINE, TokenTable
from osc2tx_shared.classes import dataclass

_ITEM = re.compile(
    r"(?P<comment>\#[^\r\n]*+|/\*.*?\*/)|(?P<join>\\)?(?P<end>\r\n|\r|\n)", re.DOTALL
)
_UNSPACED = ("#!", "#:", "##")  # comments that mean something to tools, or draw a line


@dataclass(frozen=True, slots=True)
class Comment:
    """A comment as it will be written.

    Attributes:
        text: With its `#`; or a block comment, as one dialect has them.
        column: Where it stood, from 0; tabs go to multiples of 8.
        alone: Whether nothing preceded it on its line.
        blank_lines: Number of blank lines above it.
    """

    text: str
    column: int
    alone: bool
    blank_lines: int

    @property
    def is_block(self) -> bool:
        """Whether code can follow it on its line."""
        return self.text.startswith("/*")


@dataclass(frozen=True, slots=True)
class Gap:
    """The text between two tokens.

    Attributes:
        comments: The comments, in order.
        blank_lines: Number of blank lines below the last comment, or in all if there is none.
        joined: Whether a backslash joins two lines here (§9.2.2.5).
    """

    comments: tuple[Comment, ...]
    blank_lines: int
    joined: bool


def read_gap(text: str, start: int, end: int) -> Gap:
    """Return the parts between two offsets of a text without tokens."""
    comments: list[Comment] = []
    blanks, joined = 0, False
    line_start = max(text.rfind("\n", 0, start), text.rfind("\r", 0, start)) + 1
    is_empty = not text[line_start:start].strip("\ufeff")  # so far on this line
    for item in _ITEM.finditer(text, start, end):
        if item["end"] is not None:
            blanks += is_empty and item["join"] is None
            joined = joined or item["join"] is not None
            line_start, is_empty = item.end(), True
            continue
        column = len(text[line_start : item.start()].expandtabs())
        comments.append(Comment(_written(item["comment"]), column, is_empty, blanks))
        blanks, is_empty = 0, False
    return Gap(tuple(comments), blanks, joined)


def _written(comment: str) -> str:
    """A comment with one blank behind its `#` and none at its end (§9.2.2.4)."""
    comment = comment.rstrip()
    if not comment.startswith("#") or comment.startswith(_UNSPACED) or len(comment) == 1:
        return comment
    body = comment[1:]
    return f"# {body[1:]}" if body[0] in " \t" else f"# {body}"


_LAYOUT = frozenset({INDENT, DEDENT, NEWLINE, EOF})


@dataclass(frozen=True, slots=True)
class Piece:
    """A token, with the preceding comments of the same logical line.

    Attributes:
        kind: Its type.
        text: Its text.
        comments: Comments between it and the token before.
        joined: Whether it began a line behind a backslash.
    """

    kind: int
    text: str
    comments: tuple[Comment, ...] = ()
    joined: bool = False


@dataclass(frozen=True, slots=True)
class CommentLine:
    """A comment line between two logical lines.

    Attributes:
        depth: Number of blocks around it.
        comment: The comment.
        belongs_above: Whether it belongs to the line above (`osc2tx.syntax.comments`).
    """

    depth: int
    comment: Comment
    belongs_above: bool = False


@dataclass(slots=True)
class LogicalLine:
    """A logical line.

    Attributes:
        depth: Number of blocks around it.
        blank_lines: Number of blank lines above it.
        pieces: Its tokens.
        trailing: Comments behind the last one.
        above: Comment lines between it and the line before.
        opens_block: Whether a block follows.
    """

    depth: int
    blank_lines: int
    above: list[CommentLine]
    pieces: list[Piece] = field(default_factory=list)
    trailing: tuple[Comment, ...] = ()
    opens_block: bool = False


def read_lines(table: TokenTable) -> list[LogicalLine]:
    """Return the logical lines of a text; the last one has no tokens, only the last comments."""
    lines: list[LogicalLine] = []
    widths = [0]
    closed: list[int] = []  # widths of the blocks that end before the next line
    end = 0
    for index, kind in enumerate(table.types):
        if kind == INDENT:
            widths.append(table.widths[index])
            lines[-1].opens_block = True
        elif kind == DEDENT:
            closed.append(widths.pop())
        elif kind == NEWLINE:
            lines[-1].trailing = _gap(table, end, index).comments
            end = table.starts[index]  # the line end itself counts for the blank lines
        else:
            gap = _gap(table, end, index)
            if not lines or (lines[-1].pieces and table.types[index - 1] in _LAYOUT):
                follows = bool(lines) and not lines[-1].opens_block
                lines.append(_new_line(gap, widths, closed, follows=follows))
                gap = Gap((), 0, False)
                closed = []
            if kind != EOF:
                lines[-1].pieces.append(Piece(kind, table.text(index), gap.comments, gap.joined))
                end = table.ends[index]
    return lines


def _gap(table: TokenTable, end: int, index: int) -> Gap:
    return read_gap(table.source.text, end, table.starts[index])


def _new_line(gap: Gap, widths: list[int], closed: list[int], *, follows: bool) -> LogicalLine:
    """Begin a line; comments above it have the indentation of their statement.

    A block comment before a statement on its line moves above it.
    """
    depth = len(widths) - 1
    shared = share(gap.comments, Between(tuple(closed), widths[-1], follows, gap.blank_lines))
    above: list[CommentLine] = []
    for inner, comments in enumerate(shared.ends):
        inner_depth = depth + len(closed) - inner
        above += [CommentLine(inner_depth, comment) for comment in comments]
    above += [CommentLine(depth + 1, comment) for comment in shared.deeper]
    above += [CommentLine(depth, comment, belongs_above=True) for comment in shared.touching]
    above += [CommentLine(depth, comment) for comment in shared.above]
    return LogicalLine(depth, gap.blank_lines, above)
