"""Reader of the source map beside a generated module.

It only contains positions: without it, messages and traces only name the file.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping, Sequence
from dataclasses import field
from pathlib import Path
from typing import Any, TypeGuard
from weakref import WeakKeyDictionary

from osc2tx_runtime.errors import SourcePlace
from osc2tx_shared.classes import dataclass

VERSION = 3

Entry = tuple[int, int]
"""Line and column, both from 1; None for an element from another file."""


@dataclass(frozen=True, slots=True)
class SourceMap:
    """The map of one scenario.

    Attributes:
        file: Scenario file, as shown in messages.
        fields: Line and column of the fields, by name.
        constraints: Positions of the `keep` calls, in order.
        placements: Positions of the `place` calls, in order.
        nodes: Positions of the nodes, in pre-order.
        modifiers: Positions of the modifiers of an action, by its index among the nodes.
    """

    file: str
    fields: Mapping[str, Entry] = field(default_factory=dict)
    constraints: tuple[Entry | None, ...] = ()
    placements: tuple[Entry | None, ...] = ()
    nodes: tuple[Entry | None, ...] = ()
    modifiers: Mapping[int, tuple[Entry | None, ...]] = field(default_factory=dict)

    def place(self, entry: Entry | None) -> str:
        """Return `file:line` with its column, or only the file."""
        return self.file if entry is None else SourcePlace(self.file, *entry)

    def of_field(self, name: str) -> str:
        """Return the position of a field."""
        return self.place(self.fields.get(name))

    def of_placement(self, index: int) -> str:
        """Return the place of a `place` call."""
        return self.place(_at(self.placements, index))

    def of_constraint(self, index: int) -> str:
        """Return the place of a `keep` call."""
        return self.place(_at(self.constraints, index))


_MAPS: WeakKeyDictionary[type, SourceMap] = WeakKeyDictionary()
"""Cache by class, for repeated invocations."""


def read_source_map(scenario: type, name: str, file: str) -> SourceMap:
    """Read the map beside the module of a scenario class, once for each class.

    A missing or unreadable map is not an error, nor is that of another module.

    Args:
        scenario: The class.
        name: Name of the scenario in the map.
        file: Scenario file.
    """
    if scenario not in _MAPS:
        _MAPS[scenario] = _read(scenario, name, file)
    return _MAPS[scenario]


def _read(scenario: type, name: str, file: str) -> SourceMap:
    module = sys.modules.get(scenario.__module__)
    path = getattr(module, "__file__", None)
    if path is None:
        return SourceMap(file)
    loader = getattr(module, "__loader__", None)  # a debugger runs modules without one
    read = getattr(loader, "get_data", _bytes_of)
    try:
        content = json.loads(read(str(Path(path).with_suffix(".map.json"))))
    except (OSError, ValueError, RecursionError):
        return SourceMap(file)
    if not isinstance(content, dict) or content.get("version") != VERSION:
        return SourceMap(file)
    return parse_source_map(_table(_table(content.get("scenarios")).get(name)), file)


def _bytes_of(path: str) -> bytes:
    return Path(path).read_bytes()


def parse_source_map(entry: Mapping[str, Any], file: str) -> SourceMap:
    """Return the map of one scenario from its JSON object; invalid entries are omitted."""
    fields = _table(entry.get("fields"))
    return SourceMap(
        file=file,
        fields={name: (entry[0], entry[1]) for name, entry in fields.items() if _is_entry(entry)},
        constraints=_places(entry.get("constraints")),
        placements=_places(entry.get("placements")),
        nodes=_places(entry.get("nodes")),
        modifiers={
            int(index): _places(places)
            for index, places in _table(entry.get("modifiers")).items()
            if index.isdecimal()
        },
    )


def _table(value: Any) -> Mapping[str, Any]:
    return value if isinstance(value, dict) else {}


def _is_entry(value: Any) -> TypeGuard[Sequence[int]]:
    is_pair = isinstance(value, list) and len(value) == 2
    return is_pair and all(isinstance(number, int) for number in value)


def _places(value: Any) -> tuple[Entry | None, ...]:
    if not isinstance(value, list) or not all(each is None or _is_entry(each) for each in value):
        return ()
    return tuple(None if each is None else (each[0], each[1]) for each in value)


def _at(places: tuple[Entry | None, ...], index: int) -> Entry | None:
    return places[index] if index < len(places) else None
