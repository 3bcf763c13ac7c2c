"""The directives `emit end` and `emit fail` (§7.3.13)."""

from __future__ import annotations

from collections.abc import Sequence

from py_trees.decorators import Decorator

from osc2tx_runtime.language.context import PostedEvent
from osc2tx_runtime.language.tree.base import (
    FAILURE,
    RUNNING,
    SUCCESS,
    Behaviour,
    Leaf,
    Node,
    Status,
)
from osc2tx_runtime.language.tree.members import ended_late, pulse_of

WHOLE = "do"
"""Label of the whole behavior, in modules with a reaction to its failure."""


class End(Leaf):
    """Ends the scenario with success at this instant.

    Args:
        label: Name for `@label.start`.
    """

    instant = True
    word = "end"

    def __init__(self, label: str | None = None, /) -> None:
        super().__init__(label or f"emit {self.word}")
        self.label = label

    def update(self) -> Status:
        """Remain running: the enclosing scenario ends."""
        return RUNNING


class Fail(End):
    """Ends the scenario with failure at this instant."""

    word = "fail"


class Ending(Node, Decorator):
    """Encloses the tree of a scenario with `emit end` or `emit fail`.

    Args:
        behavior: The tree.
        ends: Its nodes that end the scenario.

    Attributes:
        failed_by: The node that ended it with a failure.
    """

    synthetic = True

    def __init__(self, behavior: Behaviour, ends: Sequence[End]) -> None:
        super().__init__(name=behavior.name, child=behavior)
        self._ends = sorted(ends, key=lambda end: end.name)
        self.failed_by: Fail | None = None
        self._failure: PostedEvent | None = None
        self._is_posted = False

    def setup(self, **kwargs: object) -> None:
        """Take the context; prepare the tree."""
        super().setup(**kwargs)
        listeners = self.context.label_events if self.listeners is None else self.listeners
        self._failure = listeners.get((WHOLE, "fail"))
        self._pulse_child = pulse_of(self.decorated)

    def initialise(self) -> None:
        """Start: nothing has failed yet."""
        self._is_posted = False

    def length(self) -> int | None:
        """Return None: only the run determines it."""
        return None

    def lateness(self) -> float:
        """Return the status of the tree, if it has ended."""
        return ended_late(self.decorated) if self.decorated.status is SUCCESS else 0.0

    def pulse(self) -> Status:
        """Run the tree, then check whether it has ended the scenario; failures take precedence."""
        if self.status is not RUNNING:
            self._begin()
        resting = self.context.resting.nodes
        is_over = self.context.settled and any(end.status is RUNNING for end in self._ends)
        # The instant is settled: enclosing durations are no longer checked.
        status = RUNNING if is_over or self.decorated in resting else self._pulse_child()
        if self.decorated in resting:  # and no node in it ends the scenario
            resting.add(self)
            return RUNNING
        reached = [end for end in self._ends if end.status is RUNNING]
        failed = [end for end in reached if isinstance(end, Fail)]
        if status is RUNNING and failed and self._failure is not None and not self._is_posted:
            self._is_posted = True
            self.context.post(self._failure)  # reactions to it are in the tree, and still run
        if status is RUNNING and reached and not self.context.settled:
            self.context.request_settling()  # further changes of this instant belong to it
            return RUNNING
        if status is not FAILURE and failed:
            self.failed_by = failed[0]
            status = self.fail(f"{failed[0].name} ({failed[0].source})")
        elif status is not FAILURE and reached:
            status = SUCCESS
        if status is not RUNNING:
            self.stop(status)
        return self.status
