"""Names of nodes that the module states: each is the name of one node of its scenario.

Numbers are the last resort. They go down the text, in whatever order members stand.
"""

from __future__ import annotations

import itertools

from osc2tx import ir
from osc2tx.backends.py_trees.naming import identifier
from osc2tx_classes import dataclass


@dataclass(frozen=True, slots=True)
class InvocationName:
    """How an invocation of a scenario is called.

    Attributes:
        label: Its label; a number makes one for an invocation that is written like one before it.
        known_as: Its name in settings, if that is neither its label nor that of the scenario.
    """

    label: str | None
    known_as: str | None = None


def composition_names(body: ir.Behavior) -> dict[ir.Behavior, str]:
    """Name the compositions of a scenario: label, else what it does."""
    nodes = _down_the_text(body)
    taken = _labels(nodes)
    names: dict[ir.Behavior, str] = {}
    for node in nodes:
        if isinstance(node, ir.Serial | ir.Parallel | ir.OneOf):
            names[node] = node.label or _numbered(node.name, " ", taken)
            taken.add(names[node])
    return names


def invocation_names(body: ir.Behavior) -> dict[ir.Behavior, InvocationName]:
    """Name the invocations of other scenarios: label, else scenario."""
    nodes = [node for node in _down_the_text(body) if isinstance(node, ir.InvokeScenario)]
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


def method_name(name: str) -> str:
    """Return the name of the method for a phase."""
    return identifier(name.replace(": ", "_").replace(" ", "_"))


def _acting(node: ir.InvokeScenario) -> tuple[str, ...]:
    """Return how an invocation is written, values left out: draws depend on that."""
    who = "" if node.actor is None else ir.show(node.actor)
    arguments = (
        f"{a.parameter}: {ir.show(a.value)}" if a.value.type.kind is ir.Kind.ACTOR else a.parameter
        for a in node.arguments
    )
    return (node.key, who, *arguments)


def _down_the_text(body: ir.Behavior) -> list[ir.Behavior]:
    return sorted(ir.walk_behaviors(body), key=lambda node: node.span.start)


def _labels(nodes: list[ir.Behavior] | list[ir.InvokeScenario]) -> set[str]:
    return {node.label for node in nodes if node.label is not None}


def _numbered(name: str, joint: str, taken: set[str]) -> str:
    candidates = (name if n == 1 else f"{name}{joint}{n}" for n in itertools.count(1))
    return next(each for each in candidates if each not in taken)
