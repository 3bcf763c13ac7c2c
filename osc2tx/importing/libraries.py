"""The library file of imported scenarios: types of what stands in other files, and what repeats.

These are the entities and environments of catalogs, the maps, and the start of an actor. A
scenario that takes nothing from a catalog stays a file of its own.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import field
from pathlib import Path
from typing import NamedTuple, TypeAlias

from osc2tx.importing.names import Names, actions_of
from osc2tx.importing.report import ImportReport
from osc2tx.importing.statements import INDENT
from osc2tx_shared.classes import dataclass

COMMON = "common"
"""The name of the library file, and of its namespace."""
HEAD = ("import osc.standard.all", f"namespace {COMMON} use std, stdtypes", "", "export *")
BEGIN, CRUISE = "begin", "cruise"
"""What puts an actor at a point with a speed, and what keeps it at this speed."""
_AT_ONCE = ("assign_position(odr_point: at)", "assign_speed(speed)")
STARTS = {BEGIN: _AT_ONCE, CRUISE: (*_AT_ONCE, "keep_speed()")}
_NAME = re.compile(r"(?:actor|scenario) (?:\w+\.)?(\w+)")


Key: TypeAlias = tuple[Path | str, ...]
"""What stands for an entry: its catalog and its name there, or its declaration."""


class Entry(NamedTuple):
    """What the library has for an entry of a catalog.

    Attributes:
        name: Its name.
        kind: The type whose actions it has, or that has it as an action.
    """

    name: str
    kind: str


@dataclass
class Library:
    """What the library file declares.

    Attributes:
        lines: Lines by the names of what it declares.
        scenarios: Names of the scenarios, which its declarations do not have.
        entries: What it has by catalogs and the names in them; of environments also by what they
            do, which the parameters of an entry change.
    """

    lines: dict[str, Sequence[str]] = field(default_factory=dict)
    scenarios: set[str] = field(default_factory=set)
    entries: dict[Key, Entry] = field(default_factory=dict)

    @property
    def text(self) -> str:
        """The text of the file."""
        parts = (line for part in self.lines.values() for line in ("", *part))
        return "\n".join((*HEAD, *parts, ""))

    def beside(self, text: str) -> str | None:
        """Return the text of the file with what it declares already; `None`: they differ.

        Args:
            text: The text of the file so far, of other documents.
        """
        head, *parts = re.split(r"\n\n(?=[as])", text.removesuffix("\n"))
        told = {found[1]: part for part in parts if (found := _NAME.match(part))}
        own = {name: "\n".join(lines) for name, lines in self.lines.items()}
        is_alike = all(told.get(name, part) == part for name, part in own.items())
        if head != "\n".join(HEAD) or len(told) != len(parts) or not is_alike:
            return None
        return "\n\n".join((head, *(told | own).values())) + "\n"


class Shared:
    """What the library has for a document.

    Attributes:
        is_used: Whether the scenario needs it.
    """

    def __init__(self, library: Library) -> None:
        self._library = library
        self.is_used = False

    def known(self, *key: Path | str) -> Entry | None:
        """Return what the library has by a key."""
        found = self._library.entries.get(key)
        self.is_used |= found is not None
        return found

    def type_of(self, key: Key, said: str, kind: str, base: str, body: Sequence[str]) -> Entry:
        """Return the type of actors by a key, a new one if there is none yet.

        Args:
            key: A catalog and its entry; of an entity that is in none, all its facts.
            said: What it is called.
            kind: The type whose actions it has.
            base: What it inherits.
            body: What it declares.
        """
        head = f"actor {{}} inherits {base}:"
        return self._entry(key, said, kind, "entity type", (head, *_indented(body, 1)))

    def behavior(self, path: Path, said: str, actor: str, calls: Sequence[str]) -> Entry:
        """Return what an actor does.

        Args:
            path: The catalog.
            said: The entry.
            actor: The type of the actor.
            calls: What it does, one after the other.
        """
        lines = (f"scenario {actor}.{{}}:", f"{INDENT}do serial:", *_indented(calls, 2))
        return self._entry((path, said, *calls), said, actor, actor, lines, actions_of(actor))

    def map_of(self, file: str) -> str:
        """Return the type of a map by the name of its file."""
        lines = ("actor {} inherits map:", f'{INDENT}keep(map_file == "{file}")')
        return self._entry((file,), f"{Path(file).stem}_map", "map", "type", lines).name

    def add_start(self, name: str) -> None:
        """Add a way in which actors begin."""
        self._library.lines[name] = (
            f"scenario movable_object.{name}:",
            *_indented(("at: odr_point", "speed: speed"), 1),
            "",
            f"{INDENT}do serial:",
            *_indented(STARTS[name], 2),
        )

    def _entry(
        self,
        key: Key,
        said: str,
        kind: str,
        word: str,
        lines: Sequence[str],
        taken: Iterable[str] = (),
    ) -> Entry:
        """Return what the library has by a key, or else a new declaration.

        Args:
            key: The key.
            said: What it is called in the document.
            kind: What its actions are of.
            word: What tells it from a word of the language, at the end of its name.
            lines: Its declaration; the first line has `{}` where its name stands.
            taken: Names that it cannot have, besides those of the library.
        """
        if known := self.known(*key):
            return known
        library = self._library
        names = Names(ImportReport(""), {*STARTS, *library.lines, *library.scenarios, *taken})
        entry = Entry(names.new(said, kind=word), kind)
        library.lines[entry.name] = (lines[0].format(entry.name), *lines[1:])
        library.entries[key], self.is_used = entry, True
        return entry


def _indented(lines: Sequence[str], indent: int) -> list[str]:
    return [f"{INDENT * indent}{each}" for each in lines]
