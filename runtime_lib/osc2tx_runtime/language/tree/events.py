"""Events and their occurrences, and how nodes watch them.

Time within an instant is the context's pass counter `tick`: an occurrence is stamped with the pass
in which it becomes visible, a watch with the pass in which it starts, and the watch registers
occurrences with a later stamp. So a wait in parallel to an emit registers it in any order, and a
wait that starts after an emit does not.
"""

from __future__ import annotations

import keyword
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar

from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.tree.conditions import (
    Condition,
    Deadline,
    Edge,
    Level,
    Watch,
    evaluate,
)
from osc2tx_runtime.language.tree.module_text import function_text

if TYPE_CHECKING:
    from py_trees.behaviour import Behaviour

    from osc2tx_runtime.language.context import ExecutionContext


class Event:
    """A declared event.

    One with parameters is a class of its own, which annotates them:

        class Near(Event):
            gap: Length

    In a condition, a reaction or a sample that `self.near` sets off, `self.near.gap` is the value
    of that occurrence. A parameter whose name is a word of Python or of this class has an
    underscore behind it.

    Args:
        trigger: Its specification: another event, a condition or a boolean function. It is watched
            where the event is used, from the start of that use.
        condition: The event occurs only if this is also true at the same instant.
        defaults: Values of parameters, for an `Emit` without them: a value, or a function that is
            called then.
        name: Name in the scenario, if an attribute cannot have it (`from`).

    Attributes:
        parameters: Its parameters as attributes, to their names in the scenario.
        name: Name in trace and settings; the scenario fills in the attribute's name.
        arguments: Of the occurrence that a condition is being asked about.
        alias: The event that it refers to, in an invoked scenario.
    """

    parameters: ClassVar[Mapping[str, str]] = {}

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        own = {attribute: _name_of(attribute) for attribute in cls.__annotations__}
        cls.parameters = {**cls.parameters, **own}

    def __init__(
        self,
        trigger: Trigger | None = None,
        *,
        condition: Guard | None = None,
        defaults: Mapping[str, object] | None = None,
        name: str = "",
    ) -> None:
        self.name = name
        self.trigger = trigger
        self.condition = condition
        self.defaults = defaults or {}
        self.arguments: Mapping[str, Any] = {}
        self.alias: Event | None = None
        self.occurred = 0
        self.occurrences: list[Mapping[str, Any]] = []
        self._instant = (-1, frozenset[str]())  # a step, and its occurrences

    def __repr__(self) -> str:
        return f"Event({self.name!r})"

    if not TYPE_CHECKING:  # so that type checkers still know the attributes

        def __getattr__(self, attribute: str) -> Any:
            if attribute not in self.parameters:
                raise AttributeError(f"event {self.name} has no parameter {attribute}")
            event, name = self.meant(), self.parameters[attribute]
            if name not in event.arguments:
                raise ScenarioError(f"event {event.name} has no value {name} here")
            return event.arguments[name]

    def meant(self) -> Event:
        """Return the event itself, or the one that it refers to."""
        return self if self.alias is None else self.alias.meant()

    def problem(self, given: Iterable[str]) -> str:
        """Return the error in the names of arguments; nothing if there is none."""
        names = list(given)
        unknown = [name for name in names if name not in self.parameters]
        if unknown:
            return f"event {self.name} has no parameter {', '.join(unknown)}"
        known = {*names, *self.defaults}
        missing = [name for each, name in self.parameters.items() if each not in known]
        return f"event {self.name} needs {', '.join(missing)}" if missing else ""

    def complete(self, given: Mapping[str, Any]) -> dict[str, Any]:
        """Return all arguments of an occurrence by name; functions are called now."""
        both = {**self.defaults, **given}
        values = ((name, both[attribute]) for attribute, name in self.parameters.items())
        return {name: value() if callable(value) else value for name, value in values}

    def reset(self) -> None:
        """Forget all occurrences."""
        self.occurred = 0
        self.occurrences = []
        self._instant = (-1, frozenset())

    def occur(self, tick: int, step: int, occurrences: Sequence[Mapping[str, Any]]) -> None:
        """Become visible in pass `tick`.

        Equal occurrences of one instant count once (DSL 7.6.2.5).
        """
        before = self._instant[1] if self._instant[0] == step else frozenset()
        distinct = {argument_key(arguments): arguments for arguments in occurrences}
        new = sorted(distinct.keys() - before)
        if new:
            self._instant = (step, before.union(new))
            self.occurred = tick
            self.occurrences = [distinct[key] for key in new]


_MEMBERS = frozenset(name for name in dir(Event()) if not name.startswith("_"))


