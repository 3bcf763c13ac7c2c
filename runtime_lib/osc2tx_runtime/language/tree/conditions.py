"""Conditions: rise, fall, elapsed, every, and functions of the scenario.

A condition is sampled once per snapshot: the state of the world belongs to the step, and sampled
variables may change between two passes of an instant (`context.snapshot` counts). At the start of
the run none is true before the first assignments have placed the actors. A condition starts with
its use: `rise` and `fall` take their first sample there, which is not an edge; `elapsed` and
`every` count steps from there.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

from osc2tx_runtime.errors import NO_RESULT, ScenarioError, why_no_result
from osc2tx_runtime.language.tree.module_text import function_text

if TYPE_CHECKING:
    from osc2tx_runtime.language.context import ExecutionContext

SETTLED_STEPS = 2
"""Steps for which a condition of measured states must keep its value before a change counts."""

Watch = Callable[[], bool]
"""Returns whether something happened up to the present pass."""


class Condition:
    """A condition that depends on the start of its use.

    Args:
        text: Text for the name of the node.
        watch: Starts it: takes the context, returns the function to evaluate.
        seconds: Time (s) from its start until it becomes true, if known.
    """

    def __init__(
        self,
        text: str,
        watch: Callable[[ExecutionContext], Watch],
        seconds: float | None = None,
    ) -> None:
        self.text = text
        self.watch = watch
        self.seconds = seconds


def rise(function: Callable[[], bool]) -> Condition:
    """True at the instant `function` turns from false to true."""
    text = f"rise({function_text(function)})"
    return Condition(text, lambda context: Edge(function, True, context))


def fall(function: Callable[[], bool]) -> Condition:
    """True at the instant `function` turns from true to false."""
    text = f"fall({function_text(function)})"
    return Condition(text, lambda context: Edge(function, False, context))


def elapsed(duration: float | Callable[[], float]) -> Condition:
    """True from `duration` seconds after the start, in whole steps.

    A function as duration is called at the start.
    """

    def watch(context: ExecutionContext) -> Watch:
        return Deadline(number(duration) if callable(duration) else duration, context)

    if callable(duration):
        return Condition(f"elapsed({function_text(duration)})", watch)
    return Condition(f"elapsed {duration:g} s", watch, duration)


def every(period: float, offset: float = 0.0) -> Condition:
    """True at the start and at each multiple of `period` after it, all shifted by `offset`.

    Args:
        period: Seconds, above zero.
        offset: Seconds.
    """
    if period <= 0:
        raise ScenarioError(f"every {period:g} s: the period must be above zero")

    def watch(context: ExecutionContext) -> Watch:
        start, first = context.step, offset - context.late

        def due() -> bool:
            steps = context.step - start
            nearest = round((steps * context.dt - first) / period)
            return any(
                max(0, context.steps(first + max(0, number) * period)) == steps
                for number in (nearest - 1, nearest, nearest + 1)
            )

        return due

    return Condition(f"every {period:g} s", watch)


class Level:
    """Watches whether a function is true, sampled once per snapshot.

    Args:
        function: The function.
        context: The run.
    """

    __slots__ = ("_context", "_function", "_sampled", "_value")

    def __init__(self, function: Callable[[], bool], context: ExecutionContext) -> None:
        self._function = function
        self._context = context
        self._sampled = -1
        self._value = False

    def __call__(self) -> bool:
        """Return whether the function is true in the present snapshot."""
        snapshot = self._context.snapshot
        if snapshot != self._sampled:
            if self._context.is_placing:
                return False
            try:  # as in `evaluate`
                self._value = bool(self._function())
            except NO_RESULT as error:
                raise without_value(error) from error
            self._sampled = snapshot
        return self._value


class Deadline:
    """Watches for the end of a duration that begins now.

    Args:
        seconds: How long.
        context: The run.

    Attributes:
        step: Step at which it ends.
        late: Seconds by which the exact end precedes that step.
    """

    __slots__ = ("_context", "late", "step")

    def __init__(self, seconds: float, context: ExecutionContext) -> None:
        self._context = context
        self.step, self.late = context.due(seconds, context.late)

    def __call__(self) -> bool:
        """Return whether the duration is over."""
        return self._context.step >= self.step


class Edge:
    """Watches for the instant at which a function changes; its first sample is not an edge.

    Measured states flicker at a threshold: a change counts only if the value before it lasted some
    steps, or was that at the start.

    Args:
        function: The function.
        target: The value it changes to.
        context: The run.

    Attributes:
        is_vain: Whether the function had the value at the start, and has not changed to it since.
    """

    __slots__ = (
        "_context",
        "_edge",
        "_function",
        "_sampled",
        "_settled",
        "_target",
        "_value",
        "is_vain",
    )

    def __init__(
        self, function: Callable[[], bool], target: bool, context: ExecutionContext
    ) -> None:
        self._function = function
        self._target = target
        self._context = context
        self._sampled = context.snapshot
        self._settled = context.step  # step from which the value counts as settled
        self._value = None if context.is_placing else evaluate(function)
        self._edge = False
        self.is_vain = self._value is target

    def __call__(self) -> bool:
        """Return whether the function changes in the present snapshot."""
        context = self._context
        if context.snapshot != self._sampled:
            if context.is_placing:
                return False
            if self._value is None:  # its first sample: the actors are in their start positions
                self._value, self._sampled = evaluate(self._function), context.snapshot
                self.is_vain = self._value is self._target
                return False
            before = self._value
            try:  # as in `evaluate`; called in each step of each condition
                self._value = bool(self._function())
            except NO_RESULT as error:
                raise without_value(error) from error
            self._sampled = context.snapshot
            turned = self._value is not before
            self._edge = turned and self._value is self._target and context.step >= self._settled
            if turned and context.is_measured:
                self._settled = context.step + SETTLED_STEPS
            self.is_vain = self.is_vain and not self._edge
        return self._edge


def number(function: Callable[[], float]) -> float:
    """Return the result (s) of a function of the scenario.

    Raises:
        ScenarioError: It has no finite value.
    """
    try:
        seconds = float(function())
    except NO_RESULT as error:
        raise ScenarioError(f"the time has no value: {why_no_result(error)}") from error
    if not math.isfinite(seconds):
        raise ScenarioError(f"a time of {seconds} s never comes")
    return seconds


def evaluate(function: Callable[[], bool]) -> bool:
    """Return the truth of a function of the scenario.

    Raises:
        ScenarioError: It has no value, as in a division by zero or an index out of range.
    """
    try:
        return bool(function())
    except NO_RESULT as error:
        raise without_value(error) from error


def without_value(error: Exception) -> ScenarioError:
    """Return the error of a condition that has no value."""
    return ScenarioError(f"the condition has no value: {why_no_result(error)}")
