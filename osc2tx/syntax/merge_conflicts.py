"""Finds unresolved merge conflicts in a text: two versions between markers of git."""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx.diagnostics import SourceFile, Span

_MARKERS = ("<<<<<<< ", "=======", ">>>>>>> ")


def merge_conflicts(source: SourceFile) -> Iterator[Span]:
    """Yield the first line of each conflict that has all three markers, in this order."""
    if f"\n{_MARKERS[0]}" not in f"\n{source.text}":
        return
    position, found = 0, None
    seen = 0  # of the markers
    for line in source.text.splitlines(keepends=True):
        if line.startswith(_MARKERS[0]):
            found, seen = Span(source, position, position + len(line.rstrip())), 1
        elif found is not None and line.startswith(_MARKERS[seen]):
            seen += 1
            if seen == len(_MARKERS):
                yield found
                found = None
        position += len(line)
