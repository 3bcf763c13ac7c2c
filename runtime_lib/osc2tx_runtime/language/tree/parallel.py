"""The composition `parallel`, with overlaps and offsets."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from py_trees.common import ParallelPolicy
from py_trees.composites import Parallel as ParallelComposite

from osc2tx_runtime.errors import UnsupportedError
from osc2tx_runtime.language.tree.base import (
    FAILURE,
    RUNNING,
    SUCCESS,
    Behaviour,
    Status,
    place_key,
)
from osc2tx_runtime.language.tree.compositions import Composition
from osc2tx_runtime.language.tree.duration_limits import Duration, bounds_of
from osc2tx_runtime.language.tree.members import (
    Member,
    ended_late,
    ending_of,
    goes_on,
    is_instant,
    is_open,
    is_service,
    least_length,
    length_of,
    open_since,
)
from osc2tx_runtime.language.tree.parallel_execution import Course
from osc2tx_runtime.language.tree.parallel_schedule import (
    Overlap,
    Part,
    Schedule,
    Span,
    Unplannable,
    make_schedule,
    spans_of,
)
from osc2tx_shared.rules.endings import ending_of_parallel

if TYPE_CHECKING:
    from osc2tx_runtime.language.context import ExecutionContext


class Parallel(Composition, ParallelComposite):
    """Members at the same time; ends when the last bounded member has ended.

    Bounded members end on their own and take time. Open-ended members end with the last bounded
    one; without a bounded one they continue. A failing member fails the whole.

    `On` and samples also register the last instant: the end waits until it is settled.

    Overlaps other than `start` bound the starts and ends of the other members relative to the
    first, the primary (`parallel_schedule`). The order of the others has no influence.

    Args:
        name: Label, or a description.
        *members: In the order of the source.
        overlap: Their relation in time.
        duration: Its duration: seconds, or (least, most) seconds.
        start_to_start: Seconds, or (least, most) seconds, from the start of the first member to
            that of each other member.
        end_to_end: The same for the ends.
    """

    def __init__(
        self,
        name: str,
        *members: Behaviour,
        overlap: Overlap = "start",
        duration: Duration | None = None,
        start_to_start: Duration | None = None,
        end_to_end: Duration | None = None,
    ) -> None:
        policy = ParallelPolicy.SuccessOnAll(synchronise=True)
        super().__init__(name, policy=policy, children=members)
        self._limit(duration)
        self.overlap: Overlap = overlap
        self.start_to_start = start_to_start
        self.end_to_end = end_to_end
        self._timed: Sequence[Behaviour] = ()  # its members with rules of time
        self._bounding: frozenset[Behaviour] = frozenset()
        self._left = 0
        self._late = (0, 0.0)
        self._services: list[Member] = []
        self._verdict: Status | None = None
        self._schedule: Schedule | None = None
        self._course: Course | None = None

    def setup(self, **kwargs: Any) -> None:
        """Plan the members, and find those that bound the composition."""
        super().setup(**kwargs)
        self._services = [member for member in self._members if is_service(member[0])]
        self._timed = self._lasting()
        self._bounding = frozenset(child for child in self._timed if not is_open(child))
        if self.overlap != "start" or self.start_to_start or self.end_to_end is not None:
            self._schedule = self._plan()
        self._may_rest = not self._services and self._schedule is None
        self._is_plain = self._is_plain and self._may_rest

    def initialise(self) -> None:
        """Start with all members, or as planned."""
        super().initialise()
        self._active = list(self._members)
        self._left = len(self._bounding)
        self._late = (-1, 0.0)
        self._verdict = None
        if self._schedule is not None:
            lasting = set(self._timed)
            self._active = [member for member in self._members if member[0] not in lasting]
            timed = [member for member in self._members if member[0] in lasting]
            self._course = Course(self, timed, self._schedule, f"overlap {self.overlap}")

    def _judged(self) -> Status:
        """Judge a pass; an end counts once the instant is settled."""
        if self._verdict is not None:
            reacted = [pulse() for node, pulse in self._services if node.status is RUNNING]
            if FAILURE in reacted:
                self._verdict = FAILURE
            if self.context.settled:
                return self._verdict
        else:
            status = super()._judged()
            if status is RUNNING or not self._services:
                return status
            self._verdict = status
        self.context.request_settling()
        return RUNNING

    def _lasting(self) -> list[Behaviour]:
        """Return the members with rules of time; zero-time ones and `on` have none."""
        return [child for child in self.children if ending_of(child) != "instant"]

    def _plan(self) -> Schedule | None:
        lasting = self._lasting()
        if len(lasting) < 2:
            return None
        # The order of the secondaries only determines which of several errors is reported.
        others = sorted(lasting[1:], key=place_key)
        nodes = [lasting[0], *others]
        parts = [Part(node.name, length_of(node), is_open(node)) for node in nodes]
        try:
            sts, ete = spans_of(
                self.overlap, self._span(self.start_to_start), self._span(self.end_to_end)
            )
            frame = self.frame(self.context)
            if frame.low > frame.high:
                raise Unplannable("the enclosing durations leave no time for it")
            plan = make_schedule(parts, sts, ete, frame)
        except Unplannable as problem:
            raise UnsupportedError(
                f"parallel({self._arguments()}) cannot be scheduled: {problem}",
                self.source or None,
            ) from None
        start_of = dict(zip(nodes, plan.starts, strict=True))
        starts = tuple(start_of[node] for node in lasting)
        return Schedule(starts, plan.primary_length, plan.end_to_end, plan.length)

    def _frame_of(self, member: Behaviour, context: ExecutionContext) -> Span:
        frame = self.frame(context)
        lasting = self._lasting()
        if member not in lasting or len(lasting) == 1:
            return frame
        if self.overlap != "equal":
            return Span(0, frame.high)
        for other in lasting:
            length = None if other is member or is_open(other) else length_of(other)
            frame = frame if length is None else frame.meet(Span(length, length))
        return frame

    def _span(self, offset: Duration | None) -> Span | None:
        if offset is None:
            return None
        low, high = bounds_of(offset)
        return Span(self.context.steps(low), self.context.steps(high))

    def _arguments(self) -> str:
        texts = [f"overlap: {self.overlap}"]
        for name in ("start_to_start", "end_to_end"):
            offset = getattr(self, name)
            if offset is not None:
                low, high = bounds_of(offset)
                texts.append(f"{name}: {low:g} s" + ("" if low == high else f" to {high:g} s"))
        return ", ".join(texts)

    def _is_open(self) -> bool:
        return ending_of_parallel(map(ending_of, self.children)) == "open"

    def _content_length(self) -> int | None:
        if self._schedule is not None:
            return self._schedule.length
        lengths = [
            least_length(child) if is_open(child) else length_of(child) for child in self._lasting()
        ]
        known = [length for length in lengths if length is not None]
        return max(known, default=0) if len(known) == len(lengths) else None

    def _advance(self) -> Status:
        failed = False
        for child, status in self._pulse_active():
            if status is FAILURE:
                failed = True
            elif child in self._bounding:
                self._left -= 1
                self._note_end(child)
        if self._course is not None:
            return self._advance_course(failed)
        if failed:
            return FAILURE
        if self._is_over():
            return RUNNING if self._stretches() else SUCCESS
        return RUNNING

    def _is_over(self) -> bool:
        """Return whether all bounding members have ended; reactions do not bound it."""
        if self._bounding:
            return not self._active or (not self._left and self._others_go_on())
        return all(is_service(child) for child, _ in self._active) and (
            not self._active or len(self._services) < len(self._members)
        )

    def _others_go_on(self) -> bool:
        """Return whether the running members that do not bound it may end with it.

        An open-ended `serial` may once it has reached its last member; one of zero time still needs
        the next pass of this instant.
        """
        return all(is_service(child) or goes_on(child) for child, _ in self._active)

    def open_since(self) -> tuple[int, float]:
        """Return when the last of its members has become so."""
        since = [open_since(child) for child in self._timed if child.status is RUNNING]
        return max(since, key=lambda each: (each[0], -each[1]), default=super().open_since())

    def least_length(self) -> int | None:
        """Return the most steps that one of its members needs."""
        lengths = [least_length(child) for child in self._lasting()]
        return None if None in lengths else max(filter(None, lengths), default=0)

    def _stretches(self) -> bool:
        """Return whether open-ended members fill the rest of the least duration."""
        limits = self._limits
        return (
            limits is not None
            and not self.context.first_come
            and limits.left > 0
            and any(is_open(child) and not is_service(child) for child, _ in self._active)
        )

    def _content_goes_on(self) -> bool:
        left = [child for child in self._timed if child.status is not SUCCESS]
        return bool(left) and all(child.status is RUNNING and goes_on(child) for child in left)

    def _note_end(self, member: Behaviour) -> None:
        """Store the lateness of the last end."""
        step, late = self._late
        ended = ended_late(member)
        self._late = (self.context.step, min(late, ended) if step == self.context.step else ended)

    def _content_lateness(self) -> float:
        now = self.context.step
        open_ones = [child for child in self._timed if is_open(child)]
        others = [open_since(child) for child in open_ones if child.status is RUNNING]
        late = [late for step, late in (self._late, *others) if step == now]
        return min(late) if late else super()._content_lateness()

    def _advance_course(self, failed: bool) -> Status:
        """Advance the scheduled members."""
        course = self._course
        assert course is not None
        status = course.advance()
        if failed:
            return FAILURE
        return RUNNING if status is SUCCESS and self._instants_run() else status

    def _instants_run(self) -> bool:
        """Return whether a zero-time member still needs the next pass of this instant."""
        return any(is_instant(child) for child, _ in self._active)
