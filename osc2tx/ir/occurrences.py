"""Events in a tree: who emits them, who waits for them, and which waits begin before them."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator
from typing import Literal, TypeAlias

from osc2tx.ir.behaviors import (
    Behavior,
    Call,
    Emit,
    EventRef,
    Finish,
    InnerEvent,
    LabelEvent,
    Level,
    Moment,
    On,
    OneOf,
    Parallel,
    Serial,
    Trigger,
    Wait,
)
from osc2tx.ir.declarations import Event
from osc2tx.ir.endings import is_instant
from osc2tx.ir.nodes import Scenario
from osc2tx.ir.verify import walk_behaviors

Path: TypeAlias = tuple[tuple[Behavior, int], ...]
"""Compositions from the outside to a member, with the index of the next one in it."""

Occurring: TypeAlias = tuple[Literal["event", "label"], str]
"""What occurs: an event, or the start or end of a member, by name."""


def early_triggers(body: Behavior) -> frozenset[int]:
    """Return the ids of the triggers that begin before what they wait for."""
    places = dict(_paths(body, ()))
    nodes = walk_behaviors(body)
    sites: dict[Occurring | None, list[Path]] = defaultdict(list)
    for node in nodes:
        for occurring in dict.fromkeys(_occurring(node)):
            sites[occurring].append(places[id(node)])
    found = set()
    for node in nodes:
        for trigger in triggers_of(node):
            # What no member makes comes from outside: at any time from the start on.
            made = sites.get(_awaited(trigger.event)) or [()]
            if all(_is_before(places[id(node)], site) for site in made):
                found.add(id(trigger))
    return frozenset(found)


def triggers_of(node: Behavior) -> tuple[Trigger, ...]:
    """Return the triggers that a member itself looks at."""
    match node:
        case Wait(trigger=trigger) | On(trigger=trigger):
            return (trigger,)
        case Emit() | Call() | Finish():
            return ()
        case _:
            return node.until


def _awaited(event: EventRef | LabelEvent | InnerEvent | None) -> Occurring | None:
    """Return the event, or the label, that a trigger waits for."""
    match event:
        case EventRef(name=name):
            return "event", name
        case LabelEvent(label=label) | InnerEvent(label=label):
            return "label", label
    return None


def emitted_by(node: Behavior) -> list[str]:
    """Return the events that a member emits itself."""
    emissions = node.reactions if isinstance(node, On) else (node,)
    return [each.event.name for each in emissions if isinstance(each, Emit)]


def _occurring(site: Behavior) -> Iterator[Occurring]:
    """Yield the events that a member emits, and its label."""
    if site.label is not None:
        yield "label", site.label
    yield from (("event", name) for name in emitted_by(site))


def _paths(node: Behavior, path: Path) -> Iterator[tuple[int, Path]]:
    yield id(node), path
    if isinstance(node, Serial | Parallel | OneOf):
        for index, member in enumerate(node.members):
            yield from _paths(member, (*path, (node, index)))


def _is_before(watcher: Path, site: Path) -> bool:
    """Whether a member begins with the innermost composition that also holds the other one."""
    shared = 0
    for (a, i), (b, j) in zip(watcher, site, strict=False):
        if a is not b or i != j:
            break
        shared += 1
    return all(_begins_at_once(node, index) for node, index in watcher[shared:])


def _begins_at_once(node: Behavior, index: int) -> bool:
    """Whether a member of a composition, by its index, begins when the composition does."""
    match node:
        case Serial(members=members):
            return all(is_instant(member) for member in members[:index])
        case Parallel():
            return index == 0 or (node.start_to_start is None and node.overlap in (None, "start"))
        case _:
            return True


WAITABLE = (Moment.START, Moment.END)
"""Life-cycle events that behaviors wait for; the others are failures."""


class Occurrences:
    """The events of one scenario: who makes them occur, and whether they may occur again.

    Attributes:
        declared: Those that it declares, by name.
        emitted: How many members emit an event.
        reacting: The members that react with an event, by its name.
    """

    def __init__(self, scenario: Scenario) -> None:
        """Look through the members."""
        self.declared = {d.name: d for d in scenario.declarations if isinstance(d, Event)}
        self._scenario = scenario
        nodes = walk_behaviors(scenario.body)
        self.emitted = Counter(name for node in nodes for name in emitted_by(node))
        self.reacting: dict[str, list[On]] = {}
        for node in nodes:
            if isinstance(node, On):
                for name in dict.fromkeys(emitted_by(node)):
                    self.reacting.setdefault(name, []).append(node)

    def waited(self) -> Iterator[tuple[str, Moment]]:
        """Yield the labels whose start or end is waited for."""
        for node in walk_behaviors(self._scenario.body):
            for trigger in triggers_of(node):
                if isinstance(trigger.event, LabelEvent) and trigger.event.moment in WAITABLE:
                    yield trigger.event.label, trigger.event.moment
        for override in self._scenario.overrides:
            yield override.by, Moment.START
            if override.mode == "when_active":
                yield override.by, Moment.END

    def recurring(self) -> Iterator[str]:
        """Yield the events that may occur again."""
        yield from (name for name, count in self.emitted.items() if count > 1)
        for node in walk_behaviors(self._scenario.body):
            if isinstance(node, On) and self.may_recur(node.trigger):
                yield from emitted_by(node)

    def may_recur(self, trigger: Trigger, seen: frozenset[str] = frozenset()) -> bool:
        """Whether a trigger may occur more than once; what comes from outside is set once."""
        event = trigger.event
        if event is None:
            return True
        if not isinstance(event, EventRef) or event.name in seen:
            return False
        seen = seen | {event.name}
        declared = self.declared.get(event.name)
        if declared is not None and declared.trigger is not None:
            return self.may_recur(declared.trigger, seen)
        return self.is_emitted_often(event.name) or any(
            self.may_recur(node.trigger, seen) for node in self.reacting.get(event.name, ())
        )

    def is_emitted_often(self, name: str) -> bool:
        """Whether there are several places that emit an event."""
        return self.emitted[name] > 1

    def lasts(self, name: str, seen: frozenset[str] = frozenset()) -> bool:
        """Whether an event occurs at each instant at which some condition holds."""
        return name not in seen and any(
            self._is_level(node.trigger, seen | {name}) for node in self.reacting.get(name, ())
        )

    def _is_level(self, trigger: Trigger, seen: frozenset[str]) -> bool:
        if trigger.event is None:
            return isinstance(trigger.condition, Level)
        if not isinstance(trigger.event, EventRef):
            return False
        declared = self.declared[trigger.event.name].trigger
        if declared is not None:
            return self._is_level(declared, seen)
        return self.lasts(trigger.event.name, seen)
