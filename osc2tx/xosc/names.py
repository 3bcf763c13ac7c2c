"""Names of elements, unique in a document."""

from __future__ import annotations

import re

_ILLEGAL = re.compile(r"[^A-Za-z0-9_]+")


def plain(text: str) -> str:
    """Return the closest name that every tool can read: `[A-Za-z_][A-Za-z0-9_]*`."""
    cleaned = _ILLEGAL.sub("_", text).strip("_")
    return cleaned if cleaned and not cleaned[0].isdigit() else f"x_{cleaned}"


class Names:
    """Hands out names; a name that is taken gets a number."""

    def __init__(self, *, folds_case: bool = False) -> None:
        """Start with nothing taken; names of files must differ in more than case."""
        self._taken: set[str] = set()
        self._numbers: dict[str, int] = {}  # the last one of a name
        self._key = str.lower if folds_case else str

    def new(self, preferred: str) -> str:
        """Return a name that is not taken yet."""
        base = name = plain(preferred)
        number = self._numbers.get(self._key(base), 1)
        while self._key(name) in self._taken:
            number += 1
            name = f"{base}_{number}"
        self._numbers[self._key(base)] = number
        self._taken.add(self._key(name))
        return name
