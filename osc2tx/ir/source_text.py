"""Source text shortened for trees, timelines and traces."""

from __future__ import annotations

import re

from osc2tx.diagnostics import Span

MAX_LENGTH = 90
_BROKEN_BRACKET = re.compile(r"(?<=[(\[])\s*\n\s*|\s*\n\s*(?=[)\]])")
_BLANKS = re.compile(r"\s+")


def condensed(text: str) -> str:
    """Return text on one line: blanks for white space, none where a bracket was broken."""
    joined = _BROKEN_BRACKET.sub("", text) if "\n" in text else text  # most are on one line
    return _BLANKS.sub(" ", joined)


def shorten(text: str) -> str:
    """Cut a name that would be too long for a tree or a timeline."""
    return text if len(text) <= MAX_LENGTH else f"{text[: MAX_LENGTH - 1]}…"


def one_line(text: str) -> str:
    """Return the first line of a statement."""
    first, _, rest = text.partition("\n")
    return first.strip() + (" …" if rest.strip() else "")


def statement_name(span: Span) -> str:
    """Return the text of a statement on one line."""
    return shorten(condensed(span.text))
