"""Starts of later actions: a range at the start admits whatever value the actor then has.

The value is not drawn: what came before decides it (§8.9.1.4).
"""

from __future__ import annotations

from osc2tx import ir
from osc2tx.catalogue import catalogue
from osc2tx.lowering.context import LoweringContext
from osc2tx_shared.classes import replace


def with_any_start(ctx: LoweringContext, node: ir.Invoke) -> ir.Invoke:
    """Return an action of an actor in motion whose ranges `at: start` are conditions."""
    modifiers = (
        _as_condition(ctx, each) if each.at == "start" else each for each in node.modifiers
    )
    return replace(node, modifiers=tuple(modifiers))


def _as_condition(ctx: LoweringContext, modifier: ir.ModifierCall) -> ir.ModifierCall:
    entry = catalogue().modifiers.get(modifier.name)
    known = frozenset() if entry is None else entry.parameters
    drawn = {each.name: each for each in ctx.drawn if isinstance(each, ir.Parameter)}
    arguments = []
    for argument in modifier.arguments:
        parameter, value = f"{argument.parameter}_range", argument.value
        source = drawn.get(value.name) if isinstance(value, ir.FieldRef) else None
        if source is not None and isinstance(source.domain, ir.RangeValue) and parameter in known:
            ctx.drawn.remove(source)
            argument = replace(
                argument, parameter=parameter, value=source.domain, is_positional=False
            )
        arguments.append(argument)
    return replace(modifier, arguments=tuple(arguments))
