"""Finds the comments `#! allow CODE, …: reason` of a source text."""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from typing import TYPE_CHECKING

from osc2tx.diagnostics import DiagnosticSink, SourceFile, Span
from osc2tx.diagnostics.suppressions import Suppression

if TYPE_CHECKING:
    from osc2tx.syntax.tokens import TokenTable

# The reason extends to the end of the line.
_COMMENT = re.compile(r"#![ \t]*allow(?![\w-])(?P<codes>[^:\r\n]*)[^\r\n]*")
_NAME = re.compile(r"[^\s,](?:[^,]*[^\s,])?")


def is_suppression(comment: str) -> bool:
    """Whether a comment, without its `#`, suppresses a diagnostic."""
    return _COMMENT.match(f"#{comment}") is not None


def find_suppressions(source: SourceFile) -> tuple[Suppression, ...]:
    """Return the suppressions of a text in order; a text without any is not scanned."""
    if _COMMENT.search(source.text) is None:
        return ()
    from osc2tx.syntax.token_source import TokenSource

    comments = _Comments(TokenSource(source, DiagnosticSink(), allow=("OSC111",)).scan())
    return tuple(
        Suppression(
            Span(source, match.start(), match.end()),
            tuple(
                Span(source, name.start(), name.end())
                for name in _NAME.finditer(source.text, *match.span("codes"))
            ),
            comments.lines_meant(match.start()),
        )
        for match in _COMMENT.finditer(source.text)
        if comments.has_one_at(match.start())
    )


class _Comments:
    """The positions of comments among the tokens."""

    def __init__(self, table: TokenTable) -> None:
        from osc2tx.syntax import tokens as t

        layout = {t.NEWLINE, t.INDENT, t.DEDENT, t.EOF}
        self._table = table
        self._words = [i for i, type_ in enumerate(table.types) if type_ not in layout]
        self._line_ends = [i for i, type_ in enumerate(table.types) if type_ == t.NEWLINE]

    def has_one_at(self, offset: int) -> bool:
        """Return whether a comment begins here: no token and no other comment holds the place."""
        table = self._table
        before = bisect_right(table.starts, offset) - 1
        end = table.ends[before] if before >= 0 else 0
        gap = table.source.text[max(end, table.line_start(offset)) : offset]
        return end <= offset and not gap.strip(" \t\f")

    def lines_meant(self, offset: int) -> range:
        """Return the line of a comment behind a statement, or else the lines of the next one."""
        table, source = self._table, self._table.source
        line = source.position(offset)[0]
        if source.text[table.line_start(offset) : offset].strip():
            return range(line, line + 1)
        first = bisect_left(self._words, bisect_left(table.starts, offset))
        if first == len(self._words):
            return range(0)
        token = self._words[first]
        line = source.position(table.starts[token])[0]
        number = bisect_left(self._line_ends, token)
        line_before = self._line_ends[number - 1] if number else -1
        if first > 0 and self._words[first - 1] > line_before:  # within brackets
            return range(line, line + 1)
        ends = self._line_ends[number] if number < len(self._line_ends) else len(table.types)
        return range(line, source.position(table.starts[ends - 1])[0] + 1)
