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
    if one is other:
        return True
    if type(one) is not type(other):
        return False
    if isinstance(one, Span):
        place, where = (one.start, one.end), (other.start, other.end)
        return place == where and one.source.name == other.source.name
    if isinstance(one, tuple):
        return len(one) == len(other) and all(map(same, one, other))
    if is_dataclass(one):
        names = (field.name for field in fields(one))
        return all(same(getattr(one, name), getattr(other, name)) for name in names)
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
