"""Python names for the names of a scenario: stable, unique, never a keyword."""

from __future__ import annotations

import itertools
import keyword
import unicodedata
from collections.abc import Iterable
from pathlib import PurePosixPath

from osc2tx import ir
from osc2tx.backends.py_trees.code import PyName
from osc2tx.support.paths import is_portable
from osc2tx.support.python_modules import is_taken
from osc2tx_shared.classes import dataclass

# Names that `Scenario` of the runtime library uses; a test compares with the class.
SCENARIO_ATTRIBUTES = frozenset(
    {
        "actors",
        "argument",
        "arguments",
        "behavior",
        "cast",
        "completed",
        "cover",
        "create_tree",
        "declare",
        "ended",
        "event",
        "events",
        "external",
        "failed",
        "first_come",
        "fix_to",
        "global_object",
        "global_parameter",
        "has_drawn_values",
        "implied_starts",
        "is_abstract",
        "is_main",
        "invoke",
        "invoked",
        "keep",
        "label_events",
        "map_file",
        "map_objects",
        "name",
        "narrow_to",
        "one_of",
        "override",
        "parameter",
        "parameter_units",
        "parameters",
        "place",
        "placement",
        "placements",
        "record",
        "require",
        "required",
        "required_argument",
        "required_global",
        "sample",
        "settings",
        "short_name",
        "source",
        "started",
        "when",
    }
)


# Names that `Event` of the runtime library uses; a test compares with the class.
EVENT_ATTRIBUTES = frozenset(
    {
        "alias",
        "arguments",
        "complete",
        "condition",
        "defaults",
        "meant",
        "name",
        "occur",
        "occurred",
        "occurrences",
        "parameters",
        "problem",
        "reset",
        "trigger",
    }
)


def identifier(text: str) -> str:
    """Return the closest Python identifier to a name of the language.

    Python folds identifiers by NFKC, so that is done here already; quoted names may hold any
    character; a leading underscore would make the name private to the base class.
    """
    folded = unicodedata.normalize("NFKC", text)
    cleaned = "".join(char if f"x{char}".isidentifier() else "_" for char in folded)
    if cleaned.startswith("_") or not cleaned:
        cleaned = f"x{cleaned}"
    if not cleaned.isidentifier():
        cleaned = f"x_{cleaned}"
    return f"{cleaned}_" if keyword.iskeyword(cleaned) else cleaned


def module_name(source: str) -> str:
    """Return the module name for a source file: importable, as close to its name as can be.

    It is a possible file name on every system, and no other module is hidden by it.
    """
    name = identifier(PurePosixPath(source).stem)
    return f"{name}_" if is_taken(name) or not is_portable(name) else name


def class_name(text: str) -> str:
    """Return a name of the language in the form of a Python class name."""
    words = [word for word in identifier(text).split("_") if word]
    camel = "".join(word[0].upper() + word[1:] for word in words)
    return camel if camel.isidentifier() and not keyword.iskeyword(camel) else f"X{camel}"


def event_parameter(text: str) -> PyName:
    """Return the attribute of an event for a parameter of it."""
    name = identifier(text)
    return PyName(f"{name}_" if text.rstrip("_") in EVENT_ATTRIBUTES else name)


class NameTable:
    """Hands out Python names that differ from each other and from reserved names.

    Attributes:
        looked_up: Keys whose names were requested.
    """

    def __init__(self, reserved: Iterable[str] = ()) -> None:
        """Start with the reserved names taken."""
        self._taken = set(reserved)
        self._names: dict[str, PyName] = {}
        self.looked_up: set[str] = set()

    def add(self, key: str, wanted: str, fallback_suffix: str = "_") -> PyName:
        """Reserve a name for `key`, as close to `wanted` as is free: with suffix or number."""
        candidate = wanted
        if candidate in self._taken:
            candidate = f"{wanted}{fallback_suffix}"
        base, number = candidate, 2
        while candidate in self._taken:
            candidate = f"{base}_{number}" if not base.endswith("_") else f"{base}{number}"
            number += 1
        self._taken.add(candidate)
        self._names[key] = PyName(candidate)
        return self._names[key]

    def copy(self) -> NameTable:
        """Return a table with the same names, which may be given more."""
        table = NameTable(self._taken)
        table._names = dict(self._names)
        return table

    def __getitem__(self, key: str) -> PyName:
        """Return the name reserved for `key`."""
        self.looked_up.add(key)
        return self._names[key]

    def __contains__(self, key: str) -> bool:
        """Return whether a name is reserved for `key`."""
        return key in self._names


