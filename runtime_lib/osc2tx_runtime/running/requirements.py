"""The requirements of a scenario on its world, checked before step 0."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from osc2tx_runtime.errors import CapabilityError
from osc2tx_runtime.language.actions.action import Action
from osc2tx_runtime.language.actions.base_action import BaseAction
from osc2tx_runtime.language.context import ExecutionContext
from osc2tx_runtime.language.tree.compositions import Serial
from osc2tx_runtime.language.tree.directives import Until
from osc2tx_runtime.language.tree.ending import Ending
from osc2tx_runtime.language.tree.members import length_of
from osc2tx_runtime.language.tree.parallel import Parallel
from osc2tx_runtime.world.protocol import EXTERNAL

if TYPE_CHECKING:
    from osc2tx_runtime.language.tree.base import Behaviour

STARTS = frozenset({"assign_orientation", "assign_position", "assign_speed"})
"""Actions that state the start of an actor, if they come first."""


def check_requirements(root: Behaviour, context: ExecutionContext) -> None:
    """Compare the actions of a tree, after its setup, with the capabilities of the world.

    Raises:
        CapabilityError: All unsupported requests, with their positions.
    """
    actions = [node for node in root.iterate() if isinstance(node, BaseAction)]
    first = set(at_start(root))
    problems = {
        (action.source, problem): None
        for action in sorted(actions, key=lambda action: action.position)
        for problem in problems_of(action, context, is_start=action in first)
    }
    if problems:
        told = "; ".join(f"{where}: {what}" if where else what for where, what in problems)
        raise CapabilityError(f"the world {context.world.name} cannot run this scenario: {told}")


def at_start(node: Behaviour) -> Iterator[Behaviour]:
    """Yield the leaves that certainly start at the first instant.

    Unlike in `started_at_once`, an assignment counts as instantaneous, although it waits for its
    effect.
    """
    match node:
        case Serial():
            for child in node.children:
                yield from at_start(child)
                if length_of(child) != 0:
                    return
        case Parallel() | Until() | Ending():
            for child in node.children:
                yield from at_start(child)
        case _:
            yield node


def problems_of(
    action: BaseAction, context: ExecutionContext, *, is_start: bool = False
) -> Iterator[str]:
    """Yield why the world of a run cannot execute an action.

    Args:
        action: The action.
        context: The run.
        is_start: Whether it starts at the first instant.
    """
    needed = {need: action.action_name for need in action.registered.needs}
    if isinstance(action, Action):
        for modifier in action.modifiers:
            for need in modifier.facts.needs:
                needed.setdefault(need, f"{action.action_name} with {modifier.name}")
    able = context.world.capabilities()
    for need in sorted(needed):
        if need not in able:
            yield f"{needed[need]} needs {need.replace('_', ' ')}, which it does not have"
    if not isinstance(action, Action) or action.actor.id not in context.cast():
        return
    if context.world.control(action.actor.id) not in EXTERNAL:
        return
    if not action.slots:
        return
    if action.registered.is_momentary:
        if is_start and action.registered.name in STARTS and "driver_starts" in able:
            return
        yield f"{action.action_name}: {action.actor.id} is under external control"
    elif not context.settings.expect:
        yield (
            f"{action.action_name}: {action.actor.id} is under external control; with --expect the"
            " action is expected of it"
        )
