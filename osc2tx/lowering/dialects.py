"""What a dialect changed is written out, so that backends need not know dialects.

Defaults that it changed become arguments, and what it calls by another name gets the library's.
"""

from __future__ import annotations

from osc2tx import ir
from osc2tx.diagnostics import Span
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.value_types import lower_type
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.syntax import ast
from osc2tx_classes import replace

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
    """Return ScenarioRunner's `set_position` as the `position` that says the same.

    Both are left-handed; a place on a road has no pitch or roll of its own.
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
