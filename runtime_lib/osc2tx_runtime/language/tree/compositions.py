"""The base of compositions, `serial` and `one_of`."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from py_trees.common import ParallelPolicy
from py_trees.composites import Parallel as ParallelComposite
from py_trees.composites import Sequence as SequenceComposite

from osc2tx_runtime.errors import UnsupportedError
from osc2tx_runtime.language.tree.base import (
    FAILURE,
    INVALID,
    RUNNING,
    SUCCESS,
    Behaviour,
    Node,
    Status,
    ended_late,
    place_key,
    pulse_of,
)
from osc2tx_runtime.language.tree.duration_limits import Duration, DurationLimits
from osc2tx_runtime.language.tree.parallel_schedule import Span
from osc2tx_shared.rules.endings import Ending, ending_of_one_of, ending_of_serial

if TYPE_CHECKING:
    from osc2tx_runtime.language.context import ExecutionContext

Member = tuple[Behaviour, Callable[[], Status]]
Rivals = Mapping[Behaviour, Collection[Behaviour]]


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
        """Whether it is over at once, as its members are; known before it is set up."""
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


class OneOf(Composition, ParallelComposite):
    """Alternatives: a race by default, or one member chosen before the start.

    In the race all members start, the first to succeed ends it (the order of the source breaks
    ties), a failing member leaves it, and it fails when all have failed. Of members that control
    the same actor from the start only one takes part, drawn from the seed.

    Args:
        name: Label, or a description.
        *members: The alternatives.
        duration: Total duration: seconds, or (least, most) seconds.

    Attributes:
        find_rivals: Returns the members that exclude each other in a race, after their setup.
    """

    def __init__(self, name: str, *members: Behaviour, duration: Duration | None = None) -> None:
        super().__init__(name, policy=ParallelPolicy.SuccessOnOne(), children=members)
        self._limit(duration)
        self._asked = False
        self._chosen: Behaviour | None = None
        self.find_rivals: Callable[[OneOf], Rivals] = lambda _: {}

    def choose(self, member: Behaviour) -> None:
        """Let one of its members be the only alternative; before its setup."""
        self._chosen = member

    def setup(self, **kwargs: Any) -> None:
        """If the scenario does not race, choose a member that fills the duration."""
        super().setup(**kwargs)
        if self._chosen is not None:
            self._members = tuple(each for each in self._members if each[0] is self._chosen)
            self._content_open = is_open(self._chosen)
            self.open_ended = self._content_open and self._limits is None
            return
        is_race = self.context.one_of == "race"
        rivals = self.find_rivals(self) if is_race else {}
        if not self._members or (is_race and not rivals):
            return
        members = self._fitting() or self._members
        if is_race:
            self._members = self._without_rivals(members, rivals)
        else:
            index = 0
            if self.context.one_of == "seeded":
                index = self.generator("one_of").randrange(len(members))
            self._members = (members[index],)
        self._content_open = (
            ending_of_one_of(ending_of(each) for each, _ in self._members) == "open"
        )
        self.open_ended = self._content_open and self._limits is None

    def _without_rivals(self, members: Sequence[Member], rivals: Rivals) -> tuple[Member, ...]:
        """Return the members of the race: in a random order, those without a rival in it.

        The draw depends on the alternatives, not on the order of the source.
        """
        drawn = sorted(members, key=lambda member: sorted(n.name for n in member[0].iterate()))
        kept = list[Member]()
        self.generator("one_of").shuffle(drawn)
        for member in drawn:
            out = rivals.get(member[0], ())
            if not any(other in out for other, _ in kept):
                kept.append(member)
        return tuple(member for member in members if member in kept)

    def initialise(self) -> None:
        """Start the race."""
        super().initialise()
        self._active, self.current_child = self._fitting(), None
        if self.context.one_of != "race" and self._members:
            self._note(self._members[0][0])

    def _content_lateness(self) -> float:
        winner = self.current_child
        return super()._content_lateness() if winner is None else ended_late(winner)

    def _fitting(self) -> list[Member]:
        """Return the members that can take the required time."""
        return [member for member, _ in self._fitting_lengths()]

    def _fitting_lengths(self) -> list[tuple[Member, int | None]]:
        """Return them with their lengths, each computed once, as members may nest deeply."""
        frame = None
        if not self._asked:  # recursion through a sibling that depends on this length
            self._asked = True
            frame = self.frame(self.context)
            self._asked = False
        lengths = [(m, None if is_open(m[0]) else length_of(m[0])) for m in self._members]
        if frame is None:
            return lengths
        fitting = [(m, n) for m, n in lengths if n is None or frame.low <= n <= frame.high]
        return fitting if fitting or self._limits is not None else lengths

    def _content_goes_on(self) -> bool:
        return any(goes_on(child) for child, _ in self._active)

    def least_length(self) -> int | None:
        """Return the least steps that one of its members needs."""
        lengths = [least_length(child) for child, _ in self._members]
        known = [length for length in lengths if length is not None]
        return min(known, default=0) if len(known) == len(lengths) else None

    def _lost(self) -> Status:
        """Fail: no member is left in the race."""
        failed = any(child.status is FAILURE for child, _ in self._members)
        if self._limits is None or failed:
            return FAILURE
        return self.fail(f"none of its members takes {self._limits.text}")

    def _counts(self, child: Behaviour) -> bool:
        """Return whether the end of a member ends the whole: whether it fills the duration."""
        limits = self._limits
        return limits is None or self.context.first_come or not limits.is_early(ended_late(child))

    def _note(self, chosen: Behaviour) -> None:
        policy = self.context.one_of
        self.context.trace.choice(self.name, policy, chosen.name, self.source)

    def _content_length(self) -> int | None:
        lengths = [length for (child, _), length in self._fitting_lengths() if not is_open(child)]
        known = [length for length in lengths if length is not None]
        return min(known, default=None) if len(known) == len(lengths) else None

    def _is_open(self) -> bool:
        return ending_of_one_of(map(ending_of, self.children)) == "open"

    def _advance(self) -> Status:
        winners = [
            child
            for child, status in self._pulse_active()
            if status is SUCCESS and self._counts(child)
        ]
        if winners:
            winner = min(winners, key=lambda child: (-ended_late(child), place_key(child)))
            for child, _ in self._active:
                child.stop(INVALID)
            self._active = []
            self.current_child = winner
            if self.context.one_of == "race":
                self._note(winner)
            return SUCCESS
        return RUNNING if self._active else self._lost()


def is_open(child: Behaviour) -> bool:
    """Return whether a member is open-ended; other py_trees behaviours are not."""
    return isinstance(child, Node) and child.open_ended


def ending_of(child: Behaviour) -> Ending:
    """Return how a member ends; one that only accompanies the others has no time of its own."""
    if is_instant(child) or is_service(child):
        return "instant"
    return "open" if is_open(child) else "bounded"


def goes_on(child: Behaviour) -> bool:
    """Return whether only the surroundings of a running member end it from here on."""
    return isinstance(child, Node) and child.goes_on()


def open_since(child: Behaviour) -> tuple[int, float]:
    """Return since when only the surroundings of a running member end it: step, lateness (s)."""
    return child.open_since() if isinstance(child, Node) else (0, 0.0)


def least_length(child: Behaviour) -> int | None:
    """Return the steps that an open-ended member needs; None if only the run shows them."""
    return child.least_length() if isinstance(child, Node) else None


def is_instant(child: Behaviour) -> bool:
    """Return whether a member takes no time."""
    if isinstance(child, Composition):
        return child.takes_no_time
    return isinstance(child, Node) and child.instant


def is_service(child: Behaviour) -> bool:
    """Return whether a member only accompanies the others."""
    return isinstance(child, Node) and child.service


def length_of(child: Behaviour) -> int | None:
    """Return the number of steps of a member, if known; unknown for other py_trees behaviours."""
    return child.length() if isinstance(child, Node) else None
