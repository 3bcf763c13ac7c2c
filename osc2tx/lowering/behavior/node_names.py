"""Readable names for the nodes of a behavior tree.

A leaf is named after its statement; a composition after its actor and its activity. Names need not
be unique: the back ends see to that.
"""

from __future__ import annotations

from collections.abc import Iterable

from osc2tx import ir
from osc2tx.ir.source_text import condensed, shorten

MAX_VERBS = 3


def invocation_name(actor: str | None, action: str, details: Iterable[str]) -> str:
    """Return `hero.drive: speed(v_hero)`, the details being arguments and modifiers."""
    text = ", ".join(condensed(detail) for detail in details)
    name = ir.qualified(actor, action)
    return shorten(f"{name}: {text}" if text else name)


def composition_name(word: str, members: tuple[ir.Behavior, ...], *, is_phase: bool) -> str:
    """Return a name such as `hero: drive or wait crash_avoided`; of a phase `hero: one_of`.

    The name of a phase is also that of a method, which should not change with its members.
    """
    actors = {actor for member in members for actor in _actors(member)}
    owner = f"{next(iter(actors))}: " if len(actors) == 1 else ""
    if is_phase:
        return f"{owner}{word}"
    verbs = list(dict.fromkeys(_verb(member) for member in members))
    joint = {"one_of": " or ", "parallel": " with "}.get(word, ", ")
    more = "…" if len(verbs) > MAX_VERBS else ""
    return f"{owner}{joint.join(verbs[:MAX_VERBS])}{more}"


def _actors(node: ir.Behavior) -> Iterable[str]:
    match node:
        case ir.Serial() | ir.Parallel() | ir.OneOf():
            for member in node.members:
                yield from _actors(member)
        case ir.Invoke(actor=ir.FieldRef(name=name)) | ir.InvokeScenario(
            actor=ir.FieldRef(name=name)
        ):
            yield name
        case _:
            return


def _verb(node: ir.Behavior) -> str:
    match node:
        case ir.Invoke(action=action):
            return action
        case ir.InvokeScenario(scenario=scenario):
            return scenario.rpartition(".")[2]
        case ir.Wait(trigger=trigger):
            return f"wait {_occasion(trigger)}".rstrip()
        case ir.On(trigger=trigger):
            return f"on {_occasion(trigger)}".rstrip()
        case ir.Emit(event=event):
            return f"emit {event.name}"
        case ir.Finish(succeeds=succeeds):
            return f"emit {'end' if succeeds else 'fail'}"
        case ir.Call():
            return "call"
        case ir.Serial() | ir.Parallel() | ir.OneOf():
            return node.label or _verb(node.members[0])


def _occasion(trigger: ir.Trigger) -> str:
    """Return the awaited event in a word, or the quantity of a condition."""
    match trigger.event:
        case ir.EventRef(name=name):
            return name
        case ir.LabelEvent(label=label) | ir.InnerEvent(label=label):
            return label
        case None:
            if not isinstance(trigger.condition, ir.Level | ir.Edge):
                return ""
            return _subject(trigger.condition.expression)


def _subject(condition: ir.Expression) -> str:
    """Return `hero speed`: the first member that a condition reads, and its owner."""
    for part in ir.walk(condition):
        match part:
            case ir.Attribute(base=base, name=name) | ir.MethodCall(base=base, method=name):
                fields = [each.name for each in ir.walk(base) if isinstance(each, ir.FieldRef)]
                return " ".join((*fields[:1], name))
    return ""
