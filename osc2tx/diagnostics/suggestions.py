"""Suggestions for misspelt names."""

from __future__ import annotations

from collections.abc import Iterable

LIKENESS = 0.6
_LISTED = 8


def nearest(written: str, known: Iterable[str], likeness: float = LIKENESS) -> str | None:
    """Return the known name that looks most like what is written, if any does.

    Args:
        written: The unknown name.
        known: The names there are; equally near ones are decided by the alphabet.
        likeness: How alike they must be, from 0 to 1.
    """
    if len(written) < 2:
        return None  # every short name is near
    from difflib import get_close_matches  # only needed where something is wrong

    return next(iter(get_close_matches(written, sorted(set(known)), 1, likeness)), None)


def did_you_mean(written: str, known: Iterable[str], likeness: float = LIKENESS) -> str | None:
    """Return a line of help with the nearest name, if there is one; see `nearest`."""
    close = nearest(written, known, likeness)
    return f"did you mean `{close}`?" if close else None


def one_of(what: str, known: Iterable[str]) -> str | None:
    """Return a line of help that lists what there is, if it is not too much to read."""
    names = [f"`{name}`" for name in known]
    return f"{what} {', '.join(names)}" if 0 < len(names) <= _LISTED else None