def _name_of(attribute: str) -> str:
    """Return the name in the scenario of a parameter that has an attribute."""
    bare = attribute.rstrip("_")
    is_taken = keyword.iskeyword(bare) or bare in _MEMBERS
    return attribute.removesuffix("_") if is_taken else attribute


Trigger = Event | Condition | Callable[[], bool]
"""An event, a condition object, or a boolean function (while true)."""

Guard = Condition | Callable[[], bool]
"""Condition under which an occurrence of an event counts."""


def argument_key(arguments: Mapping[str, Any]) -> str:
    """Return a sort key of occurrences that is the same in all runs."""
    return repr([(name, stable(arguments[name])) for name in sorted(arguments)])


def stable(value: Any) -> Any:
    """Return an actor's id for an actor, and any other value as it is."""
    return getattr(value, "id", value)


def watch(trigger: Trigger, only_if: Guard | None, context: ExecutionContext) -> Watch:
    """Start watching: return a function that returns whether it happened up to the present pass."""
    if isinstance(trigger, Event):
        return watch_event(trigger.meant(), only_if, context)
    happened = trigger.watch(context) if isinstance(trigger, Condition) else None
    if happened is None:
        happened = Level(trigger, context)  # type: ignore[arg-type]
    if only_if is None:
        return happened
    first, second = happened, watch_guard(only_if, context)
    return lambda: all([first(), second()])  # both are evaluated in each step


def watch_guard(guard: Guard, context: ExecutionContext) -> Watch:
    """Start watching a guard; a function is sampled anew in each snapshot."""
    if isinstance(guard, Condition):
        return guard.watch(context)
    return Level(guard, context)


def watch_event(event: Event, only_if: Guard | None, context: ExecutionContext) -> Watch:
    """Watch the occurrences of an event, and its specification if it has one."""
    emitted = Occurrences(event, only_if, context)
    if event.trigger is None:
        return emitted
    specified = watch(event.trigger, event.condition, context)

    def happened() -> bool:
        # Both are evaluated: edges must be sampled in each step, occurrences consumed.
        came, came_true = emitted(), specified()
        if came_true and not came and emitted.is_allowed():
            if event.name:
                context.trace.event(event.name)
            return True
        return came

    return happened


class Occurrences:
    """Watches posted events: from emit, a label, or outside. Each occurrence counts once.

    Attributes:
        matching: Arguments of the occurrences when it was last true, in canonical order.
    """

    __slots__ = ("_context", "_function", "_holds", "_seen", "event", "matching")

    def __init__(self, event: Event, only_if: Guard | None, context: ExecutionContext) -> None:
        self.event = event
        self.matching: list[Mapping[str, Any]] = []
        self._holds: Watch | None = None
        self._function: Callable[[], bool] | None = None
        if isinstance(only_if, Condition):
            self._holds = only_if.watch(context)
        else:
            self._function = only_if
        self._context = context
        self._seen = context.tick

    @property
    def needs_no_evaluation(self) -> bool:
        """Whether no evaluation is needed until an event occurs."""
        return self._holds is None

    def is_allowed(self) -> bool:
        """Return whether the guard is true now, for the arguments that the event has."""
        if self._holds is not None:
            return self._holds()
        return self._function is None or evaluate(self._function)

    def __call__(self) -> bool:
        """Return whether the event occurred since the last call."""
        event = self.event
        if self._holds is not None:
            self._holds()  # sampled in each pass, so that an edge is a change since the step before
        if event.occurred <= self._seen:
            return False
        self._seen = event.occurred
        if self._holds is None and self._function is None:
            self.matching = event.occurrences
            return True
        self.matching = []
        if event.occurred != self._context.tick:
            return False
        for arguments in event.occurrences:
            event.arguments = arguments
            if self.is_allowed():
                self.matching.append(arguments)
        return bool(self.matching)


def rest_until(node: Behaviour, watches: Sequence[Watch], context: ExecutionContext) -> None:
    """Let a node rest until one of its watches may become true, if that can be known."""
    resting = context.resting
    asked = []
    for each in watches:
        if isinstance(each, Edge | Level):
            asked.append(each)
        elif isinstance(each, Deadline):
            resting.until(node, each.step)
        elif not (isinstance(each, Occurrences) and each.needs_no_evaluation):
            return
    if asked:
        resting.unless(node, asked)
    resting.nodes.add(node)


def describe(trigger: Trigger, condition: Guard | None = None) -> str:
    """Return a short description of a trigger and its condition."""
    if condition is not None:
        return f"{describe(trigger)} if {describe(condition)}"
    if isinstance(trigger, Event):
        trigger = trigger.meant()
        if trigger.name or trigger.trigger is None:
            return f"@{trigger.name or 'event'}"
        return describe(trigger.trigger, trigger.condition)
    return trigger.text if isinstance(trigger, Condition) else function_text(trigger)
