"""Library files, one for each catalog: types of its entities, and its environments."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import field
from pathlib import Path
from typing import NamedTuple

from osc2tx.importing.names import Names, actions_of
from osc2tx.importing.report import ImportReport
from osc2tx.importing.statements import INDENT
from osc2tx_shared.classes import dataclass


class Entry(NamedTuple):
    """What a library has for an entry of its catalog.

    Attributes:
        name: Its name.
        kind: The type whose actions it has, or that has it as an action.
    """

    name: str
    kind: str


@dataclass
class Library:
    """What a library file declares.

    Attributes:
        name: Name of its file and of its namespace.
        lines: Lines by the names of what it declares.
        entries: What it has by the names in the catalog; of environments also by what they do,
            which the parameters of an entry change.
    """

    name: str
    lines: dict[str, list[str]] = field(default_factory=dict)
    entries: dict[tuple[str, ...], Entry] = field(default_factory=dict)

    @property
    def text(self) -> str:
        """The text of the file."""
        lines = [
            "import osc.standard.all",
            f"namespace {self.name} use std, stdtypes",
            "",
            f"export {', '.join(self.lines)}",
        ]
        for text in self.lines.values():
            lines += ["", *text]
        return "\n".join(lines) + "\n"


Libraries = dict[Path, Library]
"""Library files by the catalogs that they are made from."""


class Shared:
    """What library files have for a document.

    Attributes:
        imports: The libraries that the scenario needs.
    """

    def __init__(self, libraries: Libraries) -> None:
        self._libraries = libraries
        self.imports: set[str] = set()

    def type_of(self, path: Path, said: str) -> Entry | None:
        """Return the type of actors that there is for an entry of a catalog."""
        return self._known(path, (said,))

    def new_type(self, path: Path, said: str, kind: str, base: str, body: Sequence[str]) -> Entry:
        """Return a new type of actors.

        Args:
            path: The catalog.
            said: The entry.
            kind: The type whose actions it has.
            base: What it inherits.
            body: What it declares.
        """
        name = self._new(path, said, "entity type")
        lines = [f"actor {name} inherits {base}:", *_indented(body, 1)]
        return self._add(path, (said,), Entry(name, kind), lines)

    def behavior(self, path: Path, said: str, actor: str, calls: Sequence[str]) -> Entry:
        """Return what an actor does.

        Args:
            path: The catalog.
            said: The entry.
            actor: The type of the actor.
            calls: What it does, one after the other.
        """
        key = (said, *calls)
        if known := self._known(path, key):
            return known
        name = self._new(path, said, actor, actions_of(actor))
        lines = [f"scenario {actor}.{name}:", f"{INDENT}do serial:", *_indented(calls, 2)]
        return self._add(path, key, Entry(name, actor), lines)

    def _known(self, path: Path, key: tuple[str, ...]) -> Entry | None:
        library = self._libraries.get(path)
        found = None if library is None else library.entries.get(key)
        if library is not None and found is not None:
            self.imports.add(library.name)
        return found

    def _new(self, path: Path, said: str, word: str, taken: Iterable[str] = ()) -> str:
        """Return the name for a new entry of the library of a catalog, which is there then."""
        if path not in self._libraries:
            others = {each.name for each in self._libraries.values()}
            self._libraries[path] = Library(_named(path.stem, "library", others))
        declared = {name for each in self._libraries.values() for name in each.lines}
        return _named(said, word, declared.union(taken))

    def _add(self, path: Path, key: tuple[str, ...], entry: Entry, lines: list[str]) -> Entry:
        library = self._libraries[path]
        library.lines[entry.name] = lines
        library.entries[key] = entry
        self.imports.add(library.name)
        return entry


def _named(said: str, kind: str, taken: Iterable[str]) -> str:
    return Names(ImportReport(""), taken).new(said, kind=kind)


def _indented(lines: Sequence[str], indent: int) -> list[str]:
    return [f"{INDENT * indent}{each}" for each in lines]
