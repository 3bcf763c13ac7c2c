"""Structural comparison of parts of the IR: nodes themselves compare by identity."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any

from osc2tx.diagnostics import Span


def same(one: Any, other: Any) -> bool:
    """Return whether two parts say the same about the same places of the same files.

    The files may have been read twice, for two modules.
    """
    return _same(one, other, ())


def means_same(one: Any, other: Any) -> bool:
    """Return whether two parts say the same, wherever that stands and whatever explains it."""
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
    if is_dataclass(one):
        names = (field.name for field in fields(one) if field.name not in apart_from)
        return all(_same(getattr(one, n), getattr(other, n), apart_from) for n in names)
    return bool(one == other)


def words(part: Any) -> Iterator[str]:
    """Yield all names and texts in a part: whatever it refers to by name is among them."""
    if isinstance(part, str):
        yield part
    elif isinstance(part, tuple):
        for each in part:
            yield from words(each)
    elif is_dataclass(part):
        for field in fields(part):
            yield from words(getattr(part, field.name))
