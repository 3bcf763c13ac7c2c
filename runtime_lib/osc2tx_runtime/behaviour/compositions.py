"""The compositions of the language: serial, parallel, one_of."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal

from py_trees.common import ParallelPolicy
from py_trees.composites import Parallel as ParallelComposite
from py_trees.composites import Sequence as SequenceComposite

from osc2tx_runtime.behaviour.base import (
    FAILURE,
    INVALID,
    RUNNING,
    SUCCESS,
    Behaviour,
    Node,
    Status,
    pulse_of,
)
from osc2tx_runtime.behaviour.limits import Duration, Limits
from osc2tx_runtime.errors import UnsupportedError

__all__ = ["Composition", "OneOf", "Overlap", "Parallel", "Serial"]

Overlap = Literal["equal", "start", "end", "initial", "final", "inside", "full", "any"]
Member = tuple[Behaviour, Callable[[], Status]]


class Composition(Node):
    """What the three compositions share: their members and their duration."""

    _limits: Limits | None = None
    _members: tuple[Member, ...] = ()

    def setup(self, **kwargs: Any) -> None:
        """Take the context; find out what ends by itself. Members were set up before."""
        super().setup(**kwargs)
        self._members = tuple((child, pulse_of(child)) for child in self.children)
        self._content_open = self._is_open()
        self.open_ended = self._content_open and self._limits is None
        self.instant = self._limits is None and all(is_instant(child) for child in self.children)

    def pulse(self) -> Status:
        """Advance the members, within the duration."""
        if self.status is not RUNNING:
            self._begin()
        limits = self._limits
        if limits is None:
            status = self._advance()
        else:
            content = SUCCESS if limits.content_ended else self._advance()
            status = limits.judge(content, self._content_open)
        if status is not RUNNING:
            self.stop(status)
        return status

    def initialise(self) -> None:
        """Start the clock of the duration."""
        if self._limits is not None:
            self._limits.begin()

    def _limit(self, duration: Duration | None) -> None:
        self.label = self.name
        self._limits = None if duration is None else Limits(self, duration)

    def _is_open(self) -> bool:
        """Return whether the members never end by themselves."""
        raise NotImplementedError

    def _advance(self) -> Status:
        """Run the members for one pass."""
        raise NotImplementedError


class Serial(Composition, SequenceComposite):
    """Members one after another, without a gap.

    Args:
        name: Label, or what the composition does.
        *members: In order.
        duration: Seconds, or (least, most) seconds, that the whole takes.
    """

    def __init__(self, name: str, *members: Behaviour, duration: Duration | None = None) -> None:
        super().__init__(name, memory=True, children=members)
        self._limit(duration)
        self._index = 0

    def initialise(self) -> None:
        """Go to the first member."""
        super().initialise()
        self._index = 0

    def _is_open(self) -> bool:
        for child in self.children[:-1]:
            if is_open(child):
                raise UnsupportedError(
                    f"{child.name} never ends by itself, so what follows it would never start;"
                    " give it a duration or an until",
                    getattr(child, "source", None) or None,
                )
        return bool(self.children) and is_open(self.children[-1])

    def _advance(self) -> Status:
        members = self._members
        while self._index < len(members):
            self.current_child, pulse = members[self._index]
            status = pulse()
            if status is not SUCCESS:
                return status
            self._index += 1
        return SUCCESS


class Parallel(Composition, ParallelComposite):
    """Members at the same time; ends when the last bounded member has ended.

    Bounded are members that end by themselves and take time. Open-ended members end with the
    last bounded one; without a bounded one they run on. A failing member fails the whole.

    Args:
        name: Label, or what the composition does.
        *members: In the order of the source; it has no influence on the run.
        overlap: `start`, or `equal`: the bounded members must end at one instant.
        duration: Seconds, or (least, most) seconds, that the whole takes.
        start_to_start: Not supported yet, except 0.
        end_to_end: Not supported yet, except 0 with `equal`.
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
        self.overlap = overlap
        self.start_to_start = start_to_start
        self.end_to_end = end_to_end
        self._active: list[Member] = []
        self._bounding: frozenset[Behaviour] = frozenset()
        self._left = 0
        self._first_end: int | None = None

    def setup(self, **kwargs: Any) -> None:
        """Check what is supported, and find the members that bound the composition."""
        self._check_supported()
        super().setup(**kwargs)
        self._bounding = frozenset(
            child for child in self.children if not is_open(child) and not is_instant(child)
        )

    def initialise(self) -> None:
        """Start with all members."""
        super().initialise()
        self._active = list(self._members)
        self._left = len(self._bounding)
        self._first_end = None

    def _check_supported(self) -> None:
        if self.overlap not in ("start", "equal"):
            what = f"overlap: {self.overlap}"
        elif self.start_to_start not in (None, 0, (0, 0)):
            what = f"start_to_start: {self.start_to_start}"
        elif self.end_to_end not in ((None, 0, (0, 0)) if self.overlap == "equal" else (None,)):
            what = f"end_to_end: {self.end_to_end}"
        else:
            return
        raise UnsupportedError(f"parallel({what}) is not supported yet", self.source or None)

    def _is_open(self) -> bool:
        # Zero-time members bound nothing: `parallel: drive(); emit e` goes on.
        lasting = [child for child in self.children if not is_instant(child)]
        return bool(lasting) and all(is_open(child) for child in lasting)

    def _advance(self) -> Status:
        running: list[Member] = []
        failed = False
        for member in self._active:
            status = member[1]()
            if status is RUNNING:
                running.append(member)
            elif status is FAILURE:
                failed = True
            elif member[0] in self._bounding:
                self._left -= 1
                self._first_end = self.context.step if self._first_end is None else self._first_end
        self._active = running
        if failed:
            return FAILURE
        if not running or (self._bounding and not self._left and not self._instants_run()):
            return SUCCESS
        if self.overlap == "equal" and self._first_end is not None and self._left:
            return self._await_equal_end(self._first_end)
        return RUNNING

    def _instants_run(self) -> bool:
        """Return whether a zero-time member still needs the next pass of this instant."""
        return any(is_instant(child) for child, _ in self._active)

    def _await_equal_end(self, first_end: int) -> Status:
        if self.context.step == first_end and not self.context.settled:
            self.context.request_settling()
            return RUNNING
        late = sorted(child.name for child, _ in self._active if child in self._bounding)
        return self.fail(
            f"overlap equal: the first member ended at {first_end * self.context.dt:.3f} s,"
            f" still running: {', '.join(late)}"
        )


