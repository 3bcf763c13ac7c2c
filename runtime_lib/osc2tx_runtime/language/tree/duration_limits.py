"""The `duration` of a node: least and most steps."""

from __future__ import annotations

import math
import sys
from typing import TYPE_CHECKING

from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.tree.base import FAILURE, RUNNING, SUCCESS, Status, place_key
from osc2tx_runtime.language.tree.failure_reasons import with_situation

if TYPE_CHECKING:
    from osc2tx_runtime.language.tree.base import Node

__all__ = ["Duration", "Limits"]

Duration = float | tuple[float, float]
"""Seconds, or the least and the most seconds, which may be without end."""

ENDLESS = sys.maxsize
"""Steps of a duration without upper bound."""


class Limits:
    """Applies a duration to the content of a node.

    Open-ended content ends with success at the least duration. Content that ends before it is
    held until then. Content that has not ended at the most duration fails, once all that happens
    at that instant has happened.
    """

    def __init__(self, node: Node, duration: Duration) -> None:
        given = duration if isinstance(duration, tuple) else (duration, duration)
        low, high = min(given), max(given)  # bounds of a range come in either order
        if not low >= 0:
            raise ScenarioError(f"{node.name}: a duration of {low:g} s is negative")
        self._node = node
        self._seconds = (low, high)
        self._low = self._high = self._start = 0
        self.content_ended = False

    def begin(self) -> None:
        """Start counting at the present step."""
        context = self._node.context
        self._start = context.step
        self._low, self._high = self._steps()
        self.content_ended = False

    def length(self, content: int | None, open_ended: bool) -> int | None:
        """Return how many steps the node takes, given those of its content."""
        low, high = self._steps()
        if open_ended or (content is None and low == high):
            return low
        return None if content is None or content > high else max(content, low)

    def _steps(self) -> tuple[int, int]:
        steps = self._node.context.steps
        low, high = self._seconds
        return steps(low), ENDLESS if math.isinf(high) else steps(high)

    @property
    def fixed(self) -> float | None:
        """The duration in seconds, if it is one number."""
        low, high = self._seconds
        return low if low == high else None

    @property
    def left(self) -> int:
        """Steps until the least duration is over."""
        return self._start + self._low - self._node.context.step

    @property
    def least(self) -> int:
        """The least duration in steps."""
        return self._node.context.steps(self._seconds[0])

    def judge(self, status: Status, open_ended: bool) -> Status:
        """Return the node's status for that of its content."""
        if status is FAILURE:
            return status
        context = self._node.context
        steps = context.step - self._start
        if status is SUCCESS:
            self.content_ended = True
            return SUCCESS if steps >= self._low else RUNNING
        if open_ended:
            return SUCCESS if steps >= self._low else RUNNING
        if steps < self._high:
            return RUNNING
        if steps == self._high and not context.settled:
            context.request_settling()  # an event of this instant may still end the content
            return RUNNING
        return self._node.fail(f"not finished within {self._seconds[1]:g} s{self._unfinished()}")

    def _unfinished(self) -> str:
        """Return which leaves inside are still running, in the order of the source."""
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
