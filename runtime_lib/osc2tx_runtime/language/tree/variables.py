"""Variables that are sampled at an event: `var x: T = sample(expression, event, default)`."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, Literal

from osc2tx_runtime.errors import NO_RESULT, ScenarioError, why_no_result
from osc2tx_runtime.language.tree.base import RUNNING, SUCCESS, Behaviour, Leaf, Status
from osc2tx_runtime.language.tree.conditions import Watch
from osc2tx_runtime.language.tree.events import Event, Guard, Occurrences, Trigger, watch

if TYPE_CHECKING:
    from osc2tx_runtime.language.context import ExecutionContext

Boundary = Literal["start", "end"]
"""Start and end of the scenario that declares a variable."""

MISSING: Any = object()
"""Represents a missing default."""


class Sampled:
    """One variable.

    Args:
        expression: Returns the new value.
        trigger: When it is sampled; `start` and `end` refer to its scenario.
        default: Value before the first sample; MISSING for none.
        condition: With an event: only an occurrence at which this is true counts.
        name: Name in the scenario, if an attribute cannot have it (`from`).

    Attributes:
        name: Name in the scenario; the scenario fills it in.
        value: The value to read in this pass.
        due: Whether its condition samples it at this instant, for reads before the sample; None for
            a variable that an event samples.
    """

    def __init__(
        self,
        expression: Callable[[], Any],
        trigger: Trigger | Boundary,
        default: Any = MISSING,
        condition: Guard | None = None,
        name: str = "",
    ) -> None:
        self.name = name
        self.expression = expression
        self.trigger = trigger
        self.condition = condition
        self.value = default
        self.due: Watch | None = None

    def read(self) -> Any:
        """Return the value: before the first sample the value that is due at this instant, if any.

        `every` without an offset samples at the very start of the scenario (§7.3.10.4), and all
        members that start with it may read that.

        Raises:
            ScenarioError: There is none yet.
        """
        if self.value is MISSING and self.due is not None and self.due():
            return present_value(self)
        if self.value is MISSING:
            raise ScenarioError(f"{self.name} is read before it is sampled; give it a default")
        return self.value


class Sampling(Leaf):
    """Samples the variables of a scenario while it runs.

    A value sampled by an event is visible to all members that the event starts (§7.3.10): it is
    sampled before the nodes of the pass in which the event is visible. A value sampled by a
    condition is visible from the next pass, so the order has no effect.
    """

    open_ended = True
    service = True
    synthetic = True

    def __init__(self, variables: Sequence[Sampled], tree: Behaviour) -> None:
        super().__init__(sampling_of(variables))
        self._tree = tree
        self._at_end = [variable for variable in variables if variable.trigger == "end"]
        self._variables = [v for v in variables if not isinstance(v.trigger, str)]
        self._watches: list[Watch] = []
        self._sampled: dict[Sampled, int] = {}  # step of the last sample at a condition

    def setup(self, **kwargs: Any) -> None:
        """Let the members that start before this node read initial samples."""
        super().setup(**kwargs)
        for variable in self._conditional():
            variable.due = partial(self._is_due_at_start, variable)

    def _conditional(self) -> list[Sampled]:
        return [v for v in self._variables if not isinstance(v.trigger, Event)]

    def _is_due_at_start(self, variable: Sampled) -> bool:
        assert not isinstance(variable.trigger, str), variable.name
        return watch(variable.trigger, variable.condition, self.context)()

    def initialise(self) -> None:
        """Start watching."""
        self.context.samplers.append(self._sample_at_events)
        watched = ((v.trigger, v.condition) for v in self._variables)
        self._watches = [
            watch(trigger, condition, self.context)
            for trigger, condition in watched
            if not isinstance(trigger, str)
        ]
        for variable, happened in zip(self._variables, self._watches, strict=True):
            if not isinstance(variable.trigger, Event):
                variable.due = happened
        self._sampled = {}
        self._is_over = False

    def terminate(self, new_status: Status) -> None:
        """Stop sampling."""
        self.context.samplers.remove(self._sample_at_events)

    def update(self) -> Status:
        """Sample all values that are due."""
        for variable, happened in zip(self._variables, self._watches, strict=True):
            if not isinstance(happened, Occurrences) and happened():
                self._sample(variable, happened)
        if self._tree.status is SUCCESS and not self._is_over:
            self._is_over = True
            for variable in self._at_end:
                sample(variable, self.context)
        return RUNNING

    def _sample_at_events(self) -> None:
        """Sample the values triggered by the events that are visible now."""
        for variable, happened in zip(self._variables, self._watches, strict=True):
            if isinstance(happened, Occurrences) and happened():
                self._sample(variable, happened)

    def _sample(self, variable: Sampled, happened: Watch) -> None:
        occurrences: Sequence[Mapping[str, Any]] = ()
        if isinstance(happened, Occurrences):
            occurrences = happened.matching
        elif self._sampled.get(variable) == self.context.step:
            return  # a condition is true in all passes of an instant
        self._sampled[variable] = self.context.step
        if occurrences and isinstance(variable.trigger, Event):
            # Several values of one instant have no order: the last by value counts in all runs.
            variable.trigger.meant().arguments = occurrences[-1]
        sample(variable, self.context)


class SamplingStart(Leaf):
    """Samples the values triggered by the start of a scenario, for all its members to read."""

    instant = True
    synthetic = True

    def __init__(self, variables: Sequence[Sampled]) -> None:
        super().__init__(sampling_of(variables))
        self._variables = variables
        self._tick = 0

    def initialise(self) -> None:
        """Sample."""
        self._tick = self.context.tick
        for variable in self._variables:
            sample(variable, self.context)

    def update(self) -> Status:
        """End once the values can be read, in the next pass of this instant."""
        return SUCCESS if self.context.tick > self._tick else RUNNING


def sampling_of(variables: Sequence[Sampled]) -> str:
    """Return the name of a node that samples variables."""
    return "sample " + ", ".join(variable.name for variable in variables)


def sample(variable: Sampled, context: ExecutionContext) -> None:
    """Set a variable to the present value of its expression."""
    context.assign(variable, present_value(variable))


def present_value(variable: Sampled) -> Any:
    """Return the value that the expression of a variable has now.

    Raises:
        ScenarioError: It has no value.
    """
    try:
        return variable.expression()
    except NO_RESULT as error:
        raise ScenarioError(f"{variable.name} has no value: {why_no_result(error)}") from error
