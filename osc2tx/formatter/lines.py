"""Logical lines: tokens up to the next line end, with comments."""

from __future__ import annotations

from dataclasses import field

from osc2tx.formatter.token_gaps import Comment, Gap, read_gap
from osc2tx.syntax.comments import Between, share
from osc2tx.syntax.tokens import DEDENT, EOF, INDENT, NEWLINE, TokenTable
from osc2tx_classes import dataclass

_LAYOUT = frozenset({INDENT, DEDENT, NEWLINE, EOF})


@dataclass(frozen=True, slots=True)
class Piece:
    """A token, with what the source had before it on the same logical line.

    Attributes:
        kind: Its type.
        text: Its text.
        comments: Comments between it and the token before.
        joined: Whether it stood on a line of its own behind a backslash.
    """

    kind: int
    text: str
    comments: tuple[Comment, ...] = ()
    joined: bool = False


@dataclass(frozen=True, slots=True)
class CommentLine:
    """A comment on a line of its own, between two logical lines.

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
    """Begin a line; comments above it are indented like what they belong to.

    A block comment that stands before a statement on its line goes above it.
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
