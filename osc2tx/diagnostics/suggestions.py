"""Suggestions for misspelt names."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import lru_cache
from itertools import chain, islice, pairwise

from osc2tx.diagnostics.fixes import Remedy, write
from osc2tx.diagnostics.source import Span

LIKENESS = 0.6
_LISTED = 8
_COMPARED = 32  # names that are each compared with the written one
_COUNTED = 1000  # names with a pair of letters in common


def nearest(written: str, known: Iterable[str], likeness: float = LIKENESS) -> str | None:
    """Return the known name that is most similar to the written one, if any is similar.

    Of many names only those are compared that have the most pairs of letters in common with it, so
    that a file in which every name is unknown takes no longer than its length.

    Args:
        written: The unknown name.
        known: The names there are; equally near ones are decided by the alphabet.
        likeness: How alike they must be, from 0 to 1.
    """
    if len(written) < 2:
        return None  # every short name is near
    from difflib import get_close_matches  # only needed where something is wrong

    every = frozenset(known)
    names = _promising(written, every) if len(every) > _COMPARED else sorted(every)
    return next(iter(get_close_matches(written, names, 1, likeness)), None)


def _promising(written: str, names: frozenset[str]) -> list[str]:
    """Return the names with the most pairs of letters in common, in the order of the alphabet.

    Frequent pairs are less significant: they count only while there are few names.
    """
    from collections import Counter

    index = _names_by_pair(names)
    found = sorted((index.get(pair, ()) for pair in sorted(_pairs(written))), key=len)
    shared = Counter(islice(chain.from_iterable(found), _COUNTED))
    return sorted(name for name, _ in shared.most_common(_COMPARED))


@lru_cache(maxsize=8)
def _names_by_pair(names: frozenset[str]) -> Mapping[str, list[str]]:
    index: dict[str, list[str]] = {}
    for name in sorted(names):
        for pair in _pairs(name):
            index.setdefault(pair, []).append(name)
    return index


def _pairs(name: str) -> set[str]:
    """Return the pairs of adjacent letters, the first and the last one also alone."""
    return {"".join(pair) for pair in pairwise(f" {name} ")}


def did_you_mean(written: str, known: Iterable[str], likeness: float = LIKENESS) -> str | None:
    """Return a line of help with the nearest name, if there is one; see `nearest`."""
    close = nearest(written, known, likeness)
    return f"did you mean `{close}`?" if close else None


def name_meant(
    written: Span, known: Iterable[str], likeness: float = LIKENESS, *, is_safe: bool = False
) -> Remedy | None:
    """Return the remedy that replaces a name in the source by the nearest one; see `nearest`."""
    close = nearest(written.text, known, likeness)
    return write(written, close, f"did you mean `{close}`?", is_safe=is_safe) if close else None


def one_of(what: str, known: Iterable[str]) -> str | None:
    """Return a line of help that lists the known names, unless they are too many."""
    names = [f"`{name}`" for name in known]
    return f"{what} {', '.join(names)}" if 0 < len(names) <= _LISTED else None
