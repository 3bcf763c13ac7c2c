"""The directives of the language: wait, emit, call, until."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, overload

from py_trees.decorators import Decorator

from osc2tx_runtime.errors import NO_RESULT, OwnCode, ScenarioError, why_no_result
from osc2tx_runtime.language.tree.base import (
    RUNNING,
    SUCCESS,
    Behaviour,
    Leaf,
    Node,
    Status,
    split_label,
)
from osc2tx_runtime.language.tree.conditions import (
    Condition,
    Deadline,
    Edge,
    Watch,
)
from osc2tx_runtime.language.tree.duration_limits import DurationLimits
from osc2tx_runtime.language.tree.events import Event, Guard, Trigger, describe, rest_until, watch
from osc2tx_runtime.language.tree.members import ended_late, pulse_of
from osc2tx_runtime.language.tree.module_text import function_text


class Wait(Leaf):
    """Waits for an event or a condition, from its start: `Wait("parked", elapsed(5 * s))`.

    Args:
        label: Name for `@label.end` and others; optional.
        trigger: An event, a condition (`rise`, `fall`, `elapsed`, `every`) or a boolean function.
        condition: With an event: only an occurrence at which this is true counts.
    """

    @overload
    def __init__(self, trigger: Trigger, /, *, condition: Guard | None = None) -> None: ...
    @overload
    def __init__(
        self, label: str, trigger: Trigger, /, *, condition: Guard | None = None
    ) -> None: ...
    def __init__(self, *arguments: Any, condition: Guard | None = None) -> None:
        self.label, (self.trigger,) = split_label(arguments)
        super().__init__(self.label or f"wait {describe(self.trigger, condition)}")
        self.condition = condition
        self._happened: Watch = lambda: False

    def initialise(self) -> None:
        """Start watching."""
        self._happened = watch(self.trigger, self.condition, self.context)

    def length(self) -> int | None:
        """Return the steps of `elapsed`; those of other triggers are unknown."""
        seconds = self.seconds()
        return None if seconds is None else self.context.steps(seconds)

    def seconds(self) -> float | None:
        """Return the time of `elapsed`."""
        trigger, condition = self.trigger, self.condition
        is_time = condition is None and isinstance(trigger, Condition)
        return trigger.seconds if is_time else None

    def lateness(self) -> float:
        """Return the lateness (s) of `elapsed`."""
        over = self._happened
        return over.late if isinstance(over, Deadline) else super().lateness()

    def waits_in_vain(self) -> bool:
        """Whether it waits for a change to a value that is already present."""
        return isinstance(self._happened, Edge) and self._happened.is_vain

    def update(self) -> Status:
        """Succeed when the trigger occurs."""
        if self._happened():
            return SUCCESS
        rest_until(self, (self._happened,), self.context)
        return RUNNING


class Emit(Leaf):
    """Emits an event; ends in the next pass, when it is visible.

    Args:
        event: The event.
        **arguments: Arguments of the event; functions are called when it is emitted. Missing
            parameters have their defaults.
    """

    instant = True

    def __init__(self, event: Event, /, **arguments: Any) -> None:
        super().__init__(f"emit {event.name or 'event'}")
        self.event = event
        self.arguments = arguments
        self._posted = 0

    def setup(self, **kwargs: Any) -> None:
        """Take the context; check the names of the arguments."""
        super().setup(**kwargs)
        problem = self.event.problem(self.arguments)
        if problem:
            raise ScenarioError(problem, self.source or None)

    def initialise(self) -> None:
        """Post the event.

        Raises:
            ScenarioError: An argument has no value.
        """
        try:
            values = self.event.complete(self.arguments)
        except NO_RESULT as error:
            raise ScenarioError(
                f"an argument of {self.name} has no value: {why_no_result(error)}"
            ) from error
        self.context.post(self.event, values)
        self._posted = self.context.tick

    def update(self) -> Status:
        """Succeed once the event is visible."""
        return SUCCESS if self.context.tick > self._posted else RUNNING


class Call(Leaf):
    """Calls a function once, in no time; it must not change what other nodes read.

    Args:
        label: Name for `@label.end` and others; optional.
        function: The function; with arguments: `Call(lambda: note(self.ego.speed))`.
    """

    instant = True

    @overload
    def __init__(self, function: Callable[[], object], /) -> None: ...
    @overload
    def __init__(self, label: str, function: Callable[[], object], /) -> None: ...
    def __init__(self, *arguments: Any) -> None:
        self.label, (self.function,) = split_label(arguments)
        super().__init__(self.label or f"call {function_text(self.function)}")

    def initialise(self) -> None:
        """Call it.

        Raises:
            ScenarioError: It raises an exception: it may be user code.
        """
        with OwnCode(f"{self.name}:"):
            self.function()

    def update(self) -> Status:
        """Succeed in the same pass."""
        return SUCCESS


class Until(Node, Decorator):
    """Ends a behavior at the first of several events or conditions, with success (DSL 7.6.2.5.4).

    In each pass the conditions are evaluated before the behavior, from its start. The behavior has
    to end exactly then: it fails if it has ended before, or if its duration requires more time.
    With `context.first_come` the first end counts, with its own result.

    The label of the behavior is that of the whole: both end together.

    Args:
        behavior: The behavior.
        *conditions: The ends; for `@e if c` write `Event(self.e, condition=lambda: c)`.
    """

    def __init__(self, behavior: Behaviour, *conditions: Trigger) -> None:
        if not conditions:
            raise ValueError("Until needs something that ends the behavior")
        what = " or ".join(describe(condition) for condition in conditions)
        super().__init__(name=f"until {what}", child=behavior)
        self.conditions = conditions
        if isinstance(behavior, Node):
            self.label, behavior.label = behavior.label, None
        self._limits: DurationLimits | None = getattr(behavior, "_limits", None)
        if self._limits is not None:
            self._limits.until = self.name
        self._happened: list[Watch] = []
        self._late: float | None = None
        self._has_begun = False
        self._has_ended = False

    def setup(self, **kwargs: Any) -> None:
        """Take the context; prepare the behavior."""
        super().setup(**kwargs)
        self._pulse_child = pulse_of(self.decorated)

    def length(self) -> int | None:
        """Return the steps until the first known end, if no other end is possible."""
        known = [c.seconds if isinstance(c, Condition) else None for c in self.conditions]
        lengths = [None if seconds is None else self.context.steps(seconds) for seconds in known]
        child = self.decorated
        if not (isinstance(child, Node) and child.open_ended):
            lengths.append(child.length() if isinstance(child, Node) else None)
        found = [length for length in lengths if length is not None]
        return min(found) if len(found) == len(lengths) else None

    def initialise(self) -> None:
        """Start watching."""
        self._late, self._has_begun, self._has_ended = None, False, False
        self._happened = [watch(condition, None, self.context) for condition in self.conditions]

    def lateness(self) -> float:
        """Return the status of the first condition that ended it, else of the behavior."""
        return ended_late(self.decorated) if self._late is None else self._late

    def waits_in_vain(self) -> bool:
        """Whether all its ends are changes to values that are already present."""
        edges = [isinstance(watch, Edge) and watch.is_vain for watch in self._happened]
        return bool(edges) and all(edges)

    def pulse(self) -> Status:
        """Evaluate the conditions, then run the behavior."""
        if self.status is not RUNNING:
            self._begin()
        if self._is_over():
            status = self._judge()
        elif self._has_ended:
            status = self._missed()
        else:
            status = self._run_behavior()
        if status is not RUNNING:
            self.stop(status)
        return self.status

    def _run_behavior(self) -> Status:
        """Run it for one pass, unless it rests."""
        resting, behavior = self.context.resting.nodes, self.decorated
        self._has_begun = True
        status = RUNNING if behavior in resting else self._pulse_child()
        if status is SUCCESS and not self._may_end():
            self._has_ended = True
            return self._missed()
        if behavior in resting:
            rest_until(self, self._happened, self.context)
        return status

    def _judge(self) -> Status:
        """Succeed, unless the duration of the behavior requires more time."""
        limits = self._limits
        late = self._late or 0.0
        if limits is None or self.context.first_come:
            return SUCCESS
        if not (limits.is_early(late) if self._has_begun else limits.seconds[0] > 0.0):
            return SUCCESS
        after = self.lasted(late)
        return self.fail(f"{self.name} ends it after {after:g} s, its duration is {limits.text}")

    def _may_end(self) -> bool:
        """Return whether the behavior may end before the condition of its `until`.

        It may at the upper bound of a range of durations, since an earlier end is not its own.
        """
        limits = self._limits
        return self.context.first_come or (limits is not None and limits.is_over)

    def _missed(self) -> Status:
        """Fail if the condition does not come at this instant, at which the behavior has ended."""
        if not self.context.settled:
            self.context.request_settling()
            return RUNNING
        after = self.lasted(ended_late(self.decorated))
        return self.fail(f"ended by itself after {after:g} s, before {self.name}")

    def _is_over(self) -> bool:
        try:
            # A list, not a generator: each condition is sampled in each step.
            fired = [happened for happened in self._happened if happened()]
        except ScenarioError as error:
            error.source = error.source or self.source or None
            raise
        if fired:
            self._late = max(h.late if isinstance(h, Deadline) else 0.0 for h in fired)
        return bool(fired)
