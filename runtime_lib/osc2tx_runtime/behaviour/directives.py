"""The directives of the language: wait, emit, call, until, on."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from py_trees.composites import Sequence
from py_trees.decorators import Decorator

from osc2tx_runtime.behaviour.base import RUNNING, SUCCESS, Behaviour, Leaf, Node, Status, pulse_of
from osc2tx_runtime.behaviour.conditions import Watch
from osc2tx_runtime.behaviour.events import Event, Trigger, describe, watch
from osc2tx_runtime.errors import ScenarioError

__all__ = ["Call", "Emit", "On", "Until", "Wait"]


class Wait(Leaf):
    """Waits for an event or a condition, from its start on.

    Args:
        trigger: An event, a condition (`rise`, `fall`, `elapsed`, `every`) or a boolean function.
        condition: With an event: only an occurrence at which this is true counts.
        label: Name for `@label.end` and its like.
    """

    def __init__(
        self,
        trigger: Trigger,
        condition: Callable[[], bool] | None = None,
        *,
        label: str | None = None,
    ) -> None:
        super().__init__(f"wait {describe(trigger)}")
        self.trigger = trigger
        self.condition = condition
        self.label = label
        self._happened: Watch = lambda: False

    def initialise(self) -> None:
        """Start watching."""
        self._happened = watch(self.trigger, self.condition, self.context)

    def update(self) -> Status:
        """Succeed when it happened."""
        return SUCCESS if self._happened() else RUNNING


class Emit(Leaf):
    """Lets an event occur; ends in the next pass, when others see it too.

    Args:
        event: The event.
        **arguments: Of the event; functions are called when the event is emitted.
    """

    instant = True

    def __init__(self, event: Event, /, **arguments: Any) -> None:
        super().__init__(f"emit {event.name or 'event'}")
        self.event = event
        self.arguments = arguments
        self._posted = 0

    def initialise(self) -> None:
        """Post the event."""
        values = {key: v() if callable(v) else v for key, v in self.arguments.items()}
        self.context.post(self.event, values)
        self._posted = self.context.tick

    def update(self) -> Status:
        """Succeed once the event is visible."""
        return SUCCESS if self.context.tick > self._posted else RUNNING


class Call(Leaf):
    """Calls a function once, in no time; it must not change what other nodes read."""

    instant = True

    def __init__(self, function: Callable[[], object], *, label: str | None = None) -> None:
        super().__init__(
            f"call {getattr(function, '__name__', 'function')}".replace("<lambda>", "")
        )
        self.function = function
        self.label = label

    def initialise(self) -> None:
        """Call it."""
        self.function()

    def update(self) -> Status:
        """Succeed at once."""
        return SUCCESS


class Until(Node, Decorator):
    """Ends a behavior at the first of several events or conditions, with success.

    The conditions are asked before the behavior in every pass, from the start of the behavior on.
    A behavior that ends earlier ends this node with its own result.

    Args:
        behavior: What runs.
        *conditions: What ends it; for `@e if c` write `Event(self.e, lambda: c)`.
        label: Name for `@label.end` and its like.
    """

    def __init__(self, behavior: Behaviour, *conditions: Trigger, label: str | None = None) -> None:
        if not conditions:
            raise ValueError("Until needs something that ends the behavior")
        super().__init__(
            name=f"until {' or '.join(describe(condition) for condition in conditions)}",
            child=behavior,
        )
        self.conditions = conditions
        self.label = label
        self._happened: list[Watch] = []

    def setup(self, **kwargs: Any) -> None:
        """Take the context; find out how to tick the behavior."""
        super().setup(**kwargs)
        self._pulse_child = pulse_of(self.decorated)

    def initialise(self) -> None:
        """Start watching."""
        self._happened = [watch(condition, None, self.context) for condition in self.conditions]

    def pulse(self) -> Status:
        """Ask the conditions, then run the behavior."""
        if self.status is not RUNNING:
            self._begin()
        status = SUCCESS if self._is_over() else self._pulse_child()
        if status is not RUNNING:
            self.stop(status)
        return status

    def _is_over(self) -> bool:
        try:
            # A list, not a generator: every condition is sampled in every step.
            return any([happened() for happened in self._happened])
        except ScenarioError as error:
            error.source = error.source or self.source or None
            raise


class On(Node, Sequence):
    """Reacts whenever something happens, for as long as the composition around it runs.

    Stands beside the behavior in a `Parallel`, which it does not keep from ending. At one instant
    it reacts once, however often the event is emitted then.

    Args:
        trigger: An event, a condition or a boolean function (once per step while it is true).
        *reactions: `Emit` and `Call`, in order.
        condition: With an event: only an occurrence at which this is true counts.
    """

    open_ended = True

    def __init__(
        self,
        trigger: Trigger,
        *reactions: Behaviour,
        condition: Callable[[], bool] | None = None,
    ) -> None:
        super().__init__(f"on {describe(trigger)}", memory=True, children=reactions)
        self.trigger = trigger
        self.condition = condition
        self._happened: Watch = lambda: False
        self._pulses: list[Callable[[], Status]] = []
        self._next: int | None = None  # reaction that comes next; None between reactions
        self._reacted = -1  # step of the last reaction

    def setup(self, **kwargs: Any) -> None:
        """Take the context; find out how to tick the reactions."""
        super().setup(**kwargs)
        self._pulses = [pulse_of(reaction) for reaction in self.children]

    def initialise(self) -> None:
        """Start watching."""
        self._happened = watch(self.trigger, self.condition, self.context)
        self._next, self._reacted = None, -1

    def pulse(self) -> Status:
        """React if it happened."""
        if self.status is not RUNNING:
            self._begin()
        happened = self._happened()  # asked in every pass: what comes in between is used up
        if happened and self._next is None and self._reacted != self.context.step:
            self._next, self._reacted = 0, self.context.step
        while self._next is not None:
            status = self._pulses[self._next]()
            if status is RUNNING:
                break
            if status is not SUCCESS:
                self.stop(status)
                return status
            self._next = self._next + 1 if self._next + 1 < len(self._pulses) else None
        return RUNNING
