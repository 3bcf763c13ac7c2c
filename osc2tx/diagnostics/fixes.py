"""Corrections of a source text as data.

A `Remedy` is the help of a diagnostic together with the edits that carry it out, where these are
known. `write`, `insert` and `leave_out` make the common ones.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TypeAlias

from osc2tx.diagnostics.source import Span
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True)
class Edit:
    """A span of a source text, and the text that replaces it; an empty span is an insertion."""

    span: Span
    text: str


@dataclass(frozen=True, slots=True)
class Fix:
    """A correction that removes a diagnostic.

    Attributes:
        title: What it does, for a menu: lower case, code words in backticks.
        edits: Its edits; none overlaps another one.
        is_safe: Whether the author can only have meant the result. A name that is merely similar
            to the written one is not safe.
    """

    title: str
    edits: tuple[Edit, ...]
    is_safe: bool = True


@dataclass(frozen=True, slots=True)
class Remedy:
    """The help of a diagnostic, one line, and the corrections that carry it out."""

    help: str
    fixes: tuple[Fix, ...] = ()


Help: TypeAlias = "Remedy | str | None"
"""The help of a diagnostic: text alone, or with its corrections."""


def write(span: Span, text: str, help: str | None = None, *, is_safe: bool = True) -> Remedy:
    """Return the remedy that replaces a span; its help is "write `…`" unless another is given.

    A text with `…` leaves a part to the author, and is help alone.
    """
    title = f"write `{text}`"
    if "…" in text:
        return Remedy(help or title)
    return Remedy(help or title, (Fix(title, (Edit(span, text),), is_safe),))


def insert(span: Span, text: str, help: str, *, is_safe: bool = True) -> Remedy:
    """Return the remedy that inserts a text behind a span."""
    behind = Span(span.source, span.end, span.end)
    return Remedy(help, (Fix(f"insert `{text.strip()}`", (Edit(behind, text),), is_safe),))


def insert_before(span: Span, text: str, help: str, *, is_safe: bool = True) -> Remedy:
    """Return the remedy that inserts a text before a span."""
    return insert(Span(span.source, span.start, span.start), text, help, is_safe=is_safe)


def leave_out(span: Span, help: str, *, is_safe: bool = True) -> Remedy:
    """Return the remedy that deletes a span."""
    title = f"leave `{span.text.strip()}` out"
    return Remedy(help, (Fix(title, (Edit(span, ""),), is_safe),))


def write_one_of(span: Span, texts: Sequence[str]) -> Remedy:
    """Return the remedy that offers several texts in place of a span."""
    listed = ", ".join(f"`{text}`" for text in texts)
    fixes = (Fix(f"write `{text}`", (Edit(span, text),), is_safe=False) for text in texts)
    return Remedy(f"write one of {listed}", tuple(fixes))


def rewrite(edits: Iterable[Edit], help: str, *, is_safe: bool = True) -> Remedy:
    """Return the remedy of several edits; its title is its help."""
    return Remedy(help, (Fix(help, tuple(edits), is_safe),))


def apply_edits(text: str, edits: Iterable[Edit]) -> str:
    """Return a text with edits carried out.

    Raises:
        ValueError: If two edits overlap.
    """
    parts: list[str] = []
    at = 0
    for edit in sorted(edits, key=lambda each: (each.span.start, each.span.end)):
        if edit.span.start < at:
            raise ValueError("edits overlap")
        parts += [text[at : edit.span.start], edit.text]
        at = edit.span.end
    return "".join([*parts, text[at:]])


def compatible(fixes: Sequence[Fix]) -> list[Fix]:
    """Return the fixes, in order of place, that can be applied together.

    Of fixes that touch the same text the first one is kept; the others are found again after it.
    """
    kept: list[Fix] = []
    taken: list[Span] = []
    for fix in sorted(fixes, key=lambda each: min(edit.span.start for edit in each.edits)):
        spans = [edit.span for edit in fix.edits]
        if any(
            one.start <= other.end and other.start <= one.end for one in spans for other in taken
        ):
            continue
        kept.append(fix)
        taken += spans
    return kept
