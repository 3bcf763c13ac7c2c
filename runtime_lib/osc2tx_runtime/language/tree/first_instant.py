"""The actions of the tree at the very start, before a condition is evaluated."""

from __future__ import annotations

from osc2tx_runtime.language.actions.base_action import BaseAction
from osc2tx_runtime.language.tree.base import Behaviour
from osc2tx_runtime.language.tree.compositions import Serial, is_instant


def assigns_at_start(node: Behaviour) -> bool:
    """Return whether a tree may assign the state of an actor at the instant in which it starts."""
    if isinstance(node, BaseAction):
        return _assigns(node)
    for child in node.children:
        if assigns_at_start(child):
            return True
        if isinstance(node, Serial) and not is_instant(child):
            return False
    return False


def _assigns(action: BaseAction) -> bool:
    return action.registered.is_momentary and bool(action.registered.slots)
