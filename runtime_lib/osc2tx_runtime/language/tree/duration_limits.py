"""The `duration` of a node: least and most steps."""

from __future__ import annotations

import math
import sys
from typing import TYPE_CHECKING

from osc2tx_runtime.clock import is_longer
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.tree.base import FAILURE, RUNNING, SUCCESS, Status, place_key
from osc2tx_runtime.language.tree.failure_reasons import with_situation
from osc2tx_runtime.language.tree.parallel_schedule import INF, Span

if TYPE_CHECKING:
    from osc2tx_runtime.language.context import ExecutionContext
    from osc2tx_runtime.language.tree.base import Node

Duration = float | tuple[float, float]
"""Seconds, or the least and the most seconds, which may be infinite."""


def bounds_of(duration: Duration) -> tuple[float, float]:
    """Return the least and the most seconds; bounds come in either order."""
    given = duration if isinstance(duration, tuple) else (duration, duration)
    return min(given), max(given)


ENDLESS = sys.maxsize
"""Steps of a duration without upper bound."""


class DurationLimits:
    """Applies a duration to the content of a node (DSL 7.6.2.1, 7.6.2.4.1).

    Open-ended content ends with success when the duration is over: at a time drawn from its range,
    or at its upper bound if an `until` ends it before. Content that ends before the least duration
    fails: there is no idle waiting. Content that has not ended at the greatest duration fails, once
    that instant is settled.

    With `context.first_come`, content ends on its own or at the greatest duration, whichever comes
    first.

    Attributes:
        until: The `until` that ends the node; empty without one.
        is_over: Whether its end has ended open-ended content.
        late: Seconds by which the exact end of the duration precedes the step at which the node
            ends; None if it ends otherwise.
    """

    def __init__(self, node: Node, duration: Duration) -> None:
        low, high = bounds_of(duration)
        if not low >= 0:
            raise ScenarioError(f"{node.name}: a duration of {low:g} s is negative")
        self._node = node
        self._seconds = (low, high)
        self._low = self._high = self._end = (0, 0.0)
        self.until = ""
        self.is_over = False
        self.late: float | None = None

    def begin(self) -> None:
        """Start counting at the exact start of the node."""
        due, late = self._node.context.due, self._node.started_late
        low, high = self._seconds
        self._low = due(low, late)
        self._high = (ENDLESS, 0.0) if math.isinf(high) else due(high, late)
        self._end = self._high if self.until else due(self._open_length(), late)
        self.is_over, self.late = False, None

    def _open_length(self) -> float:
        """Return the seconds that open-ended content takes."""
        low, high = self._seconds
        if low == high or math.isinf(high) or self._node.context.first_come:
            return low
        return self._node.generator("duration").uniform(low, high)

    def length(self, content: int | None, open_ended: bool) -> int | None:
        """Return the steps of the node, given the steps of its content."""
        low, high = self._steps()
        if open_ended:
            return None if self.until else self._node.context.steps(self._open_length())
        if content is None and low == high:
            return low
        return None if content is None or content > high else max(content, low)

    def _steps(self) -> tuple[int, int]:
        steps = self._node.context.steps
        low, high = self._seconds
        return steps(low), ENDLESS if math.isinf(high) else steps(high)

    @property
    def fixed(self) -> float | None:
        """The duration in seconds, if it is a single number."""
        low, high = self._seconds
        return low if low == high else None

    @property
    def seconds(self) -> tuple[float, float]:
        """The least and the most seconds."""
        return self._seconds

    @property
    def text(self) -> str:
        """The required duration, for messages."""
        low, high = self._seconds
        if low == high:
            return f"{low:g} s"
        return f"at least {low:g} s" if math.isinf(high) else f"{low:g} s to {high:g} s"

    @property
    def left(self) -> int:
        """Steps until the least duration is over."""
        return self._low[0] - self._node.context.step

    @property
    def most_left(self) -> float:
        """Steps until the most duration is over."""
        return math.inf if math.isinf(self._seconds[1]) else self._high[0] - self._node.context.step

    @property
    def ends_open(self) -> bool:
        """Whether it ends open-ended content at a time known from the start."""
        return not self.until and not math.isinf(self._seconds[1])

    @property
    def open_left(self) -> int:
        """Steps until the end of open-ended content."""
        return self._end[0] - self._node.context.step

    def is_early(self, late: float) -> bool:
        """Return whether an end at this step is before the least duration is over.

        Args:
            late: Seconds by which the exact end precedes the step.
        """
        step, low_late = self._low
        context = self._node.context
        now = context.step
        return now < step or (now == step and is_longer(late, low_late, context.dt))

    def frame(self, context: ExecutionContext) -> Span:
        """Return the possible steps of its content."""
        low, high = self._seconds
        return Span(context.steps(low), INF if math.isinf(high) else context.steps(high))

    def rest(self) -> bool:
        """Schedule the wake-up of its node at its next end; return whether it may rest now."""
        context = self._node.context
        step, ends = context.step, [end for end, _ in (self._low, self._end, self._high)]
        if step >= min(ends[1:]):
            return False
        context.resting.until(self._node, min(end for end in ends if end > step))
        return True

    def judge(self, status: Status, open_ended: bool, late: float = 0.0) -> Status:
        """Return the status of the node for that of its content.

        Args:
            status: Of the content.
            open_ended: Whether only this duration ends the content from here on.
            late: Seconds by which its exact end precedes this step.
        """
        context = self._node.context
        step = context.step
        if status is FAILURE:
            return status
        if status is SUCCESS:
            return self._check_end(late)
        if open_ended:
            return self._check_open()
        if step < self._high[0]:
            return RUNNING
        if step == self._high[0] and not context.settled:
            context.request_settling()  # an event of this instant may still end the content
            return RUNNING
        if context.first_come:
            self.late = self._high[1]
            return SUCCESS
        return self._node.fail(f"not finished within {self._seconds[1]:g} s{self._unfinished()}")

    def _check_end(self, late: float) -> Status:
        """Judge content that ends on its own."""
        if self.is_early(late) and not self._node.context.first_come:
            over = self._node.lasted(late)
            return self._node.fail(
                f"ended after {over:g} s, and none of its members fills its duration of {self.text}"
            )
        if self.fixed is not None and self._node.context.step == self._low[0]:
            self.late = self._low[1]
        return SUCCESS

    def _check_open(self) -> Status:
        """Judge open-ended content."""
        context = self._node.context
        end, late = self._end
        if context.step < end:
            return RUNNING
        if self.until and self.fixed is not None and not context.first_come:
            if not context.settled:
                context.request_settling()  # it may still come
                return RUNNING
            return self._node.fail(f"its duration of {self.text} is over before {self.until}")
        self.is_over = True
        self.late = late if context.step == end else None  # else its members have needed longer
        return SUCCESS

    def _unfinished(self) -> str:
        """Return the running leaves inside, in the order of the source."""
        leaves = [
            (place_key(leaf), leaf)
            for leaf in self._node.iterate()
            if leaf.status is RUNNING and not leaf.children and leaf is not self._node
            if not getattr(leaf, "synthetic", False)
        ]
        if self._node.status is RUNNING and not self._node.children:
            situation = self._node.situation()
            return f", while {situation}" if situation else ""
        leaves.sort(key=lambda pair: pair[0])
        names = [with_situation(leaf.name, leaf) for _, leaf in leaves]
        return f"; still running: {', '.join(names)}" if names else ""
