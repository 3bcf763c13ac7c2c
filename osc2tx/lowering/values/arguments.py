"""Arguments of calls and invocations (§7.3.5.1.3)."""

from __future__ import annotations

from collections.abc import Sequence

from osc2tx import ir
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.value_types import lower_type
from osc2tx.semantics import types
from osc2tx.semantics.model import Binding
from osc2tx.syntax import ast


def lower_arguments(
    ctx: LoweringContext, binding: Binding, written: Sequence[ast.Argument]
) -> tuple[ir.Argument, ...]:
    """Lower the arguments of a call, each with the parameter it is for."""
    nodes = {id(argument.value): argument for argument in written}
    lowered = []
    for parameter, value in binding.arguments:
        expression = ctx.lower(value)
        if expression is not None and binding.callee.origin != "user":
            _refuse_added_member(ctx, expression, parameter.type)
        argument = nodes.get(id(value))
        if expression is not None:
            lowered.append(
                ir.Argument(
                    parameter=parameter.name,
                    value=_as_range(expression, parameter.type),
                    is_positional=argument is not None and argument.name is None,
                    span=argument.span if argument else value.span,
                )
            )
    return tuple(lowered)


def _refuse_added_member(ctx: LoweringContext, value: ir.Expression, type_: types.Type) -> None:
    """Refuse a member that the user adds to an enum of the library, which cannot know it."""
    if not isinstance(value, ir.EnumValue) or not isinstance(type_, types.EnumType):
        return
    enum = type_.symbol
    if enum.origin != "user" and enum.members[value.member].origin == "user":
        known = ", ".join(f"`{m.name}`" for m in enum.members.values() if m.origin != "user")
        ctx.unsupported(
            "OSC503",
            value.span,
            f"the library does not know `{value.member}`, which is added to `{enum.name}`",
            help=f"use one of {known}",
        )


def _as_range(value: ir.Expression, type_: types.Type) -> ir.Expression:
    """Return a value of a parameter: where that is a range, a number is the range of itself."""
    if not isinstance(type_, types.RangeType) or value.type.kind is ir.Kind.RANGE:
        return value
    return ir.RangeValue(span=value.span, type=lower_type(type_), lower=value, upper=value)
