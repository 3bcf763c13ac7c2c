"""Registry of the XML handlers of actions and modifiers."""

from __future__ import annotations

from collections.abc import Callable

from osc2tx.backends.xosc.actions.leaf import Modify, Perform, PerformGlobal

ACTIONS: dict[str, Perform] = {}
GLOBAL_ACTIONS: dict[str, PerformGlobal] = {}
MODIFIERS: dict[str, Modify] = {}

OF_THE_RUNTIME = frozenset({"vehicle.set_lights"})
"""Actions that the embedded world has and scenarios declare."""


def action(*names: str) -> Callable[[Perform], Perform]:
    """Register a handler for actions of the library."""

    def register(handler: Perform) -> Perform:
        for name in names:
            assert name not in ACTIONS, f"two handlers for action {name}"
            ACTIONS[name] = handler
        return handler

    return register


def modifier(*names: str) -> Callable[[Modify], Modify]:
    """Register a handler for modifiers of the library."""

    def register(handler: Modify) -> Modify:
        for name in names:
            assert name not in MODIFIERS, f"two handlers for modifier {name}"
            MODIFIERS[name] = handler
        return handler

    return register


def global_action(*names: str) -> Callable[[PerformGlobal], PerformGlobal]:
    """Register a handler for actions that concern no entity; they take no time."""

    def register(handler: PerformGlobal) -> PerformGlobal:
        for name in names:
            assert name not in GLOBAL_ACTIONS, f"two handlers for action {name}"
            GLOBAL_ACTIONS[name] = handler
        return handler

    return register
