"""The position at which the parser stopped, and the message about it."""

from __future__ import annotations

from typing import NamedTuple

from osc2tx.diagnostics import Span
from osc2tx.diagnostics.fixes import Help
from osc2tx.syntax import tokens as t
from osc2tx.syntax.tokens import TokenTable

_OPENERS = {t.PUNCTUATION[text] for text in ("(", "[")}
CLOSERS = {t.PUNCTUATION[text] for text in (")", "]")}
NUMBERS = frozenset({t.INTEGER, t.FLOAT})
TYPES = {t.KEYWORDS[word] for word in ("struct", "actor", "scenario", "action")}


class Advice(NamedTuple):
    """The content of a diagnostic.

    Attributes:
        message: The message.
        help: The remedy.
        token: Index of the token to point at, if it is not the unexpected one.
    """

    message: str
    help: Help = None
    token: int | None = None


class Place(NamedTuple):
    """Where the parser stopped.

    Attributes:
        table: All tokens.
        at: Index of the token that does not fit.
        line: Index of the first token of its logical line.
    """

    table: TokenTable
    at: int
    line: int

    def kind(self, distance: int = 0) -> int:
        """Return the type of a token near the place."""
        index = self.at + distance
        return self.table.types[index] if 0 <= index < len(self.table.types) else t.EOF

    def text(self, distance: int = 0) -> str:
        """Return the text of a token near the place."""
        return self.table.text(self.at + distance)

    def span(self, first: int = 0, last: int | None = None) -> Span:
        """Return the span of tokens near the place, from one distance to another one."""
        end = first if last is None else last
        return self.table.span(self.at + first, self.at + end)

    def between(self, first: int, last: int = 0) -> Span:
        """Return the span between the tokens at two distances, without them."""
        table = self.table
        return Span(table.source, table.ends[self.at + first], table.starts[self.at + last])

    def behind(self, distance: int = 0) -> Span:
        """Return the empty span right behind a token near the place."""
        end = self.table.ends[self.at + distance]
        return Span(self.table.source, end, end)

    def open_bracket(self) -> int | None:
        """Return the index of the innermost bracket of the line that is open here."""
        depth = 0
        for index in range(self.at - 1, self.line - 1, -1):
            if self.table.types[index] in CLOSERS:
                depth += 1
            elif self.table.types[index] in _OPENERS:
                if depth == 0:
                    return index
                depth -= 1
        return None
