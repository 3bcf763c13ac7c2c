"""Readable names for the nodes of a behavior tree.

A leaf is called what its statement says; a composition by whose it is and what it does. Names
need not be unique: a trace tells nodes apart by their source line.
"""

from __future__ import annotations

from collections.abc import Iterable

from osc2tx import ir
from osc2tx.ir.source_text import condensed, shorten

MAX_WORDS = 3


def invocation_name(actor: str, action: str, details: Iterable[str]) -> str:
    """Return `hero.drive: speed(v_hero)`, the details being arguments and modifiers."""
    text = ", ".join(condensed(detail) for detail in details)
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
        case ir.Emit() | ir.Finish():
            return "emit"
        case ir.Call():
            return "call"
        case ir.Serial() | ir.Parallel() | ir.OneOf() | ir.On():
            return None
