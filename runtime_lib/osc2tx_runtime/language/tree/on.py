"""The directive `on`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from py_trees.composites import Sequence as SequenceComposite

from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.tree.base import RUNNING, SUCCESS, Behaviour, Node, Status
from osc2tx_runtime.language.tree.conditions import Watch
from osc2tx_runtime.language.tree.events import (
    Event,
    Guard,
    Occurrences,
    Trigger,
    describe,
    watch,
)
from osc2tx_runtime.language.tree.members import pulse_of

NOTHING: Mapping[str, Any] = {}


class On(Node, SequenceComposite):
    """Reacts to each occurrence of a trigger, while the enclosing composition runs.

    It is a member of a `Parallel` beside the behavior, and does not extend it. At one instant it
    reacts once to each event, however often it is emitted; occurrences with different arguments are
    handled one after the other.

    Args:
        trigger: An event, a condition or a boolean function (once per step while it is true).
        *do: The reactions, `Emit` and `Call`, in order.
        condition: With an event: only an occurrence at which this is true counts.
    """

    open_ended = True
    service = True

    def __init__(
        self,
        trigger: Trigger,
        *do: Behaviour,
        condition: Guard | None = None,
    ) -> None:
        super().__init__(f"on {describe(trigger, condition)}", memory=True, children=do)
        self.trigger = trigger
        self.condition = condition
        self._happened: Watch = lambda: False
        self._pulses: list[Callable[[], Status]] = []
        self._next = 0  # the next reaction
        self._queue: list[Mapping[str, Any]] = []  # occurrences to react to, the present one first
        self._step = -1  # of the last reaction to a condition

    def setup(self, **kwargs: Any) -> None:
        """Take the context; prepare the reactions."""
        super().setup(**kwargs)
        self._pulses = [pulse_of(reaction) for reaction in self.children]

    def initialise(self) -> None:
        """Start watching."""
        self._happened = watch(self.trigger, self.condition, self.context)
        self._next, self._queue, self._step = 0, [], -1

    def pulse(self) -> Status:
        """React to occurrences."""
        if self.status is not RUNNING:
            self._begin()
        try:
            if self._happened():  # evaluated in each pass: occurrences in between are consumed
                self._hear()
            status = self._react()
        except ScenarioError as error:
            error.source = error.source or self.source or None
            raise
        if status is not RUNNING:
            self.stop(status)
        return self.status

    def _hear(self) -> None:
        """Queue occurrences; a condition that is true for an instant counts once."""
        watched = self._happened
        if isinstance(watched, Occurrences):
            self._queue += watched.matching
        elif self._step != self.context.step:
            self._step = self.context.step
            self._queue.append(NOTHING)

    def _react(self) -> Status:
        """Advance the reactions: RUNNING, or the failure of one."""
        while self._queue:
            if self._next == len(self._pulses):
                self._next = 0
                self._queue.pop(0)
                continue
            if isinstance(self.trigger, Event):  # other nodes read other occurrences meanwhile
                self.trigger.meant().arguments = self._queue[0]
            status = self._pulses[self._next]()
            if status is not SUCCESS:
                return status
            self._next += 1
        return RUNNING
