"""Actions that the scenario declares: commands for the simulator."""

from __future__ import annotations

from collections.abc import Mapping

from osc2tx import ir
from osc2tx.backends.xosc.actions.arguments import Arguments, construct_of_action
from osc2tx.backends.xosc.actions.leaf import Change, Leaf, Performance
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.state import NOTHING_KNOWN, WAY
from osc2tx.backends.xosc.values.constants import Constant, Member, Named
from osc2tx.diagnostics import Span
from osc2tx.losses.entries import Inexpressible, Remedy
from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import text_of

# Holds the speed and keeps the lane, as the default controller of the XML does.
DEFAULT = "steady_driver"


def check_model(ctx: Context, member: CastMember) -> None:
    """Refuse an entity that starts with another model than the default one."""
    name = ctx.values.field(member.actor.name, "initial_bm", "bm_engine", "name")
    if name not in (None, DEFAULT):
        raise no_model(f"what a `{name}` does", member.actor.span)


def no_model(what: str, span: Span) -> Inexpressible:
    """Return why a behavioral model cannot be written."""
    reason = f"{what} is up to the controllers of a tool; the XML cannot say it"
    asks = ("SpeedActionDynamics", "LaneChangeActionDynamics")
    saying = Remedy(instead="actions that say speed and lane are exact", asks=asks)
    return Inexpressible(reason, span, saying)


def user_action(leaf: Leaf) -> Performance:
    """Return the command that a tool carries out for an action of the scenario's own."""
    command = own_command(leaf.ctx, leaf.node, leaf.arguments)
    change = Change(WAY, (command,), None, NOTHING_KNOWN, NOTHING_KNOWN)
    return Performance((change,), "open")


def own_command(ctx: Context, node: ir.Invoke, arguments: Arguments) -> xml.UserDefinedAction:
    """Return the command for an action of the scenario's own, with or without an actor."""
    ctx.require_support("CustomCommandAction")
    if node.duration is None and not node.until:
        raise Inexpressible(
            "tools do not tell when a command of their own is over",
            remedy=Remedy(instead="with a duration or an `until` it is exact"),
        )
    if node.modifiers:
        raise Inexpressible("modifiers of an action that only the tool knows")
    values = {each.parameter: arguments.get(each.parameter) for each in node.arguments}
    note = f"the tool has to know the command `{node.action}`"
    ctx.report.exact(construct_of_action(node), node.span, note)
    return command_of(node.action, values)


def command_of(name: str, arguments: Mapping[str, Constant | None]) -> xml.UserDefinedAction:
    """Return the action that gives a tool a command of its own."""
    text = ", ".join(f"{parameter}={_text(value)}" for parameter, value in arguments.items())
    command = xml.CustomCommandAction(text=text or None, type=name)
    return xml.UserDefinedAction(command)


def _text(value: Constant | None) -> str:
    match value:
        case Member(name=name) | Named(name=name):
            return name
        case bool() | int() | float() | str():
            return text_of(value)
    raise Inexpressible("an argument that is only known during the run")
