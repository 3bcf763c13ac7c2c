"""Conditions on the state of the world and on scenario time.

A condition is sampled once per step, on the snapshot of that step; the passes of one instant see
one value. It starts with its use: `rise` and `fall` take their first sample there, which is no
edge; `elapsed` and `every` count steps from there.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from osc2tx_runtime.errors import ScenarioError

if TYPE_CHECKING:
    from osc2tx_runtime.context import ExecutionContext

__all__ = ["Condition", "Watch", "elapsed", "evaluate", "every", "fall", "rise", "watch_level"]

Watch = Callable[[], bool]
"""Says whether something happened by the present pass."""


class Condition:
    """A condition that has to know when its use started.

    Args:
        text: A few words for the name of the node.
        watch: Starts it: takes the context, returns the function to ask.
    """

    def __init__(self, text: str, watch: Callable[[ExecutionContext], Watch]) -> None:
        self.text = text
        self.watch = watch


def rise(function: Callable[[], bool]) -> Condition:
    """True at the instant `function` turns from false to true."""
    return Condition("rise", lambda context: _watch_edge(function, True, context))


def fall(function: Callable[[], bool]) -> Condition:
    """True at the instant `function` turns from true to false."""
    return Condition("fall", lambda context: _watch_edge(function, False, context))


def elapsed(duration: float) -> Condition:
    """True from `duration` seconds after the start on, in whole steps."""

    def watch(context: ExecutionContext) -> Watch:
        due = context.step + context.steps(duration)
        return lambda: context.step >= due

    return Condition(f"elapsed {duration:g} s", watch)


def every(period: float, offset: float = 0.0) -> Condition:
    """True at the start and at each multiple of `period` after it, all shifted by `offset`.

    Args:
        period: Seconds, above zero.
        offset: Seconds.
    """
    if period <= 0:
        raise ValueError(f"every({period}): the period must be above zero")

    def watch(context: ExecutionContext) -> Watch:
        start = context.step

        def due() -> bool:
            steps = context.step - start
            nearest = round((steps * context.dt - offset) / period)
            return any(
                context.steps(offset + max(0, number) * period) == steps
                for number in (nearest - 1, nearest, nearest + 1)
            )

        return due

    return Condition(f"every {period:g} s", watch)


def watch_level(function: Callable[[], bool], context: ExecutionContext) -> Watch:
    """Watch a function that counts while it is true, sampled once per step."""
    sampled, value = -1, False

    def happened() -> bool:
        nonlocal sampled, value
        if context.step != sampled:
            sampled, value = context.step, evaluate(function)
        return value

    return happened


def _watch_edge(function: Callable[[], bool], target: bool, context: ExecutionContext) -> Watch:
    sampled, value, edge = context.step, evaluate(function), False

    def happened() -> bool:
        nonlocal sampled, value, edge
        if context.step != sampled:
            before, value, sampled = value, evaluate(function), context.step
            edge = value is target and before is not target
        return edge

    return happened


def evaluate(function: Callable[[], bool]) -> bool:
    """Return the truth of a function of the scenario.

    Raises:
        ScenarioError: If its arithmetic fails, as in a division by zero.
    """
    try:
        return bool(function())
    except ArithmeticError as error:
        raise ScenarioError(f"the condition has no value: {error}") from error
