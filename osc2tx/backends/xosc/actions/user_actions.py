"""Actions that the scenario declares: commands for the simulator."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from osc2tx.backends.xosc.actions.leaf import Change, Leaf, Performance
from osc2tx.backends.xosc.report import Inexpressible
from osc2tx.backends.xosc.state import WAY, ActorState
from osc2tx.backends.xosc.values.constants import Constant, Member, Named
from osc2tx.backends.xosc.xml.tree import Element, element, text_of


def user_action(leaf: Leaf) -> Performance:
    """Return the command that a tool carries out for an action of the scenario's own."""
    leaf.ctx.require_support("CustomCommandAction", leaf.node.span)
    if leaf.duration is None and not leaf.node.until:
        raise Inexpressible(
            "tools do not tell when a command of their own is over: give it a duration or an"
            " `until`",
            leaf.node.span,
        )
    names = [argument.parameter for argument in leaf.node.arguments]
    if leaf.node.modifiers:
        raise Inexpressible("modifiers of an action that only the tool knows", leaf.node.span)
    command = command_of(leaf.node.action, {name: leaf.arguments.get(name) for name in names})
    note = f"the tool has to know the command `{leaf.node.action}`"
    leaf.ctx.report.exact(leaf.construct, leaf.node.span, note)
    after = ActorState(offset=None, rate=None)
    change = Change(WAY, (command,), None, after, after)
    return Performance((change,), "open")


def command_of(name: str, arguments: Mapping[str, Constant | None]) -> Element:
    """Return the action that gives a tool a command of its own."""
    text = ", ".join(f"{parameter}={_text(value)}" for parameter, value in arguments.items())
    command = replace(element("CustomCommandAction", type=name), text=text or None)
    return element("UserDefinedAction", command)


def _text(value: Constant | None) -> str:
    match value:
        case Member(name=name) | Named(name=name):
            return name
        case bool() | int() | float() | str():
            return text_of(value)
    raise Inexpressible("an argument that is only known during the run")
