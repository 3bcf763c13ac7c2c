"""Events of a storyboard as steps: what happens, what starts it, which of them end others."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Sequence
from dataclasses import field

from osc2tx.importing.conditions import Trigger
from osc2tx.importing.cursor import Node
from osc2tx.importing.effects import Effect
from osc2tx.importing.statements import Statement, composed
from osc2tx_shared.classes import dataclass

STARTS = ("startTransition", "runningState")
ENDS = ("endTransition", "completeState", "stopTransition")


@dataclass(eq=False)
class Step:
    """An event.

    Attributes:
        label: Its name in the scenario.
        effects: What its actions do.
        triggers: What starts the act, then what starts the event.
        act: Number of the act.
        maneuver: Number of the maneuver.
        overrides: Whether it ends the events of its maneuver that are going on.
        node: Where it stands.
        comments: Those of the document in it.
        successors: Events that start at its end.
        before: The execution that is over before it starts, if it is another one.
    """

    label: str
    effects: list[Effect]
    triggers: tuple[Trigger, Trigger]
    act: int
    maneuver: int
    overrides: bool
    node: Node
    comments: list[str] = field(default_factory=list)
    successors: list[Step] = field(default_factory=list)
    before: Sequence[Step] = ()

    @property
    def trigger(self) -> Trigger:
        """The trigger that comes last: of the event, else of the act."""
        return self.triggers[0] if self.triggers[1].is_immediate else self.triggers[1]

    @property
    def slots(self) -> set[tuple[str, str]]:
        """The motions that it controls."""
        return {(each.actor, slot) for each in self.effects for slot in each.slots}

    @property
    def moved(self) -> set[str]:
        """The actors that it moves, and those whose motions it controls."""
        return self.actors | {actor for actor, _ in self.slots}

    @property
    def actors(self) -> set[str]:
        """The actors that it moves."""
        return {each.actor for each in self.effects if each.actor}

    @property
    def statement(self) -> Statement:
        """What happens in it."""
        members = [each.statement for each in self.effects]
        instant = [each for each in members if each.length == 0.0]
        lasting = [each for each in members if each.length != 0.0]
        found = composed(
            "serial", [*instant, *([composed("parallel", lasting)] if lasting else [])]
        )
        found.label = self.label if self.label else found.label
        found.comments = [*self.comments, *found.comments]
        return found


@dataclass(eq=False)
class Block(Step):
    """An act that is stopped, as one event.

    Attributes:
        inner: Its events.
        stop: What stops it.
    """

    inner: list[Step] = field(default_factory=list)
    stop: Trigger = field(default_factory=Trigger)


@dataclass(eq=False)
class Branch:
    """What happens one after the other, from the start of the scenario on.

    Attributes:
        steps: The events in it.
        members: Its statements.
    """

    steps: list[Step] = field(default_factory=list)
    members: list[Statement] = field(default_factory=list)

    @property
    def actors(self) -> set[str]:
        """The actors that it moves."""
        return {actor for step in self.steps for actor in step.actors}

    @property
    def slots(self) -> set[tuple[str, str]]:
        """The motions that it controls."""
        return {slot for step in self.steps for slot in step.slots}


@dataclass
class Board:
    """The storyboard.

    Attributes:
        steps: Its events in their order.
        elements: The events of each element, by its kind and name.
        stops: What stops acts, by their numbers.
        end: What ends it.
    """

    steps: list[Step] = field(default_factory=list)
    elements: dict[tuple[str, str], list[Step]] = field(default_factory=dict)
    stops: dict[int, Trigger] = field(default_factory=dict)
    end: Trigger = field(default_factory=Trigger)


def moment(step: Step) -> Hashable:
    """Return what is the same for steps that start at once, by their last triggers."""
    return step.act, tuple(
        tuple(
            (each.kind, each.text, each.edge, each.element, each.state, each.quantity)
            for each in group
        )
        for group in step.trigger.groups
    )


def replaces_at_once(later: Step, earlier: Step) -> bool:
    """Whether a step takes over the motion from an earlier one without duration, on one trigger."""
    if isinstance(later, Block) or isinstance(earlier, Block) or later.act != earlier.act:
        return False
    if later.before:  # another execution waits for its trigger anew
        return False
    return (
        bool(later.slots & earlier.slots)
        and all(each.statement.length == 0.0 for each in earlier.effects)
        and not later.trigger.is_immediate
        and later.trigger.groups == earlier.trigger.groups
    )


def below(step: Step) -> Iterator[Step]:
    """Yield a step and those that follow it."""
    left = [step]
    while left:
        at = left.pop()
        yield at
        left += reversed(at.successors)


def conflict(one: Step, other: Step) -> bool:
    """Whether steps, or those that follow them, may end each other."""
    return any(_conflict_of(a, b) for a in below(one) for b in below(other))


def _conflict_of(a: Step, b: Step) -> bool:
    return breaks_off(a, b) or breaks_off(b, a)


def breaks_off(later: Step, earlier: Step) -> bool:
    """Whether a step that starts ends one that has started before, if that still runs."""
    if later.slots & earlier.slots:
        return True
    is_beside = later.overrides and later.maneuver == earlier.maneuver
    return is_beside and bool(later.actors & earlier.actors)
