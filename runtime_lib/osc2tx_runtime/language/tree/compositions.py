"""The base of compositions, and `serial`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from py_trees.composites import Sequence as SequenceComposite

from osc2tx_runtime.errors import UnsupportedError
from osc2tx_runtime.language.tree.base import RUNNING, SUCCESS, Behaviour, Node, Status
from osc2tx_runtime.language.tree.duration_limits import Duration, DurationLimits
from osc2tx_runtime.language.tree.members import (
    Member,
    ended_late,
    ending_of,
    goes_on,
    is_instant,
    is_open,
    least_length,
    length_of,
    open_since,
    pulse_of,
)
from osc2tx_runtime.language.tree.parallel_schedule import Span
from osc2tx_shared.rules.endings import ending_of_serial

if TYPE_CHECKING:
    from osc2tx_runtime.language.context import ExecutionContext


class Composition(Node):
    """The common base of the three compositions: their members and their duration."""

    _limits: DurationLimits | None = None
    _members: tuple[Member, ...] = ()
    _active: list[Member]  # the running ones, if several are
    _is_plain = True  # only the members decide its outcome
    _may_rest = True  # only they, and the time
    _content_open = True  # before its setup nothing is known about the length of its members

    def setup(self, **kwargs: Any) -> None:
        """Take the context; determine what ends on its own. Members were set up before."""
        super().setup(**kwargs)
        self._members = tuple((child, pulse_of(child)) for child in self.children)
        self._is_plain = self._limits is None
        self._content_open = self._is_open()
        self.open_ended = self._content_open and self._limits is None
        self.instant = self.takes_no_time

    @property
    def takes_no_time(self) -> bool:
        """Whether it is over at once, as its members are."""
        return self._limits is None and all(is_instant(child) for child in self.children)

    def pulse(self) -> Status:
        """Advance the members, within the duration."""
        if self.status is not RUNNING:
            self._begin()
        status = self._advance() if self._is_plain else self._judged()
        if status is not RUNNING:
            self.stop(status)
        return self.status

    def _judged(self) -> Status:
        """Advance the members; return the status of the whole."""
        status = self._advance()
        if self._limits is None:
            return status
        late = self._content_lateness() if status is SUCCESS else 0.0
        return self._limits.judge(status, self._content_goes_on(), late)

    @property
    def limits(self) -> DurationLimits | None:
        """The effective duration; None without one."""
        return self._limits

    def initialise(self) -> None:
        """Start the clock of the duration."""
        if self._limits is not None:
            self._limits.begin()

    def lateness(self) -> float:
        """Return that of its duration, else of its members."""
        late = None if self._limits is None else self._limits.late
        return self._content_lateness() if late is None else late

    def _content_lateness(self) -> float:
        """Return the lateness (s) of the end of the members."""
        return super().lateness()

    def frame(self, context: ExecutionContext) -> Span:
        """Return its possible steps, by its duration and the enclosing ones (§7.6.2.1).

        Args:
            context: The run; the nodes around are set up later.
        """
        if context.first_come:
            return Span(0)
        own = Span(0) if self._limits is None else self._limits.frame(context)
        around = self.parent
        return own.meet(around._frame_of(self, context)) if isinstance(around, Composition) else own

    def _frame_of(self, member: Behaviour, context: ExecutionContext) -> Span:
        """Return the possible steps of a member."""
        return self.frame(context)

    def _limit(self, duration: Duration | None) -> None:
        self.label = self.name
        self._limits = None if duration is None else DurationLimits(self, duration)

    def _is_open(self) -> bool:
        """Return whether the members are open-ended."""
        raise NotImplementedError

    def goes_on(self) -> bool:
        """Return whether only its surroundings end it: no duration and no running member does."""
        return self._limits is None and self._content_goes_on()

    def _content_goes_on(self) -> bool:
        """Return whether the running members go on; a `serial` first has to reach its last one."""
        raise NotImplementedError

    def length(self) -> int | None:
        """Return the number of steps of the composition, if its members determine it."""
        content = None if self._content_open else self._content_length()
        return content if self._limits is None else self._limits.length(content, self._content_open)

    def _content_length(self) -> int | None:
        """Return the number of steps of the members."""
        return None

    def _advance(self) -> Status:
        """Run the members for one pass."""
        raise NotImplementedError

    def _pulse_active(self) -> list[tuple[Behaviour, Status]]:
        """Pulse the running members that do not rest; return those that end, with their status."""
        resting, active, rests = self.context.resting.nodes, self._active, self._may_rest
        ended: list[tuple[Behaviour, Status]] = []
        for child, pulse in active:
            if child in resting:
                continue
            status = pulse()
            if status is not RUNNING:
                ended.append((child, status))
            elif child not in resting:
                rests = False
        if ended:
            gone = {child for child, _ in ended}
            self._active = [member for member in active if member[0] not in gone]
        elif rests and active:
            self._rest()
        return ended

    def _rest(self) -> None:
        """Rest if all running members rest, until its duration may end."""
        if self._limits is None or self._limits.rest():
            self.context.resting.nodes.add(self)


class Serial(Composition, SequenceComposite):
    """Members one after another, without a gap.

    Args:
        name: Label, or a description.
        *members: In order.
        duration: Total duration: seconds, or (least, most) seconds.
    """

    def __init__(self, name: str, *members: Behaviour, duration: Duration | None = None) -> None:
        super().__init__(name, memory=True, children=members)
        self._limit(duration)
        self._index = 0

    def initialise(self) -> None:
        """Start with the first member."""
        super().initialise()
        self._index = 0

    def _is_open(self) -> bool:
        for child in self.children[:-1]:
            if is_open(child) and not getattr(child, "may_end", False):
                raise UnsupportedError(
                    f"{child.name} never ends by itself, so what follows it would never start;"
                    " give it a duration or an until",
                    getattr(child, "source", None) or None,
                )
        return ending_of_serial(map(ending_of, self.children)) == "open"

    def _content_length(self) -> int | None:
        lengths = [length_of(child) for child in self.children]
        known = [length for length in lengths if length is not None]
        return sum(known) if len(known) == len(lengths) else None

    def _frame_of(self, member: Behaviour, context: ExecutionContext) -> Span:
        frame = self.frame(context)
        if frame == Span(0):
            return frame
        lengths = [None if is_open(c) else length_of(c) for c in self.children if c is not member]
        known = [length for length in lengths if length is not None]
        low = frame.low - sum(known) if len(known) == len(lengths) else 0
        least = sum(max(length - 1, 0) for length in known)  # a length is rounded up to steps
        return Span(max(low, 0), frame.high - least)

    def _advance(self) -> Status:
        members, context, resting = self._members, self.context, self.context.resting.nodes
        late = context.late
        while self._index < len(members):
            self.current_child, pulse = members[self._index]
            status = RUNNING if self.current_child in resting else pulse()
            if status is not SUCCESS:
                context.late = late
                if self.current_child in resting:
                    self._rest()
                return status
            self._index += 1
            context.late = ended_late(self.current_child)
        context.late = late
        return SUCCESS

    def _content_goes_on(self) -> bool:
        is_last = self._index == len(self._members) - 1
        return is_last and goes_on(self.children[-1])

    def open_since(self) -> tuple[int, float]:
        """Return when its last member has become so."""
        return open_since(self.children[-1])

    def least_length(self) -> int | None:
        """Return the steps before its last member, and those that this one needs."""
        lengths = [length_of(child) for child in self.children[:-1]]
        known = [n for n in (*lengths, least_length(self.children[-1])) if n is not None]
        return sum(known) if len(known) == len(self.children) else None

    def _content_lateness(self) -> float:
        return ended_late(self.children[-1]) if self.children else super()._content_lateness()
