"""Who uses what in a project: declarations and maps, with the files that they are in."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from pathlib import Path, PurePath
from typing import NamedTuple

from osc2tx.building.source_index import IndexedFile, SourceIndex
from osc2tx.compilation.uses import Statement
from osc2tx_shared.classes import dataclass

KINDS = ("scenario", "actor", "action", "modifier", "struct", "enum", "extend", "map")
"""What is shown, in this order; other declarations lead from one to another."""


class Node(NamedTuple):
    """A declaration, an extension of one, or a map.

    Attributes:
        kind: `scenario`, `actor`, …, `extend` or `map`.
        name: Its name as it is declared; of a map, what scenarios call it.
        file: The name of its file; empty for a map outside of the project.
    """

    kind: str
    name: str
    file: str

    def __str__(self) -> str:
        """Return it as one line."""
        return f"{self.kind} {self.name}" + (f" ({self.file})" if self.file else "")


@dataclass(frozen=True, slots=True)
class _Declaration:
    node: Node
    statement: Statement


class UsageGraph:
    """The graph.

    Attributes:
        uses: What each node uses itself, in the order of nodes.
    """

    def __init__(self, index: SourceIndex) -> None:
        """Connect all declarations of an index."""
        self._by_file = {path: tuple(_declarations(file)) for path, file in index.files.items()}
        pairs = (pair for path in index.files for pair in self._pairs(index, path))
        found: dict[Node, dict[Node, None]] = defaultdict(dict)
        for node, used in pairs:
            found[node]
            if used is not None and used != node:
                found[used]
                found[node][used] = None
        self.uses: Mapping[Node, tuple[Node, ...]] = {
            node: tuple(sorted(found[node], key=_order)) for node in sorted(found, key=_order)
        }

    @cached_property
    def users(self) -> Mapping[Node, tuple[Node, ...]]:
        """What uses each node itself."""
        found: dict[Node, list[Node]] = {node: [] for node in self.uses}
        for node, used in self.uses.items():
            for each in used:
                found[each].append(node)
        return {node: tuple(each) for node, each in found.items()}

    def find(self, wanted: str) -> list[Node]:
        """Return the nodes that a name, a file or a map stands for.

        Args:
            wanted: `swerve`, `vehicle.swerve`, `lib/base.osc`, `highway.xodr`.
        """
        return [node for node in self.uses if wanted in _names(node)]

    def names(self) -> list[str]:
        """Return all that `find` knows."""
        return sorted({name for node in self.uses for name in _names(node)})

    def files(self) -> dict[str, tuple[str, ...]]:
        """Return which files and maps each file uses, by what is in them."""
        found: dict[str, dict[str, None]] = {}
        for node, used in self.uses.items():
            own = found.setdefault(node.file or node.name, {})
            own.update(dict.fromkeys(each.file or each.name for each in used))
        return {
            file: tuple(sorted(each for each in used if each != file))
            for file, used in sorted(found.items())
        }

    def _pairs(self, index: SourceIndex, path: Path) -> Iterator[tuple[Node, Node | None]]:
        """Yield each node of a file with what it uses, and with nothing."""
        visible: dict[str, list[Node]] = defaultdict(list)
        for place in (path, *(each.path for each in index.closure(path))):
            for declared in self._by_file[place]:
                for name in declared.statement.provides or ():
                    visible[name].append(declared.node)
        maps = [Node("map", PurePath(name).name, "") for name, _ in index.files[path].maps]
        for declared in self._by_file[path]:
            yield declared.node, None
            if declared.statement.declares is None:  # an extension
                yield from ((declared.node, each) for each in visible[_last(declared.node.name)])
            words = declared.statement.words if declared.node.kind != "enum" else frozenset()
            for word in sorted(words & visible.keys()):
                yield from ((declared.node, each) for each in visible[word])
            for each in maps:
                if f'{each.name}"' in declared.statement.tokens:
                    yield declared.node, each


def _declarations(file: IndexedFile) -> Iterator[_Declaration]:
    for statement in file.statements:
        if statement.name and statement.provides is not None:
            yield _Declaration(Node(statement.keyword, statement.name, file.name), statement)


def _names(node: Node) -> Iterable[str]:
    return (node.name, _last(node.name), node.file) if node.file else (node.name,)


def _last(name: str) -> str:
    return name.rpartition(".")[2].rpartition("::")[2]


def _order(node: Node) -> tuple[int, str, str]:
    kind = KINDS.index(node.kind) if node.kind in KINDS else len(KINDS)
    return kind, node.name, node.file


def reach(start: Sequence[Node], edges: Mapping[Node, Sequence[Node]]) -> list[Node]:
    """Return all nodes that edges lead to from some, those included, nearest first."""
    seen = dict.fromkeys(start)
    pending = list(start)
    for node in pending:  # grows
        new = [each for each in edges[node] if each not in seen]
        seen.update(dict.fromkeys(new))
        pending += new
    return list(seen)
