"""Modifiers of invocations, and ranges that are given for numbers."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.diagnostics import Span
from osc2tx.lowering.context import LoweringContext, statement_comments
from osc2tx.lowering.value_types import lower_type
from osc2tx.lowering.values.arguments import lower_arguments
from osc2tx.lowering.values.shape_arguments import with_shapes
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.semantics.model import Binding
from osc2tx.syntax import ast
from osc2tx_shared.classes import replace

# (modifier, parameter) -> its default in the standard, the parameters it gives meaning to, and
# those that take its meaning away.
STANDARD_DEFAULTS: dict[tuple[str, str], tuple[str | None, frozenset[str], frozenset[str]]] = {
    ("lane", "from"): ("right", frozenset({"lane"}), frozenset({"same_as", "side_of"})),
    ("position", "frame"): (None, frozenset({"x", "y", "z", "h"}), frozenset()),
}


def dialect_defaults(
    callee: sym.Symbol, given: tuple[ir.Argument, ...], span: Span
) -> tuple[ir.Argument, ...]:
    """Return the defaults that differ from the standard's and matter for these arguments."""
    if not isinstance(callee, sym.ModifierSymbol):
        return ()
    names = {argument.parameter for argument in given}
    defaults = []
    for (modifier, parameter), (standard, companions, rivals) in STANDARD_DEFAULTS.items():
        if modifier != callee.name or parameter in names:
            continue
        if not companions & names or rivals & names:
            continue
        value = _default(callee.members.get(parameter), span)
        if value is not None and _text(value) != standard:
            defaults.append(
                ir.Argument(parameter=parameter, value=value, is_positional=False, span=span)
            )
    return tuple(defaults)


def set_position(ctx: LoweringContext, modifier: ir.ModifierCall) -> ir.ModifierCall:
    """Return ScenarioRunner's `set_position` as the equivalent `position`.

    Both are left-handed; a position on a road has no pitch or roll of its own.
    """
    arguments = []
    for argument in modifier.arguments:
        if argument.parameter not in ("pitch", "roll"):
            name = "h" if argument.parameter == "yaw" else argument.parameter
            arguments.append(replace(argument, parameter=name, is_positional=False))
        elif ir.constant(argument.value) != 0.0:
            ctx.unsupported(
                "OSC509", argument.span, f"`{argument.parameter}` can only be 0: roads are level"
            )
    type_ = ir.ValueType(ir.Kind.STRING, "string")
    frame = ir.Literal(span=modifier.span, type=type_, value="carla")
    arguments.append(
        ir.Argument(parameter="frame", value=frame, is_positional=False, span=modifier.span)
    )
    return replace(modifier, name="position", arguments=tuple(arguments), at="start")


def _text(value: ir.Literal | ir.EnumValue) -> str:
    return value.member if isinstance(value, ir.EnumValue) else str(value.value)


def _default(field: sym.Member | None, span: Span) -> ir.Literal | ir.EnumValue | None:
    match field:
        case sym.FieldSymbol(default=ast.StringLiteral(value=text)):
            return ir.Literal(span=span, type=lower_type(field.type), value=text)
        case sym.FieldSymbol(
            default=ast.NameExpression(name=name), type=types.EnumType(symbol=enum)
        ):
            member = enum.members[name.text]
            return ir.EnumValue(
                span=span, type=lower_type(field.type), member=member.name, value=member.value
            )
        case _:
            return None


def lower_modifier(
    ctx: LoweringContext, node: ast.ModifierApplication, what: str
) -> ir.ModifierCall:
    """Lower a modifier; `at` is not among its arguments, as it states when it applies.

    Args:
        ctx: The checked program.
        node: The modifier.
        what: Its owner, for names of values that are drawn from ranges.
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
    """Draw one value if a range is passed for a number (§7.3.5.1.3)."""
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
