"""Assigns the comments of a file to its statements, in order (see `CommentCursor`)."""

from __future__ import annotations

from osc2tx.syntax.tokens import Comment, TokenTable


class CommentCursor:
    """The comments not yet given to a node.

    A comment line belongs to the next statement. At the end of a block it belongs to the block when
    it is indented like it, and to what follows when it is not. A comment inside a statement of
    several lines belongs to that statement.
    """

    def __init__(self, table: TokenTable) -> None:
        """Start before the first comment."""
        self._comments = table.comments
        self._next = 0

    def _peek(self) -> Comment | None:
        return self._comments[self._next] if self._next < len(self._comments) else None

    def above(self, token: int) -> tuple[str, ...]:
        """Take the comments before the statement that starts at a token."""
        found: list[str] = []
        while (comment := self._peek()) and comment.before <= token:
            found.append(comment.text)
            self._next += 1
        return tuple(found)

    def inside(self, line: int) -> list[Comment]:
        """Take the comments inside the logical line that starts at a token."""
        found: list[Comment] = []
        while (comment := self._peek()) and comment.line == line:
            found.append(comment)
            self._next += 1
        return found

    def at_end_of_block(self, end: int, width: int) -> tuple[str, ...]:
        """Take the comments before the end of a block, as long as they are indented like it."""
        found: list[str] = []
        while (comment := self._peek()) and comment.before <= end and comment.column >= width:
            found.append(comment.text)
            self._next += 1
        return tuple(found)

    def skip(self, token: int) -> None:
        """Drop the comments up to a token: those of a statement that could not be read."""
        while (comment := self._peek()) and comment.before <= token:
            self._next += 1

    def rest(self) -> tuple[str, ...]:
        """Take all that is left."""
        found = tuple(comment.text for comment in self._comments[self._next :])
        self._next = len(self._comments)
        return found
