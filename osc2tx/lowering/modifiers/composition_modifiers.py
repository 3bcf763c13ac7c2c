"""Modifiers of compositions and scenarios that hold at the start or the end alone (§7.3.12.1.2).

A composition is treated like a scenario that consists of it: what holds at its start holds when its
first action of the actor starts, what holds at its end when the last one ends.
"""

from __future__ import annotations

from typing import TypeVar

from osc2tx import ir
from osc2tx_shared.classes import replace

_KEPT = {"speed": {"speed"}, "lane": {"lane"}}
"""Modifiers, with the parameters that relate to nothing else."""

CompositionT = TypeVar("CompositionT", ir.Serial, ir.Parallel, ir.OneOf)


def with_edge(node: ir.Behavior, call: ir.ModifierCall, actor: str) -> ir.Behavior | None:
    """Return a member with a modifier on the actions that start or end with it.

    Args:
        node: The member.
        call: The modifier, `at: start` or `at: end`.
        actor: The actor whose actions are meant.

    Returns:
        None if none of its actions surely starts, or ends, with it.
    """
    match node:
        case ir.Invoke() if node.actor_name == actor and not ir.is_instant(node):
            return replace(node, modifiers=(*node.modifiers, replace(call, comments=())))
        case ir.Serial(members=members):
            lasting = [i for i, each in enumerate(members) if not ir.is_instant(each)]
            if call.at == "end" and _is_kept(call):
                lasting = [i for i in lasting if _acts(members[i], actor)]
            return _changed(node, lasting[:1] if call.at == "start" else lasting[-1:], call, actor)
        case ir.Parallel(members=members) if ir.starts_together(node):
            acting = [i for i, each in enumerate(members) if with_edge(each, call, actor)]
            return _changed(node, acting[:1], call, actor)
        case ir.OneOf(members=members):
            return _changed(node, list(range(len(members))), call, actor)
    return None


def _is_kept(call: ir.ModifierCall) -> bool:
    """Whether an actor keeps what a modifier states while no action controls it."""
    given = {argument.parameter for argument in call.arguments}
    return call.name in _KEPT and given <= _KEPT[call.name]


def _acts(node: ir.Behavior, actor: str) -> bool:
    """Whether a member may move an actor."""
    parts = tuple(ir.walk_behaviors(node))
    return any(isinstance(each, ir.InvokeScenario) for each in parts) or any(
        isinstance(each, ir.Invoke) and each.actor_name == actor for each in parts
    )


def _changed(
    node: CompositionT, indices: list[int], call: ir.ModifierCall, actor: str
) -> CompositionT | None:
    members = list(node.members)
    for index in indices:
        changed = with_edge(members[index], call, actor)
        if changed is None:
            return None
        members[index] = changed
    return replace(node, members=tuple(members)) if indices else None
