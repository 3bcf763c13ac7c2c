"""Resting nodes, and their wake-up conditions.

A node without possible changes rests; so does a composition whose members all rest, and a tree that
rests as a whole is not visited. The conditions of a node are checked here in each pass, or are
notified: a change of an actor, a time. Events, new values of variables and effects wake all nodes.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Sequence

from py_trees.behaviour import Behaviour

from osc2tx_runtime.errors import ScenarioError

NEVER = sys.maxsize


class Resting:
    """The resting nodes.

    Attributes:
        nodes: The nodes; they need no pulse.
    """

    def __init__(self) -> None:
        self.nodes: set[Behaviour] = set()
        self._with: dict[str, dict[Behaviour, None]] = {}  # actors to nodes
        self._until: dict[Behaviour, int] = {}  # nodes to steps
        self._next = NEVER  # the first of these steps
        self._unless: dict[Behaviour, Sequence[Callable[[], bool]]] = {}

    # --- wake-up conditions ---

    def with_actor(self, node: Behaviour, actor_id: str) -> None:
        """Wake a node when the motion of an actor changes."""
        self._with.setdefault(actor_id, {})[node] = None

    def until(self, node: Behaviour, step: int) -> None:
        """Wake a node at a step, or at an earlier one that it has asked for."""
        self._until[node] = min(step, self._until.get(node, NEVER))
        self._next = min(self._next, step)

    def unless(self, node: Behaviour, conditions: Sequence[Callable[[], bool]]) -> None:
        """Wake a node in the pass in which one of some conditions is true."""
        self._unless[node] = conditions

    # --- time ---

    def begin_step(self, step: int, changed: Callable[[], Iterable[str]]) -> None:
        """Wake nodes that are due, or whose actors have changed."""
        if self._with:
            for actor_id in changed():
                for node in self._with.pop(actor_id, ()):
                    self.wake(node)
        if step >= self._next:
            for node in [node for node, time in self._until.items() if step >= time]:
                self.wake(node)
            self._next = min(self._until.values(), default=NEVER)

    def begin_pass(self) -> None:
        """Wake nodes whose condition is true; nodes report conditions without a value."""
        for node in [n for n, conditions in self._unless.items() if self._is_any(conditions)]:
            self.wake(node)

    @staticmethod
    def _is_any(conditions: Sequence[Callable[[], bool]]) -> bool:
        try:
            for happened in conditions:
                if happened():
                    return True
        except ScenarioError:
            return True
        return False

    def wake(self, node: Behaviour) -> None:
        """Wake a node."""
        self._unless.pop(node, None)
        self._until.pop(node, None)
        above: Behaviour | None = node
        while above is not None:
            self.nodes.discard(above)
            above = above.parent

    def wake_all(self) -> None:
        """Wake all nodes; nodes without work rest again."""
        self.nodes.clear()
        self._with.clear()
        self._until.clear()
        self._unless.clear()
        self._next = NEVER

    def forget(self, node: Behaviour) -> None:
        """Note that a node is left."""
        self.nodes.discard(node)
        self._unless.pop(node, None)
        self._until.pop(node, None)
