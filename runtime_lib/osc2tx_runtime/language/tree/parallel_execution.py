"""Execution of the schedule of a `parallel`: starts, ends and watches its members."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from osc2tx_runtime.language.tree.base import FAILURE, RUNNING, SUCCESS, Status, place_key
from osc2tx_runtime.language.tree.members import Member, goes_on, is_open
from osc2tx_runtime.language.tree.parallel_schedule import INF, Schedule

if TYPE_CHECKING:
    from osc2tx_runtime.language.tree.base import Node


class _Runner:
    """One member in execution: planned start, actual start and end (steps)."""

    def __init__(self, member: Member, start: int | None) -> None:
        self.node, self.pulse = member
        self.start = start
        self.open_ended = is_open(self.node)
        self.running = False
        self.end: int | None = None

    @property
    def key(self) -> tuple[int, str]:
        """Order in which members are named."""
        return place_key(self.node)


class Course:
    """One execution of a scheduled `parallel`.

    In each pass all running members are advanced first; then their results determine which members
    end and start. So the order of the members has no influence.

    Args:
        owner: The composition.
        members: Those that take time, the primary first.
        schedule: Their plan.
        what: Name of the rule for messages.
    """

    def __init__(
        self, owner: Node, members: Sequence[Member], schedule: Schedule, what: str
    ) -> None:
        self._owner = owner
        self._context = owner.context
        self._what = what
        self._begin = self._context.step
        self._ete = schedule.end_to_end
        self._length = schedule.primary_length
        self._all = [
            _Runner(member, None if start is None else start + self._begin)
            for member, start in zip(members, schedule.starts, strict=True)
        ]
        self._primary, *self._others = self._all
        self._bounded = [other for other in self._others if not other.open_ended]
        self._failed = False

    def advance(self) -> Status:
        """Advance all members by one pass."""
        step = self._context.step
        for runner in self._all:
            if runner.end is None and runner.start is not None and step >= runner.start:
                runner.running = True
            if runner.running:
                self._pulse(runner)
        self._end_open_primary(step)
        if self._primary.end is not None:
            waiting = [r for r in self._others if r.start is None]
            for runner in waiting:
                runner.start, runner.running = step, True
                self._pulse(runner)
        self._end_open_others(step)
        if self._failed:
            return FAILURE
        problem = self._problem(step)
        if problem and not self._context.settled:
            self._context.request_settling()  # further changes of this instant may solve it
            return RUNNING
        if problem:
            return self._owner.fail(f"{self._what}: {problem}")
        return SUCCESS if all(runner.end is not None for runner in self._all) else RUNNING

    def _pulse(self, runner: _Runner) -> None:
        status = runner.pulse()
        if status is not RUNNING:
            runner.running = False
            runner.end = self._context.step
            self._failed = self._failed or status is FAILURE

    def _finish(self, runner: _Runner) -> None:
        """End an open-ended member."""
        runner.node.stop(SUCCESS)
        self._failed = self._failed or runner.node.status is FAILURE
        runner.running = False
        runner.end = self._context.step

    def _end_open_primary(self, step: int) -> None:
        primary = self._primary
        if not primary.running or not goes_on(primary.node) or self._failed:
            return
        if self._length is not None:
            assert primary.start is not None
            if step >= primary.start + self._length:
                self._finish(primary)
        elif self._bounded:
            ends = [other.end for other in self._bounded if other.end is not None]
            if self._ete.low >= 0:  # not after any other: with the first end
                over = bool(ends)
            else:
                all_ended = len(ends) == len(self._bounded)
                over = all_ended and step >= max(ends) + max(0, -self._ete.high)
            if over:
                self._finish(primary)

    def _end_open_others(self, step: int) -> None:
        """End the open-ended members with the last bounded one, or when they have to."""
        first = self._primary
        end = first.end
        if end is None and self._length is not None and first.start is not None:
            end = first.start + self._length  # it will
        if end is None:
            return
        ends = [other.end for other in [first, *self._bounded] if other.end is not None]
        last = max(ends) if len(ends) > len(self._bounded) else INF
        target = max(end + self._ete.low, min(end + self._ete.high, last))
        for other in self._others:
            if other.running and goes_on(other.node) and step >= target and not self._failed:
                self._finish(other)

    def _problem(self, step: int) -> str:
        """Return the broken rule, if the instant has no further changes."""
        others = sorted(self._others, key=lambda runner: runner.key)
        found = [text for other in others if (text := self._late_or_early(other, step))]
        found += self._apart(step)
        return found[0] if found else ""

    def _late_or_early(self, other: _Runner, step: int) -> str:
        first = self._primary
        if other.end is None and first.end is not None and step >= first.end + self._ete.high:
            return f"{other.node.name} still runs {self._after(step, first.end, first)}"
        if other.end is not None and first.end is not None:
            span, offset = self._ete, other.end - first.end
            if not span.low <= offset <= span.high:
                return f"{other.node.name} ended {self._seconds(offset)} {first.node.name}"
        if other.end is not None and first.end is None and step >= other.end - self._ete.low:
            return f"{first.node.name} still runs {self._after(step, other.end, other)}"
        return ""

    def _apart(self, step: int) -> list[str]:
        """Return the members that start only after another has ended."""
        late = [r for r in self._all if r.end is None and not r.running]
        early = [r for r in self._all if r.end is not None and r.end <= step]
        pairs = [(one, other) for one in early for other in late if other.start is not None]
        pairs.sort(key=lambda pair: (pair[0].key, pair[1].key))
        return [
            f"{one.node.name} has ended before {other.node.name} starts" for one, other in pairs
        ]

    def _after(self, step: int, end: int, ended: _Runner) -> str:
        if step == end:
            return f"when {ended.node.name} has ended"
        return f"{self._seconds(step - end)} the end of {ended.node.name}"

    def _seconds(self, steps: int) -> str:
        seconds = f"{abs(steps) * self._context.dt:g} s"
        return f"{seconds} before" if steps < 0 else f"{seconds} after"
