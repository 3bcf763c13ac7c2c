"""Flows: start and end conditions as an OR of ANDs of tests, the only form triggers have.

A test that stays true once it is (the state `completeState` of an element, a point in time) is
latched. Only a latched flow can be waited on for a time, or be joined with others.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import chain, product
from math import inf, prod
from typing import Literal, TypeAlias

from osc2tx.losses.entries import Inexpressible, Remedy
from osc2tx.xosc import elements as xml
from osc2tx.xosc.literals import StoryboardElementState
from osc2tx_shared.classes import dataclass, replace

ElementKind: TypeAlias = Literal["act", "action", "event", "maneuver", "maneuverGroup", "story"]
Edge: TypeAlias = Literal["none", "rising", "falling"]

RUN = ""
"""What stands for the start of the run among the names of events."""

ROUNDING = 1e-9
"""Seconds by which sums of lengths may be off."""


@dataclass(frozen=True, slots=True)
class Test:
    """One condition of a trigger.

    Attributes:
        condition: `ByValueCondition` or `ByEntityCondition`.
        edge: Whether only a change counts.
        delay: Seconds for which its value is held back.
        latched: It stays true.
        reached: The time at which it becomes true (s), if it is a point in time.
        is_constant: It is the same during the whole run.
        event: The event whose end it is, or the act whose start it is, if it is one.
        follows: Such moments before that one, each with the seconds that surely lie between.
    """

    condition: xml.ConditionPart
    edge: Edge = "none"
    delay: float = 0.0
    latched: bool = False
    reached: float | None = None
    is_constant: bool = False
    event: str | None = None
    follows: tuple[tuple[str, float], ...] = ()

    @property
    def since(self) -> tuple[str | None, float]:
        """After the end of which event it becomes true, and how many seconds."""
        return (self.event, self.delay) if self.reached is None else (RUN, self.reached)

    def after(self, other: Test) -> float | None:
        """Return how long (s) after the other one it becomes true at least; `None` if not known."""
        event, seconds = other.since
        own, delay = self.since
        if event is None or own is None:
            return None
        between = 0.0 if event == own else dict(self.follows).get(event)
        return None if between is None else between + delay - seconds

    def later(self, seconds: float) -> Test:
        """Return the test that becomes true so much later."""
        if self.is_constant:
            return self
        if self.reached is not None:
            return at_time(self.reached + seconds)
        return replace(self, delay=self.delay + seconds)


Group: TypeAlias = tuple[Test, ...]


@dataclass(frozen=True, slots=True)
class Flow:
    """An OR of groups; within a group all tests must hold. Without groups it never becomes true.

    Attributes:
        groups: The groups.
        open_since: Of the end of an open-ended member, which never comes by itself: since when its
            surroundings may end it. `None`: since its start.
    """

    groups: tuple[Group, ...]
    open_since: Flow | None = None

    @property
    def is_latched(self) -> bool:
        """Whether it stays true once it is."""
        return all(test.latched for group in self.groups for test in group)

    @property
    def is_never(self) -> bool:
        """Whether it cannot become true."""
        return not self.groups

    def later(self, seconds: float) -> Flow:
        """Return the flow that becomes true so much later; only latched ones can be asked."""
        if seconds == 0.0:
            return self
        return Flow(tuple(tuple(test.later(seconds) for test in group) for group in self.groups))

    def followed_after(self, seconds: float) -> tuple[tuple[str, float], ...]:
        """Return the events that end before what ends so long after it, as in `Test.follows`."""
        if len(self.groups) != 1:
            return ()
        found: dict[str, float] = {}
        for test in self.groups[0]:
            event, delay = test.since
            ends = test.follows if event is None else ((event, 0.0), *test.follows)
            for name, between in ends:
                found[name] = max(found.get(name, 0.0), between + delay + seconds)
        return tuple(found.items())

    def is_surely_after(self, other: Flow) -> bool:
        """Whether it becomes true later than the other one, if it does."""
        if len(other.groups) != 1:
            return False
        delays = (
            max((own.after(each) or 0.0 for own in group), default=0.0)
            for group in self.groups
            for each in other.groups[0]
        )
        return all(delay > ROUNDING for delay in delays)

    def __and__(self, other: Flow) -> Flow:
        return all_of((self, other))

    def __or__(self, other: Flow) -> Flow:
        return any_of((self, other))


NEVER = Flow(())

MOST_GROUPS = 64
"""Groups of an AND of ORs: their numbers multiply."""


def are_few(flows: Sequence[Flow]) -> bool:
    """Return whether the AND of flows is short enough for a trigger."""
    return prod(len(flow.groups) for flow in flows) <= MOST_GROUPS


def all_of(flows: Sequence[Flow]) -> Flow:
    """Return when all flows are true.

    Raises:
        Inexpressible: Their groups are too many.
    """
    if not are_few(flows):
        raise Inexpressible(
            f"it has more than {MOST_GROUPS} combinations of alternatives",
            remedy=Remedy(instead="an event for each `or` is exact"),
        )
    choices = product(*(flow.groups for flow in flows))
    return Flow(tuple(_without_implied(chain.from_iterable(groups)) for groups in choices))


def any_of(flows: Iterable[Flow]) -> Flow:
    """Return when one of the flows is true."""
    given = tuple(flows)
    groups = tuple(dict.fromkeys(group for flow in given for group in flow.groups))
    since = next((flow.open_since for flow in given if flow.open_since is not None), None)
    return Flow(groups) if groups else Flow((), since)


def _without_implied(tests: Iterable[Test]) -> Group:
    """Return different tests, in their order, without those that follow from others."""
    kept = tuple(dict.fromkeys(tests))
    latest: dict[str, Test] = {}  # by event, of the tests for its end
    followed: dict[str, float] = {}  # seconds after an event at which another test becomes true
    for test in kept:
        event, seconds = test.since
        if event is None:
            continue
        if event not in latest or seconds > latest[event].since[1] + ROUNDING:
            latest[event] = test
        for name, between in test.follows:
            followed[name] = max(followed.get(name, -inf), between + seconds)

    def is_implied(test: Test) -> bool:
        event, seconds = test.since
        if event is None:
            return False
        return latest[event] is not test or followed.get(event, -inf) >= seconds - ROUNDING

    return tuple(test for test in kept if not is_implied(test))


def single(test: Test) -> Flow:
    """Return the flow of one test."""
    return Flow(((test,),))


def chosen(parameter: str, value: str) -> Flow:
    """Return the flow of a parameter of the document that has a value."""
    condition = xml.ParameterCondition(parameterRef=parameter, rule="equalTo", value=value)
    return single(Test(xml.ByValueCondition(condition), latched=True, is_constant=True))


def run_start() -> Test:
    """Return the test for the start of the run.

    It holds from the second step on, when tools know the velocities.
    """
    condition = xml.SimulationTimeCondition(value=0.0, rule="greaterThan")
    return Test(xml.ByValueCondition(condition), latched=True, reached=0.0)


def at_time(seconds: float) -> Test:
    """Return the test for a time since the start of the run; 1.0 has no `greaterOrEqual`."""
    if seconds <= 0.0:
        return run_start()
    condition = xml.SimulationTimeCondition(value=seconds, rule="greaterOrEqual")
    return Test(xml.ByValueCondition(condition), latched=True, reached=seconds)


def state_of(kind: ElementKind, name: str, state: StoryboardElementState = "completeState") -> Test:
    """Return the test for the state of an element; running acts count as latched inside of them."""
    condition = xml.StoryboardElementStateCondition(
        storyboardElementType=kind, storyboardElementRef=name, state=state
    )
    is_moment = (kind, state) in (("event", "completeState"), ("act", "runningState"))
    return Test(xml.ByValueCondition(condition), latched=True, event=name if is_moment else None)
