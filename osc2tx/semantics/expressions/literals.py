"""Physical literals, lists and ranges."""

from __future__ import annotations

from osc2tx.diagnostics.fixes import write
from osc2tx.diagnostics.suggestions import name_meant
from osc2tx.semantics.conversions import common_type, is_numeric
from osc2tx.semantics.declarations.redeclarations import report_disputed
from osc2tx.semantics.dialects import UNIT_ALIASES
from osc2tx.semantics.names.aliases import unit_alias, write_instead
from osc2tx.semantics.names.colloquial_names import UNITS, plain_word
from osc2tx.semantics.names.unknown_names import report_unimported
from osc2tx.semantics.resolution import Environment, Resolution
from osc2tx.semantics.symbols import UnitSymbol
from osc2tx.semantics.types import ERROR, ListType, RangeType, Type
from osc2tx.semantics.units import LARGEST, SMALLEST, constant_number, is_measurable
from osc2tx.syntax import ast


def infer_physical(r: Resolution, node: ast.PhysicalLiteral) -> Type:
    """Type a number with a unit; unit names form one table (§7.3.4)."""
    unit = r.scope.unit_named(node.unit.text)
    if unit is None and (standard := unit_alias(r, node.unit)):
        unit = r.scope.unit_named(standard.text)
    if unit is None:
        if not report_unimported(r, node.unit):
            known = [u.name for u in r.scope.all_units()]
            r.report(
                "OSC209",
                node.unit.span,
                f"no unit `{node.unit}`",
                help=write_instead(node.unit.span, UNIT_ALIASES.get(node.unit.text))
                or plain_word(node.unit.span, UNITS)
                or name_meant(node.unit.span, known),
            )
        return ERROR
    if rival := r.relaxations.disputed.get(node.unit.text):
        report_disputed(r, node.unit, unit, rival)
    r.units[node] = unit
    r.references[node.unit] = unit
    _check_size(r, node, unit)
    return unit.type


def _check_size(r: Resolution, node: ast.PhysicalLiteral, unit: UnitSymbol) -> None:
    """Report a quantity that nothing has, before anything is computed with it."""
    if not is_measurable(unit.factor, unit.offset):
        return  # its declaration is reported
    value = abs(node.value * unit.factor)
    if value > LARGEST or (node.value and value < SMALLEST):
        size = "small" if value < SMALLEST else "large"
        r.report(
            "OSC516",
            node.span,
            f"no world has so {size} a quantity",
            notes=[f"in SI units it is {value:g}; it may be {SMALLEST:g} to {LARGEST:g}, or zero"],
        )


def infer_list(
    r: Resolution, node: ast.ListLiteral, env: Environment, expected: Type | None
) -> Type:
    """Type `[a, b]`; lists inside are flattened (§7.4.2.7)."""
    if not node.elements:
        return ERROR  # a remnant of a syntax error
    element = expected.element if isinstance(expected, ListType) else None
    types = []
    for item in node.elements:
        type_ = r.type_of(item, env, element)
        types.append(type_.element if isinstance(type_, ListType) else type_)
    common = common_type(r.scope, types)
    if common is None:
        names = ", ".join(f"`{t}`" for t in dict.fromkeys(types))
        r.report("OSC314", node.span, f"the elements have no common type: {names}")
        return ERROR
    return ERROR if common == ERROR else ListType(common)


def infer_range(
    r: Resolution, node: ast.RangeLiteral, env: Environment, expected: Type | None
) -> Type:
    """Type `[a .. b]`."""
    bound = expected.element if isinstance(expected, RangeType) else expected
    lower = r.type_of(node.lower, env, bound)
    upper = r.type_of(node.upper, env, bound)
    if ERROR in (lower, upper):
        return ERROR
    for type_, operand in ((lower, node.lower), (upper, node.upper)):
        if not is_numeric(type_):
            r.report("OSC310", operand.span, f"a bound of a range cannot be `{type_}`")
            return ERROR
    common = common_type(r.scope, (lower, upper))
    if common is None:
        r.report("OSC302", node.span, f"the bounds are `{lower}` and `{upper}`")
        return ERROR
    if r.standard < "2.2":
        _check_order(r, node)
    return RangeType(common)


def _check_order(r: Resolution, node: ast.RangeLiteral) -> None:
    """Report a range with the upper bound first: only 2.2 allows both orders."""
    lower, upper = constant_number(r, node.lower), constant_number(r, node.upper)
    if lower is not None and upper is not None and upper < lower:
        ordered = f"[{node.upper.span.text}..{node.lower.span.text}]"
        r.report(
            "OSC323",
            node.span,
            "the upper bound comes first",
            help=write(node.span, ordered, f"write `{ordered}`: it is read as this range"),
            notes=["from 2.2 on the order is free (`--std 2.2`)"],
        )
