"""Readable names for the nodes of a behavior tree.

A leaf is called what its statement says; a composition by whose it is and what it does. Names
need not be unique: a trace tells nodes apart by their source line.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from osc2tx import ir
from osc2tx.diagnostics import Span

MAX_LENGTH = 90
MAX_WORDS = 3


def statement_name(span: Span) -> str:
    """Return the text of a statement on one line."""
    return shorten(condensed(span))


def condensed(span: Span) -> str:
    """Return the text of a span with its white space reduced to single blanks."""
    return re.sub(r"\s+", " ", span.text)


def invocation_name(actor: str, action: str, details: Iterable[str]) -> str:
    """Return `hero.drive: speed(v_hero)`, the details being arguments and modifiers."""
    text = ", ".join(re.sub(r"\s+", " ", detail) for detail in details)
    return shorten(f"{actor}.{action}: {text}" if text else f"{actor}.{action}")


def composition_name(word: str, members: tuple[ir.Behavior, ...], *, is_phase: bool) -> str:
    """Return a name such as `hero: drive or wait`, else `hero: serial`, else `serial`.

    A phase keeps to the shorter form: its name is also that of a method, which should not
    change with each of its members.
    """
    actors = {actor for member in members for actor in _actors(member)}
    owner = f"{next(iter(actors))}: " if len(actors) == 1 else ""
    verbs = tuple(dict.fromkeys(_verb(member) for member in members))
    if is_phase or len(members) > MAX_WORDS or any(verb is None for verb in verbs):
        return f"{owner}{word}"
    joint = {"one_of": " or ", "parallel": " with "}.get(word, ", ")
    return f"{owner}{joint.join(verb for verb in verbs if verb)}"


def shorten(text: str) -> str:
    """Cut a name that would be too long for a tree or a timeline."""
    return text if len(text) <= MAX_LENGTH else f"{text[: MAX_LENGTH - 1]}…"


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


def _verb(node: ir.Behavior) -> str | None:
    match node:
        case ir.Invoke(action=action):
            return action
        case ir.InvokeScenario(scenario=scenario):
            return scenario.rpartition(".")[2]
        case ir.Wait():
            return "wait"
        case ir.Emit():
            return "emit"
        case ir.Serial() | ir.Parallel() | ir.OneOf() | ir.On():
            return None
