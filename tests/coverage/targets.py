"""What scenarios are compiled to, one column of the tables each.

A target says of a scenario and of an item of the library what becomes of it. Another one is added
to `TARGETS`: nothing else changes.
"""

from __future__ import annotations

from typing import Protocol

from osc2tx.backends.py_trees.naming import identifier
from osc2tx.catalogue import catalogue, object_tables
from osc2tx.catalogue.constructors import (
    STRUCT_CLASSES,
)
from tests.coverage.library import Item, heirs
from tests.coverage.sources import Source


class Target(Protocol):
    """A column."""

    name: str

    def scenario(self, source: Source) -> str:
        """What becomes of a scenario: `yes`, or the codes that refuse it."""

    def item(self, item: Item) -> str:
        """What becomes of an item: `runs`, or the code that refuses it or parts of it."""


class PyTrees:
    """Python modules on the runtime library, by the table of what the runtime carries out."""

    name = "py_trees"

    def scenario(self, source: Source) -> str:
        """Whether it makes a module."""
        return "yes" if source.builds else ", ".join(source.errors)

    def item(self, item: Item) -> str:
        """By its kind; the codes are those of the backend's check of what the runtime knows."""
        match item.kind:
            case "action":
                return self._action(item)
            case "modifier":
                return self._modifier(item)
            case "method":
                return self._method(item)
            case "field":
                return self._field(item)

    def _action(self, item: Item) -> str:
        if item.name in catalogue().abstract:
            return "abstract"
        entry = catalogue().actions.get(item.name)
        return "OSC507" if entry is None else _all_but(item, entry.arguments)

    def _modifier(self, item: Item) -> str:
        entry = catalogue().modifiers.get(item.name.rpartition(".")[2])
        return "OSC508" if entry is None else _all_but(item, entry.parameters)

    def _method(self, item: Item) -> str:
        known = object_tables().methods.get(item.name)
        return "OSC503" if known is None else _all_but(item, known, "OSC503")

    def _field(self, item: Item) -> str:
        owner, _, name = item.name.partition(".")
        runtime = object_tables()
        kind = next((heir for heir in heirs(owner) if heir in runtime.objects), None)
        if kind is None:
            return "OSC501"
        readable = owner in STRUCT_CLASSES or item.name in runtime.fields
        settable = identifier(name) in runtime.objects[kind]
        ways = [way for way, can in (("read", readable), ("fixed", settable)) if can]
        codes = [code for code, can in (("OSC503", readable), ("OSC502", settable)) if not can]
        return "; ".join(part for part in (" and ".join(ways), ", ".join(codes)) if part)


def _all_but(item: Item, known: frozenset[str], code: str = "OSC509") -> str:
    """`runs`, with the parameters that are refused."""
    refused = [f"`{name}`" for name in item.parameters if not {name, identifier(name)} & known]
    return "runs" if not refused else f"runs; {code}: {', '.join(refused)}"


TARGETS: tuple[Target, ...] = (PyTrees(),)
