"""Arguments for parameters whose one value an invoked scenario states itself."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.analysis import single_value
from osc2tx.lowering.behavior.composed_behaviors import Composed
from osc2tx.lowering.context import LoweringContext
from osc2tx.semantics.names.member_lookup import parameters_of


def without_fixed(
    ctx: LoweringContext, callee: Composed, arguments: tuple[ir.Argument, ...]
) -> tuple[ir.Argument, ...]:
    """Return the arguments for parameters that a scenario leaves open.

    A constant that contradicts the scenario is an error already; an open value may do so.
    """
    domains = ctx.analysis.types[callee].domains_to_set()
    fixed = set()
    for parameter in parameters_of(callee):
        domain = domains.get((parameter,))
        if domain is not None and single_value(domain) is not None:
            fixed.add(parameter.name)
    for argument in arguments:
        is_open = any(isinstance(part, ir.FieldRef) for part in ir.walk(argument.value))
        if (
            argument.parameter in fixed
            and argument.value.type.kind is not ir.Kind.ACTOR
            and is_open
        ):
            ctx.unsupported(
                "OSC501",
                argument.span,
                f"`{callee.qualified_name}` has one value of `{argument.parameter}` itself; this"
                " one is open, and may be another",
                help="leave the argument out, or the constraint there",
            )
    return tuple(each for each in arguments if each.parameter not in fixed)
