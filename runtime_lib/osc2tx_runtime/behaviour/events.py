"""Events, and how a node watches for one.

Time within an instant is the context's pass counter `tick`: an occurrence is stamped with the
pass in which it becomes visible, a watch with the pass in which it starts, and the watch sees
occurrences with a later stamp. So a wait beside an emit sees it wherever it stands, and a wait
that starts after an emit does not.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from osc2tx_runtime.behaviour.conditions import Condition, Watch, evaluate, watch_level

if TYPE_CHECKING:
    from osc2tx_runtime.context import ExecutionContext

__all__ = ["Event", "Trigger", "describe", "watch"]


class Event:
    """A declared event.

    Args:
        trigger: Its specification: another event, a condition or a boolean function. It is
            watched where the event is used, from the start of that use on.
        only_if: The event occurs only if this is true as well.

    Attributes:
        name: Name in trace and settings; the scenario fills in the attribute's name.
        arguments: Of the occurrence that a condition is being asked about.
    """

    def __init__(
        self, trigger: Trigger | None = None, only_if: Callable[[], bool] | None = None
    ) -> None:
        self.name = ""
        self.trigger = trigger
        self.only_if = only_if
        self.arguments: Mapping[str, Any] = {}
        self.occurred = 0
        self.occurrences: list[Mapping[str, Any]] = []

    def __repr__(self) -> str:
        return f"Event({self.name!r})"

    def reset(self) -> None:
        """Forget all occurrences."""
        self.occurred = 0
        self.occurrences = []

    def occur(self, tick: int, occurrences: Sequence[Mapping[str, Any]]) -> None:
        """Become visible in pass `tick`; equal occurrences of one instant are one."""
        self.occurred = tick
        distinct = {argument_key(arguments): arguments for arguments in occurrences}
        self.occurrences = [distinct[key] for key in sorted(distinct)]


Trigger = Event | Condition | Callable[[], bool]
"""What one can wait for: an event, a condition object, a boolean function (while true)."""


def argument_key(arguments: Mapping[str, Any]) -> str:
    """Return a text that orders occurrences alike in every run."""
    return repr([(name, stable(arguments[name])) for name in sorted(arguments)])


def stable(value: Any) -> Any:
    """Return an actor's id for an actor, and any other value as it is."""
    return getattr(value, "id", value)


def watch(trigger: Trigger, only_if: Callable[[], bool] | None, context: ExecutionContext) -> Watch:
    """Start watching: returns a function that says whether it happened by the present pass."""
    if isinstance(trigger, Event):
        return watch_event(trigger, only_if, context)
    happened = trigger.watch(context) if isinstance(trigger, Condition) else None
    if happened is None:
        happened = watch_level(trigger, context)  # type: ignore[arg-type]
    if only_if is None:
        return happened
    first, second = happened, watch_level(only_if, context)
    return lambda: first() and second()


def watch_event(
    event: Event, only_if: Callable[[], bool] | None, context: ExecutionContext
) -> Watch:
    """Watch the occurrences of an event, and its specification if it has one."""
    emitted = watch_occurrences(event, only_if, context)
    if event.trigger is None:
        return emitted
    specified = watch(event.trigger, event.only_if, context)

    def happened() -> bool:
        if emitted():
            return True
        # No short cut: edges must be sampled in every step.
        if specified() and (only_if is None or evaluate(only_if)):
            if event.name:
                context.trace.event(event.name)
            return True
        return False

    return happened


def watch_occurrences(
    event: Event, only_if: Callable[[], bool] | None, context: ExecutionContext
) -> Watch:
    """Watch what is posted: by emit, by a label, from outside. Each occurrence counts once."""
    seen = context.tick

    def occurred() -> bool:
        nonlocal seen
        if event.occurred > seen:
            seen = event.occurred
            return True
        return False

    if only_if is None:
        return occurred
    condition = only_if

    def happened() -> bool:
        if not occurred() or event.occurred != context.tick:
            return False
        for arguments in event.occurrences:
            event.arguments = arguments
            if evaluate(condition):
                return True
        return False

    return happened


def describe(trigger: Trigger) -> str:
    """Return a few words for a trigger, where no sidecar map has better ones."""
    if isinstance(trigger, Event):
        if trigger.name or trigger.trigger is None:
            return f"@{trigger.name or 'event'}"
        return describe(trigger.trigger)
    return trigger.text if isinstance(trigger, Condition) else "condition"
