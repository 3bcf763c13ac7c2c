"""The starts of the actors of a scenario that is invoked during a run."""

from __future__ import annotations

from collections.abc import Mapping

from osc2tx.ir.behaviors import Behavior, Composition, Invoke, ModifierCall
from osc2tx.ir.nodes import Placement, Scenario
from osc2tx.ir.trees import first_actions
from osc2tx_shared.classes import replace


def starts_at_actions(scenario: Scenario) -> Scenario:
    """Return a scenario whose first actions state the starts of their actors.

    As in a run, a placement of a scenario that is invoked later is a condition on the start of an
    action. One that holds throughout the action states already; one without an action stays.
    """
    first = {each.actor_name: each for each in reversed(first_actions(scenario.body))}
    stated: dict[int, tuple[ModifierCall, ...]] = {}
    kept: list[Placement] = []
    for placement in scenario.placements:
        action = first.get(placement.actor)
        if placement.is_throughout and not placement.of_map:
            continue
        if placement.of_map or placement.is_implied or action is None:
            kept.append(placement)
        else:
            starts = tuple(replace(call, at="start") for call in placement.modifiers)
            stated[id(action)] = (*stated.get(id(action), ()), *starts)
    if len(kept) == len(scenario.placements):
        return scenario
    return replace(scenario, placements=tuple(kept), body=_with(scenario.body, stated))


def _with(node: Behavior, stated: Mapping[int, tuple[ModifierCall, ...]]) -> Behavior:
    if isinstance(node, Invoke) and id(node) in stated:
        return replace(node, modifiers=(*stated[id(node)], *node.modifiers))
    if isinstance(node, Composition):
        return replace(node, members=tuple(_with(member, stated) for member in node.members))
    return node
