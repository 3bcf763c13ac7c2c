"""The composition `one_of`: a race, or one member chosen before the start."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any

from py_trees.common import ParallelPolicy
from py_trees.composites import Parallel as ParallelComposite

from osc2tx_runtime.language.tree.base import (
    FAILURE,
    INVALID,
    RUNNING,
    SUCCESS,
    Behaviour,
    Status,
    place_key,
)
from osc2tx_runtime.language.tree.compositions import Composition
from osc2tx_runtime.language.tree.duration_limits import Duration
from osc2tx_runtime.language.tree.members import (
    Member,
    ended_late,
    ending_of,
    goes_on,
    is_open,
    least_length,
    length_of,
)
from osc2tx_shared.rules.endings import ending_of_one_of

Rivals = Mapping[Behaviour, Collection[Behaviour]]


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
