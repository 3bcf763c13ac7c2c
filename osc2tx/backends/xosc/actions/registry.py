"""Registry of the XML handlers of actions and modifiers.

Each action and modifier of the library is stated here or where its form is written, by the
decorators and by `without_form`; `tools/make_catalogue.py` fails if one is missing.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Literal, TypeVar

from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.actions.leaf import (
    Change,
    Changes,
    Leaf,
    Modify,
    Perform,
    Performance,
    PerformGlobal,
)
from osc2tx.losses.entries import Inexpressible
from osc2tx.xosc import elements as xml

ACTIONS: dict[str, Perform] = {}
GLOBAL_ACTIONS: dict[str, PerformGlobal] = {}
MODIFIERS: dict[str, Modify] = {}

TAKES: dict[str, frozenset[str]] = {}
"""Domains that a form takes over, where it is not what the action or modifier controls."""

AT_START: set[str] = set()
"""Modifiers whose form is the start of an actor or the choice of the map."""

What = Literal["action", "modifier"]
WITHOUT_FORM: dict[What, dict[str, str]] = {"action": {}, "modifier": {}}
"""Why there is no form."""


HandlerT = TypeVar("HandlerT", Perform, PerformGlobal, Modify)


def _registering(
    forms: dict[str, HandlerT], what: str, names: Iterable[str], takes: Iterable[str] | None
) -> Callable[[HandlerT], HandlerT]:
    def register(handler: HandlerT) -> HandlerT:
        for name in names:
            assert name not in forms, f"two handlers for {what}{name}"
            forms[name] = handler
            if takes is not None:
                TAKES[f"{what}{name}"] = frozenset(takes)
        return handler

    return register


def action(*names: str, takes: Iterable[str] | None = None) -> Callable[[Perform], Perform]:
    """Register a handler for actions of the library, by their names without actors.

    The elements take over some domains, by default those that the actions control.
    """
    return _registering(ACTIONS, "", names, takes)


def modifier(*names: str, takes: Iterable[str] | None = None) -> Callable[[Modify], Modify]:
    """Register a handler for modifiers of the library; parameters as of `action`."""
    return _registering(MODIFIERS, "modifier ", names, takes)


def global_action(*names: str) -> Callable[[PerformGlobal], PerformGlobal]:
    """Register a handler for actions that concern no entity."""
    return _registering(GLOBAL_ACTIONS, "", names, None)


def at_start(*names: str) -> None:
    """Register modifiers that are written as the start of an actor or the choice of the map."""
    AT_START.update(names)


def without_form(what: What, name: str, reason: str) -> None:
    """Register why XML cannot have an action or modifier; scenarios that use it are refused."""
    WITHOUT_FORM[what][name] = reason


def apply_modifiers(leaf: Leaf) -> Changes:
    """Return what the modifiers of an invocation change."""
    changes: list[Change] = []
    for node in leaf.node.modifiers:
        call = Arguments(leaf.ctx, node)
        handler = MODIFIERS.get(call.name)
        if handler is None:
            reason = f"`{call.name}` has no counterpart here"
            leaf.ctx.report.cannot(call.construct, call.span, reason)
            continue
        with leaf.ctx.report_as(call.construct, call.span):
            if call.at == "start" and call.name != "speed":
                require_at_start(leaf, call)
                continue
            changes.extend(handler(leaf, call))
            call.finish()
    return tuple(changes)


def require_at_start(leaf: Leaf, call: Arguments) -> None:
    """Report what has to hold when an action begins: the run in the world checks it.

    Raises:
        Inexpressible: It is where an actor sets out that nothing places before.
    """
    if leaf.enters:
        raise Inexpressible("where an actor is that only sets out later")
    call.doubt(
        "a scenario fails if it does not hold at the start, which XML does not check",
        note="it holds at the start in the runs that were compared; the XML does not check it",
    )


def to_goal(
    leaf: Leaf, *own: Change, reached: tuple[xml.ByEntityCondition, ...] = ()
) -> Performance:
    """Return an action that is over with its own changes, whatever its modifiers still change."""
    others = apply_modifiers(leaf)
    lengths = [change.time for change in own if change.time is not None]
    longest = max(lengths, default=0.0)
    is_known = len(lengths) == len(own)
    is_shorter = is_known and any(o.time is None or o.time > longest for o in others)
    return Performance((*own, *others), "goal", longest if is_shorter else None, reached)
