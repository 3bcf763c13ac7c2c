"""Which statement a comment belongs to; the syntax tree and the formatter go by the same rule.

A comment behind code, or inside a statement of several lines, belongs to that statement. Comment
lines between two statements belong to the one below, but for two kinds:

- Lines indented deeper than the statement below belong to the block that ends there: to the
  innermost one that is not indented deeper than they are. Where no block ends they belong to the
  statement above.
- Lines that touch the statement above (no blank line between) and not the one below belong to
  the statement above.

Tabs go to multiples of 8, as for code (§7.2.1.3).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import groupby, takewhile
from typing import Generic, NamedTuple, Protocol, TypeVar

from osc2tx.syntax.suppressions import is_suppression
from osc2tx.syntax.tokens import DEDENT, EOF, INDENT, Comment, TokenTable


class CommentLine(Protocol):
    """A comment on a line of its own."""

    @property
    def column(self) -> int:
        """Its indentation."""

    @property
    def blank_lines(self) -> int:
        """Number of blank lines above it."""


Line = TypeVar("Line", bound=CommentLine)


class Between(NamedTuple):
    """The surroundings of the comment lines between two statements.

    Attributes:
        closed: Columns of the blocks that end here, innermost first.
        column: Column of the statement below.
        follows: Whether a statement of the same block, or a block that ends here, is above.
        blank_lines: Number of blank lines above the statement below.
    """

    closed: tuple[int, ...]
    column: int
    follows: bool
    blank_lines: int


class Shared(NamedTuple, Generic[Line]):
    """The comment lines of a gap by their owner.

    Attributes:
        ends: Those at the ends of blocks, as `Between.closed`.
        deeper: Those of the statement above that are indented deeper than the one below.
        touching: Those of the statement above that are not.
        above: Those of the statement below.
    """

    ends: tuple[list[Line], ...]
    deeper: list[Line]
    touching: list[Line]
    above: list[Line]


def share(lines: Sequence[Line], gap: Between) -> Shared[Line]:
    """Return the owners of the comment lines of a gap."""
    if not gap.follows:
        return Shared((), [], [], list(lines))
    shared: Shared[Line] = Shared(tuple([] for _ in gap.closed), [], [], [])
    deeper = list(takewhile(lambda line: line.column > gap.column, lines))
    block = 0
    for line in deeper:
        while block < len(gap.closed) - 1 and line.column < gap.closed[block]:
            block += 1
        (shared.ends[block] if gap.closed else shared.deeper).append(line)
    rest = lines[len(deeper) :]
    size = _touching(rest)
    if size < len(rest) or gap.blank_lines:
        shared.touching.extend(rest[:size])
        rest = rest[size:]
    shared.above.extend(rest)
    return shared


def _touching(lines: Sequence[CommentLine]) -> int:
    """Return how many lines, from the first on, have no blank line above them."""
    return next((n for n, line in enumerate(lines) if line.blank_lines), len(lines))


class CommentTable:
    """The comments of a file by the tokens that they belong to."""

    def __init__(self, table: TokenTable) -> None:
        """Share out the comments of a file, those apart that suppress a diagnostic."""
        self._above: dict[int, list[Comment]] = {}
        self._inside: dict[int, list[Comment]] = {}
        self._ends: dict[int, list[Comment]] = {}
        self._below: dict[int, list[Comment]] = {}  # by the token that follows the statement
        self._apart = set[int]()  # statements below a blank line below their comments
        prose = (comment for comment in table.comments if not is_suppression(comment.text))
        for (line, before), comments in groupby(prose, lambda c: (c.line, c.before)):
            if line is None:
                self._share(table, before, list(comments))
            else:
                self._inside.setdefault(line, []).extend(comments)

    def _share(self, table: TokenTable, before: int, comments: Sequence[Comment]) -> None:
        below = before
        while table.types[below] == DEDENT:
            below += 1
        opens = table.types[below] == INDENT
        gap = Between(
            closed=tuple(table.widths[token] for token in range(before, below)),
            column=0 if table.types[below] == EOF else table.indentation(table.starts[before]),
            follows=before > 0 and not opens,
            blank_lines=table.blank_lines.get(before, 0),
        )
        shared = share(comments, gap)
        self._below[below] = [*shared.deeper, *shared.touching]
        if table.types[below] == EOF:
            self._below[below] += shared.above
        else:
            self._above[below + opens] = shared.above
        if shared.above and gap.blank_lines and gap.column:
            self._apart.add(below + opens)
        self._ends.update(zip(range(before, below), shared.ends, strict=False))

    def above(self, token: int) -> tuple[str, ...]:
        """Return the comments above the statement that starts at a token.

        In a block, an empty line ends them if a blank line parts them from the statement.
        """
        texts = _texts(self._above.get(token, ()))
        return (*texts, "") if token in self._apart else texts

    def below(self, token: int) -> tuple[str, ...]:
        """Return the comments below the statement that ends before a token."""
        return _texts(self._below.get(token, ()))

    def inside(self, token: int) -> list[Comment]:
        """Return the comments inside the logical line that starts at a token."""
        return self._inside.get(token, [])

    def at_end_of_block(self, dedent: int) -> tuple[str, ...]:
        """Return the comments at the end of the block that a token closes, for its owner."""
        return _texts(self._ends.pop(dedent, ()))

    def pass_end_comments_on(self, dedent: int) -> None:
        """Give those at the end of a block whose owner has no place for them to its last member."""
        self._below[dedent] = [*self._below.get(dedent, ()), *self._ends.pop(dedent, ())]

    def hand_on(self, line: int, statement: int) -> None:
        """Give the comments of a logical line that is no statement to the statement below it."""
        mine = [*self._above.pop(line, ()), *self._inside.pop(line, ())]
        self._above[statement] = [*mine, *self._above.get(statement, ())]


def _texts(comments: Iterable[Comment]) -> tuple[str, ...]:
    """Return the lines of comments, with an empty one where blank lines part them."""
    lines: list[str] = []
    for comment in comments:
        lines += ["", comment.text] if lines and comment.blank_lines else [comment.text]
    return tuple(lines)
