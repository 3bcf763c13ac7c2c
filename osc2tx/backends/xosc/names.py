"""Names of elements, close to the source.

Events, acts and marks are called after labels, else after what a member does. No name counts
members, so that one more of them renames no other; only what says the very same is told apart by
numbers.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from functools import lru_cache

from osc2tx import ir

Deed = tuple[str, str]
"""An action and its actor, as written."""


def member_name(scenario: ir.Scenario, node: ir.Behavior) -> str:
    """Return what a member of a scenario is called; its body has no name but its kind."""
    if node.label is not None:
        return node.label
    return type(node).__name__.lower() if node is scenario.body else node.name


@lru_cache(maxsize=64)  # documents for many values are made of one scenario
def deeds(scenario: ir.Scenario) -> Mapping[Deed, int]:
    """Return how often the members of a scenario without a label do the same."""
    return Counter(_deed(n) for n in ir.invocations(scenario.body) if n.label is None)


def event_name(done: Mapping[Deed, int], node: ir.Invoke, actor: str | None = None) -> str:
    """Return what the event of an action is called; `done` are the deeds of its scenario.

    The action alone will do where it is done once; else its arguments and modifiers follow.
    """
    if node.label is not None:
        return node.label
    details = [] if done[_deed(node)] == 1 else [*_values(node.arguments), *_modifiers(node)]
    return "_".join(([] if actor is None else [actor]) + [node.action, *details])


def _deed(node: ir.Invoke) -> Deed:
    return node.action, "" if node.actor is None else node.actor.span.text


def _values(arguments: tuple[ir.Argument, ...]) -> list[str]:
    return [argument.value.span.text.strip('"') for argument in arguments]


def _modifiers(node: ir.Invoke) -> list[str]:
    return [word for call in node.modifiers for word in (call.name, *_values(call.arguments))]
