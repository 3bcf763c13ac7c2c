"""The times at which nodes of a tree run, for the `tree` line of the trace."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping

from osc2tx_shared.classes import dataclass

_LEFT = {"SUCCESS": "success", "FAILURE": "failure", "INVALID": "stopped"}


@dataclass(slots=True)
class _Run:
    """One run of a node (s); without an end it has not been left."""

    start: float
    end: float | None = None
    how: str = "running"


class NodeRuns:
    """Keeps the times at which nodes start and are left."""

    def __init__(self) -> None:
        self._runs: dict[object, list[_Run]] = {}

    def starts(self, node: object, time: float) -> None:
        """Note that a node begins, at `time` (s)."""
        self._runs.setdefault(node, []).append(_Run(time))

    def ends(self, node: object, time: float, status: str) -> None:
        """Note that a running node is left at `time` (s) with a status of py_trees."""
        runs = self._runs.get(node)
        if runs:
            runs[-1].end, runs[-1].how = time, _LEFT[status]

    def to_json(self, nodes: Iterable[tuple[object, Mapping[str, int | str]]]) -> str:
        """Return the nodes of a tree as a JSON array.

        Args:
            nodes: Each node with its `OutlineNode`, parents before members.
        """
        found = []
        for node, words in nodes:
            runs = [[round(run.start, 6), _rounded(run.end), run.how] for run in self._of(node)]
            found.append({**words, "runs": runs})
        return json.dumps(found, separators=(",", ":"))

    def _of(self, node: object) -> Iterable[_Run]:
        return self._runs.get(node, ())


def _rounded(time: float | None) -> float | None:
    return None if time is None else round(time, 6)
