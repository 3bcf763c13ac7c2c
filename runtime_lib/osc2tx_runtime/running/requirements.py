"""The requirements of a scenario on its world, checked before step 0."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from osc2tx_runtime.errors import CapabilityError
from osc2tx_runtime.language.actions.action import Action
from osc2tx_runtime.language.actions.base_action import BaseAction
from osc2tx_runtime.language.context import ExecutionContext
from osc2tx_runtime.world.protocol import EXTERNAL

if TYPE_CHECKING:
    from osc2tx_runtime.language.tree.base import Behaviour


def check_requirements(root: Behaviour, context: ExecutionContext) -> None:
    """Compare the actions of a tree that is set up with the capabilities of the world.

    Raises:
        CapabilityError: With all that cannot be, and where.
    """
    actions = [node for node in root.iterate() if isinstance(node, BaseAction)]
    problems = {
        (action.source, problem): None
        for action in sorted(actions, key=lambda action: action.position)
        for problem in problems_of(action, context)
    }
    if problems:
        told = "; ".join(f"{where}: {what}" if where else what for where, what in problems)
        raise CapabilityError(f"the world {context.world.name} cannot run this scenario: {told}")


def problems_of(action: BaseAction, context: ExecutionContext) -> Iterator[str]:
    """Yield why the world of a run does not carry out an action."""
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
        yield f"{action.action_name}: {action.actor.id} is driven from outside"
    elif not context.settings.expect:
        yield (
            f"{action.action_name}: {action.actor.id} is driven from outside; with --expect the"
            " action is expected of it"
        )
