"""Modifiers of invocations, and ranges that are given for numbers."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.lowering.arguments import lower_arguments
from osc2tx.lowering.context import LoweringContext, statement_comments
from osc2tx.lowering.dialects import dialect_defaults, set_position
from osc2tx.lowering.shape_arguments import with_shapes
from osc2tx.lowering.value_types import lower_type
from osc2tx.semantics import types
from osc2tx.semantics.model import Binding
from osc2tx.syntax import ast
from osc2tx_classes import replace


def lower_modifier(
    ctx: LoweringContext, node: ast.ModifierApplication, what: str
) -> ir.ModifierCall:
    """Lower a modifier; `at` is taken out of its arguments, for it says when it holds.

    Args:
        ctx: The checked program.
        node: The modifier.
        what: What it belongs to, for names of values that are drawn from ranges.
    """
    binding = ctx.model.binding_of(node)
    arguments = lower_arguments(ctx, binding, node.arguments)
    arguments = draw_ranges(ctx, binding, arguments, f"{what}.{node.modifier.text}")
    arguments = with_shapes(ctx, binding, arguments)
    arguments += dialect_defaults(binding.callee, arguments, node.span)
    at = next((a.value for a in arguments if a.parameter == "at"), None)
    modifier = ir.ModifierCall(
        span=node.span,
        name=node.modifier.text,
        arguments=tuple(a for a in arguments if a.parameter != "at"),
        at=at.member if isinstance(at, ir.EnumValue) else "all",
        comments=statement_comments(node),
    )
    is_dialect = binding.callee.origin == "prelude" and modifier.name == "set_position"
    return set_position(ctx, modifier) if is_dialect else modifier


def is_override(ctx: LoweringContext, node: ast.ModifierApplication) -> bool:
    """Whether a modifier is the language's own `override`."""
    callee = ctx.model.binding_of(node).callee
    return callee.origin == "builtin" and callee.name == "override"


def draw_ranges(
    ctx: LoweringContext, binding: Binding, arguments: tuple[ir.Argument, ...], what: str
) -> tuple[ir.Argument, ...]:
    """Let one value be chosen where a range is given for a number (§7.3.5.1.3)."""
    fields = {parameter.name: parameter for parameter, _ in binding.arguments}
    drawn = []
    for argument in arguments:
        type_ = fields[argument.parameter].type
        is_duration = argument.parameter == "duration"
        if isinstance(argument.value, ir.RangeValue) and not isinstance(type_, types.RangeType):
            short = what.rpartition(".")[2] == argument.parameter
            name = what if short else f"{what}.{argument.parameter}"
            if not is_duration:
                value = ctx.draw(name, argument.value, lower_type(type_))
                argument = replace(argument, value=value)
        drawn.append(argument)
    return tuple(drawn)
