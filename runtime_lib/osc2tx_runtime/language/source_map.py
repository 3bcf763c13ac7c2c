"""Reader of the source map beside a generated module.

It holds numbers only and decides nothing: without it, messages and traces name the file alone.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

__all__ = ["SourceMap", "read_source_map"]

VERSION = 2


@dataclass(frozen=True, slots=True)
class SourceMap:
    """What the map says about one scenario.

    Attributes:
        file: Scenario file as shown to people.
        fields: Lines of the fields, by name.
        constraints: Lines of the `keep` calls, in their order.
        placements: Lines of the `place` calls, in their order.
        nodes: Lines of the nodes, in pre-order.
    """

    file: str
    fields: Mapping[str, int] = field(default_factory=dict)
    constraints: tuple[int, ...] = ()
    placements: tuple[int, ...] = ()
    nodes: tuple[int, ...] = ()

    def place(self, line: int | None) -> str:
        """Return `file:line`, or the file alone."""
        return self.file if line is None else f"{self.file}:{line}"

    def of_field(self, name: str) -> str:
        """Return the place of a field."""
        return self.place(self.fields.get(name))

    def of_placement(self, index: int) -> str:
        """Return the place of a `place` call."""
        return self.place(_at(self.placements, index))

    def of_constraint(self, index: int) -> str:
        """Return the place of a `keep` call."""
        return self.place(_at(self.constraints, index))


def read_source_map(scenario: type, name: str, file: str) -> SourceMap:
    """Read the map beside the module of a scenario class.

    A missing or unreadable map is no error, nor is one of another module.

    Args:
        scenario: The class.
        name: Name of the scenario in the map.
        file: Scenario file.
    """
    path = getattr(sys.modules.get(scenario.__module__), "__file__", None)
    if path is None:
        return SourceMap(file)
    try:
        content = json.loads(Path(path).with_suffix(".map.json").read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return SourceMap(file)
    if not isinstance(content, dict) or content.get("version") != VERSION:
        return SourceMap(file)
    return parse_source_map(_table(_table(content.get("scenarios")).get(name)), file)


def parse_source_map(entry: Mapping[str, Any], file: str) -> SourceMap:
    """Return the map of one scenario from its JSON object; what is no line is left out."""
    fields = _table(entry.get("fields"))
    return SourceMap(
        file=file,
        fields={name: line for name, line in fields.items() if isinstance(line, int)},
        constraints=_lines(entry.get("constraints")),
        placements=_lines(entry.get("placements")),
        nodes=_lines(entry.get("nodes")),
    )


def _table(value: Any) -> Mapping[str, Any]:
    return value if isinstance(value, dict) else {}


def _lines(value: Any) -> tuple[int, ...]:
    if not isinstance(value, list) or not all(isinstance(line, int) for line in value):
        return ()
    return tuple(value)


def _at(lines: tuple[int, ...], index: int) -> int | None:
    return lines[index] if index < len(lines) else None