@dataclass(frozen=True, slots=True)
class InvocationName:
    """How an invocation of a scenario is called.

    Attributes:
        label: Its label; a number makes one for an invocation that is written like one before it.
        known_as: Its name in settings, if that is neither its label nor the name of the scenario.
    """

    label: str | None
    known_as: str | None = None


def composition_names(body: ir.Behavior) -> dict[ir.Behavior, str]:
    """Name the compositions of a scenario: label, else a description."""
    nodes = _in_text_order(body)
    taken = _labels(nodes)
    names: dict[ir.Behavior, str] = {}
    for node in nodes:
        if isinstance(node, ir.Serial | ir.Parallel | ir.OneOf):
            names[node] = node.label or _numbered(node.name, " ", taken)
            taken.add(names[node])
    return names


def invocation_names(body: ir.Behavior) -> dict[ir.Behavior, InvocationName]:
    """Name the invocations of other scenarios: label, else scenario."""
    nodes = [node for node in _in_text_order(body) if isinstance(node, ir.InvokeScenario)]
    taken = _labels(nodes)
    names: dict[ir.Behavior, InvocationName] = {}
    written: set[tuple[str, ...]] = set()
    for node in nodes:
        short = node.scenario.rpartition(".")[2]
        name = node.label or _numbered(short, "_", taken)
        if name in (node.label, short):
            names[node] = InvocationName(node.label)
        elif _acting(node) in written:
            names[node] = InvocationName(name)
        else:
            names[node] = InvocationName(None, known_as=name)
        taken.add(name)
        written.add(_acting(node))
    return names


def method_name(node: ir.Composition) -> str:
    """Return the name of the method for a phase.

    A labelled one is public, so that a subclass can override it. One without label is private and
    named after its content: `_hero_and_npc`, `_hero_drive_then_change_lane`.
    """
    if node.label is not None:
        return identifier(node.label)
    actor = _actor_of(node)
    topics = list(dict.fromkeys(_topics(node, actor)))
    kind, joint = _WORDS[type(node)]
    words = f"_{joint}_".join(topics[:MAX_TOPICS]) if len(topics) > 1 else f"{topics[0]}_{kind}"
    is_said = actor is None or words.startswith(f"{actor}_")
    return f"_{identifier(words if is_said else f'{actor}_{words}')}"


MAX_TOPICS = 2  # that the name of a method lists
_WORDS = {
    ir.Serial: ("serial", "then"),
    ir.Parallel: ("parallel", "and"),
    ir.OneOf: ("one_of", "or"),
}


def _actor_of(node: ir.Behavior) -> str | None:
    """Name the one actor of all actions in a part of the tree; `None` if there are others."""
    inside = [each for each in ir.walk_behaviors(node) if isinstance(each, ir.Invoke)]
    actors = {e.actor.name if isinstance(e.actor, ir.FieldRef) else "" for e in inside}
    return next(iter(actors)) or None if len(actors) == 1 else None


def _topics(node: ir.Composition, actor: str | None) -> list[str]:
    """Name the topics of the members of a composition; events only if there is nothing else."""
    telling = [each for each in node.members if not isinstance(each, ir.Wait | ir.Emit | ir.On)]
    return [_topic(each, actor) for each in telling or node.members]


def _topic(node: ir.Behavior, actor: str | None) -> str:
    if node.label is not None:
        return node.label
    match node:
        case ir.Serial() | ir.Parallel() | ir.OneOf():
            own = _actor_of(node)
            return own if own and own != actor else _topics(node, own)[0]
        case ir.Invoke(actor=ir.FieldRef(name=name)) if name != actor:
            return name
        case ir.Invoke(action=action):
            return action
        case ir.InvokeScenario(scenario=scenario):
            return scenario.rpartition(".")[2]
        case ir.Emit(event=event):
            return f"emit_{event.name}"
        case _:
            return type(node).__name__.lower()


def _acting(node: ir.InvokeScenario) -> tuple[str, ...]:
    """Return the text of an invocation, values left out: draws depend on that."""
    who = "" if node.actor is None else ir.show(node.actor)
    arguments = (
        f"{a.parameter}: {ir.show(a.value)}" if a.value.type.kind is ir.Kind.ACTOR else a.parameter
        for a in node.arguments
    )
    return (node.key, who, *arguments)


def _in_text_order(body: ir.Behavior) -> list[ir.Behavior]:
    return sorted(ir.walk_behaviors(body), key=lambda node: node.span.start)


def _labels(nodes: list[ir.Behavior] | list[ir.InvokeScenario]) -> set[str]:
    return {node.label for node in nodes if node.label is not None}


def _numbered(name: str, joint: str, taken: set[str]) -> str:
    candidates = (name if n == 1 else f"{name}{joint}{n}" for n in itertools.count(1))
    return next(each for each in candidates if each not in taken)
