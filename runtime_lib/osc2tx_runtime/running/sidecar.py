"""The sidecar map beside a generated module: which line of the scenario each node came from."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from osc2tx_runtime.language.tree.base import Behaviour, Node
from osc2tx_runtime.language.tree.compositions import Composition
from osc2tx_runtime.language.tree.invocation import Invocation

__all__ = ["SourceMap", "apply_nodes", "own_nodes", "read_source_map"]

VERSION = 1


@dataclass(frozen=True, slots=True)
class SourceMap:
    """What the map says about one scenario.

    Attributes:
        file: Scenario file as shown to people.
        line: Line of the scenario; None where unknown.
        fields: Lines of the fields, by name.
        constraints: Line and text of the `keep` calls, in their order.
        placements: Lines of the `place` calls, in their order.
        nodes: Line and name of the nodes, in pre-order.
        invocations: Names of the invoked scenarios, in the same order.
        draws: What their random values depend on besides the seed, in the same order.
    """

    file: str
    line: int | None = None
    fields: Mapping[str, int] = field(default_factory=dict)
    constraints: tuple[tuple[int, str], ...] = ()
    placements: tuple[int, ...] = ()
    nodes: tuple[tuple[int | None, str], ...] = ()
    invocations: tuple[str, ...] = ()
    draws: tuple[str, ...] = ()

    def place(self, line: int | None) -> str:
        """Return `file:line`, or the file alone."""
        return self.file if line is None else f"{self.file}:{line}"


def read_source_map(scenario: type, name: str, file: str) -> SourceMap:
    """Read the map beside the module of a scenario class.

    A missing or unreadable map is no error: the scenario runs, its messages name the file only.

    Args:
        scenario: The class.
        name: Name of the scenario in the map.
        file: Scenario file to fall back to.
    """
    module = sys.modules.get(scenario.__module__)
    path = getattr(module, "__file__", None)
    if path is None:
        return SourceMap(file)
    try:
        text = Path(path).with_suffix(".map.json").read_text(encoding="utf-8")
        content = json.loads(text)
        if content["version"] != VERSION:
            return SourceMap(file)
        return parse_source_map(content["scenarios"][name], file)
    except (OSError, ValueError, LookupError, TypeError, AttributeError):
        return SourceMap(file)


def parse_source_map(entry: Mapping[str, Any], file: str) -> SourceMap:
    """Build the map of one scenario from its JSON object."""
    return SourceMap(
        file=str(entry.get("file", file)),
        line=entry.get("line"),
        fields={str(name): int(line) for name, line in entry.get("fields", {}).items()},
        constraints=tuple((int(line), str(text)) for line, text in entry.get("constraints", ())),
        placements=tuple(int(line) for line in entry.get("placements", ())),
        nodes=tuple((line, str(text)) for line, text in entry.get("nodes", ())),
        invocations=tuple(str(name) for name in entry.get("invocations", ())),
        draws=tuple(str(key) for key in entry.get("draws", ())),
    )


def apply_nodes(root: Behaviour, source_map: SourceMap) -> bool:
    """Give the nodes of a scenario's tree their places, and the leaves their names.

    The trees of invoked scenarios have their own maps and are left alone.

    Returns:
        Whether the map fits the tree. If not, the nodes get the file without a line.
    """
    nodes = [node for node in own_nodes(root) if not node.synthetic]
    fits = len(nodes) == len(source_map.nodes)
    for node in own_nodes(root):
        node.source = source_map.file
    if fits:
        for node, (line, text) in zip(nodes, source_map.nodes, strict=True):
            node.source = source_map.place(line)
            if text and not isinstance(node, Composition):
                node.name = text
    return fits


def own_nodes(root: Behaviour) -> Iterator[Node]:
    """Yield the nodes of a scenario, parents first, without those of the scenarios it invokes."""
    if isinstance(root, Node):
        yield root
    if not isinstance(root, Invocation):
        for child in root.children:
            yield from own_nodes(child)
