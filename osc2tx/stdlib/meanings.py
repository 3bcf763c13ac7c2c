"""Meanings of the library that its texts do not state, from `members.toml`."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path

COMMON, DECLARATIONS = "members", "declarations"


class Meanings:
    """Meanings by declaration and member.

    Args:
        tables: By declaration, by the name of the member; `members` for all declarations,
            `declarations` for what these mean.
    """

    def __init__(self, tables: Mapping[str, Mapping[str, str]]) -> None:
        self.tables = tables

    def of(self, owner: str, member: str) -> str:
        """Return the meaning of a member; empty if there is none."""
        own = self.tables.get(owner, {}).get(member)
        return own if own is not None else self.tables[COMMON].get(member, "")

    def of_value(self, enum: str, value: str) -> str:
        """Return the meaning of a value of an enum; empty if its name is the meaning."""
        return self.tables.get(enum, {}).get(value, "")

    def of_declaration(self, name: str) -> str:
        """Return the meaning of a declaration; empty if there is none."""
        return self.tables[DECLARATIONS].get(name, "")


@cache
def member_meanings() -> Meanings:
    """Return the meanings that come with the library."""
    import tomllib  # a check needs no meanings

    path = Path(__file__).parent / "members.toml"
    return Meanings(tomllib.loads(path.read_text(encoding="utf-8")))
