"""Offsets of a source text as positions of the protocol, which counts UTF-16 code units from 0."""

from __future__ import annotations

from lsprotocol import types as lsp

from osc2tx.diagnostics import SourceFile, Span


def position_of(source: SourceFile, offset: int) -> lsp.Position:
    """Return the position of an offset."""
    line, column = source.position(offset)
    before = source.text[offset - column + 1 : offset]
    return lsp.Position(line - 1, len(before.encode("utf-16-le", "surrogatepass")) // 2)


def offset_of(source: SourceFile, position: lsp.Position) -> int:
    """Return the offset of a position; one beyond its line or the text means the end of that."""
    if position.line >= len(source.line_starts):
        return len(source.text)
    start = source.line_starts[position.line]
    units = 0
    for index, char in enumerate(source.line_text(position.line + 1)):
        if units >= position.character:
            return start + index
        units += 2 if ord(char) > 0xFFFF else 1
    return start + len(source.line_text(position.line + 1))


def range_of(span: Span) -> lsp.Range:
    """Return the range that a span covers."""
    return lsp.Range(position_of(span.source, span.start), position_of(span.source, span.end))


def whole(source: SourceFile) -> lsp.Range:
    """Return the range of a whole text."""
    return range_of(Span(source, 0, len(source.text)))
