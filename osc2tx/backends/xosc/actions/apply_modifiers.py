"""Applies the modifiers of an invocation by their handlers."""

from __future__ import annotations

from osc2tx.backends.xosc.actions.leaf import Arguments, Change, Leaf
from osc2tx.backends.xosc.actions.registry import MODIFIERS, WITHOUT_FORM
from osc2tx.backends.xosc.report import Inexpressible


def apply_modifiers(leaf: Leaf) -> tuple[Change, ...]:
    """Return what the modifiers of an invocation change."""
    changes: list[Change] = []
    for call in leaf.node.modifiers:
        handler = MODIFIERS.get(call.name)
        if handler is None:
            reason = f"`{call.name}` has no counterpart here"
            reason = WITHOUT_FORM["modifier"].get(call.name, reason)
            leaf.ctx.report.cannot(f"modifier {call.name}", call.span, reason)
            continue
        with leaf.ctx.report_as(f"modifier {call.name}", call.span):
            if call.at == "start" and call.name != "speed":
                raise Inexpressible("what has to hold at the start is not checked in the XML")
            arguments = Arguments(leaf.ctx, call.arguments, call)
            changes.extend(handler(leaf, call, arguments))
            arguments.finish()
    return tuple(changes)
