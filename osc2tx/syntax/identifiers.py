"""Characters of plain identifiers (§7.2.1.5.1)."""

from __future__ import annotations

from unicodedata import category

_START = frozenset({"Ll", "Lm", "Lo", "Lt", "Lu", "Nl"})
_CONTINUE = _START | {"Mc", "Mn", "Nd", "Pc"}


def identifier_end(text: str, start: int) -> int:
    """Return the offset behind the identifier at `start`; `start` itself if there is none."""
    if start >= len(text) or not (text[start] == "_" or category(text[start]) in _START):
        return start
    end = start + 1
    while end < len(text) and category(text[end]) in _CONTINUE:
        end += 1
    return end
