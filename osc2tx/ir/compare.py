"""Structural comparison of parts of the IR: nodes themselves compare by identity."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from osc2tx.diagnostics import Span


def same(one: Any, other: Any) -> bool:
    """Return whether two parts have the same meaning at the same positions of the same files.

    The files may have been read twice, for two modules; comments are only in that of their own.
    """
    return _same(one, other, ("comments", "end_comments"))


def means_same(one: Any, other: Any) -> bool:
    """Return whether two parts have the same meaning, at any positions and with any comments."""
    return _same(one, other, ("span", "comments", "applied"))


def _same(one: Any, other: Any, apart_from: tuple[str, ...]) -> bool:
    if one is other:
        return True
    if type(one) is not type(other):
        return False
    if isinstance(one, Span):
        place, where = (one.start, one.end), (other.start, other.end)
        return place == where and one.source.name == other.source.name
    if isinstance(one, tuple):
        pairs = zip(one, other, strict=False)
        return len(one) == len(other) and all(_same(a, b, apart_from) for a, b in pairs)
    if names := field_names(one):
        return all(
            _same(getattr(one, name), getattr(other, name), apart_from)
            for name in names
            if name not in apart_from
        )
    return bool(one == other)


def words(part: Any) -> Iterator[str]:
    """Yield all names and strings in a part, including those of its references."""
    pending = [part]
    while pending:
        each = pending.pop()
        if isinstance(each, str):
            yield each
        elif isinstance(each, tuple):
            pending += each
        elif not isinstance(each, Span):
            pending += [getattr(each, name) for name in field_names(each)]


def field_names(part: Any) -> Iterable[str]:
    """Return the fields of an instance of a dataclass; none of a plain value.

    `dataclasses.fields` makes a tuple at each call, which is most of what a comparison costs.
    """
    return getattr(part, "__dataclass_fields__", ())