class OneOf(Composition, ParallelComposite):
    """Alternatives: a race by default, or one member chosen before the start.

    In the race all members start, the first to succeed ends it (the order of the source breaks
    ties), a failing member leaves it, and it fails when all have failed.

    Args:
        name: Label, or what the composition does.
        *members: The alternatives.
        duration: Seconds, or (least, most) seconds, that the whole takes.
    """

    def __init__(self, name: str, *members: Behaviour, duration: Duration | None = None) -> None:
        super().__init__(name, policy=ParallelPolicy.SuccessOnOne(), children=members)
        self._limit(duration)
        self._active: list[Member] = []

    def setup(self, **kwargs: Any) -> None:
        """Choose a member if the scenario does not race."""
        super().setup(**kwargs)
        if self.context.one_of == "race" or not self._members:
            return
        index = 0
        if self.context.one_of == "seeded":
            generator = self.context.random_for(f"one_of/{self.source}/{self.name}")
            index = generator.randrange(len(self._members))
        self._members = (self._members[index],)
        self._content_open = is_open(self._members[0][0])
        self.open_ended = self._content_open and self._limits is None

    def initialise(self) -> None:
        """Start the race."""
        super().initialise()
        self._active = list(self._members)

    def _is_open(self) -> bool:
        return bool(self.children) and all(is_open(child) for child in self.children)

    def _advance(self) -> Status:
        running: list[Member] = []
        winner: Behaviour | None = None
        for member in self._active:
            status = member[1]()
            if status is RUNNING:
                running.append(member)
            elif status is SUCCESS and winner is None:
                winner = member[0]
        if winner is not None:
            for child, _ in running:
                child.stop(INVALID)
            self._active = []
            self.current_child = winner
            return SUCCESS
        self._active = running
        return RUNNING if running else FAILURE


def is_open(child: Behaviour) -> bool:
    """Return whether a member never ends by itself; behaviours that are not ours do."""
    return isinstance(child, Node) and child.open_ended


def is_instant(child: Behaviour) -> bool:
    """Return whether a member takes no time."""
    return isinstance(child, Node) and child.instant
