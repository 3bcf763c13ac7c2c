"""What an event hands over: variables, which are set when the event is emitted."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.logical.parameters import value_text
from osc2tx.backends.xosc.values.constants import Constant
from osc2tx.xosc import elements as xml
from osc2tx.xosc.literals import Rule


def set_parameters(ctx: Context, emission: ir.Emit) -> tuple[xml.ActionPart, ...]:
    """Return the actions that set what an emission hands over."""
    found = []
    for argument in emission.arguments:
        value = ctx.values.of(argument.value)
        variable = _variable(ctx, emission.event.name, argument.parameter, value)
        found.append(ctx.set_variable(variable, value_text(value)))
    return tuple(found)


def parameter_condition(
    ctx: Context, argument: ir.EventArgument, rule: Rule, value: Constant
) -> xml.ByValueCondition:
    """Return the condition on what an event has handed over."""
    if not isinstance(value, (int, float)):
        ctx.require_support("ParameterCondition/text", argument.span)
    variable = _variable(ctx, argument.event, argument.parameter, value)
    return ctx.variable_is(variable, rule, value_text(value))


def _variable(ctx: Context, event: str, parameter: str, value: Constant) -> str:
    """Return the variable for a parameter of an event, declared."""
    variable = ctx.variable_name(f"{ctx.scope.prefix}{event}.{parameter}")
    if isinstance(value, bool):
        ctx.declare(variable, "boolean", "false")
    elif isinstance(value, (int, float)):
        ctx.declare(variable, "double", "0")
    else:
        ctx.declare(variable, "string", "")
    return variable
