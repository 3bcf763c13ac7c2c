"""Conversions `.as(T)` and type tests `.is(T)` (§7.4.2.5, §7.4.2.6)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from osc2tx import ir
from osc2tx.diagnostics import Span
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.value_types import BOOL, lower_type
from osc2tx.lowering.values.references import member_of
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.semantics.conversions import symbol_of
from osc2tx.semantics.scope import is_subtype, supertypes
from osc2tx.syntax import ast

DATE = ("environment", "datetime")
COMPARISONS = frozenset({"==", "!=", "<", "<=", ">", ">="})


def without_dates(expression: ir.Binary) -> ir.Expression:
    """Return a sum or comparison without the dates that cancel out."""
    if expression.operator not in COMPARISONS | {"+", "-"}:
        return expression
    totals: Counter[str] = Counter()
    _count(expression, 1, totals)
    if not totals or any(totals.values()):
        return expression
    return ir.rewrite(expression, _zero)


def _count(part: ir.Expression, sign: int, totals: Counter[str]) -> None:
    match part:
        case ir.Binary(operator="+", left=left, right=right):
            _count(left, sign, totals)
            _count(right, sign, totals)
        case ir.Binary(operator=operator, left=left, right=right) if (
            operator == "-" or operator in COMPARISONS
        ):
            _count(left, sign, totals)
            _count(right, -sign, totals)
        case ir.Unary(operator="-", operand=operand):
            _count(operand, -sign, totals)
        case ir.Attribute(base=ir.FieldRef(name=name)) if _is_date(part):
            totals[name] += sign
        case _ if holds_date(part):
            totals["elsewhere"] += 1


def holds_date(part: ir.Expression) -> bool:
    """Whether the date of an environment is read anywhere in an expression."""
    return any(_is_date(inner) for inner in ir.walk(part))


def _is_date(part: ir.Expression) -> bool:
    return isinstance(part, ir.Attribute) and (part.owner, part.name) == DATE


def _zero(part: ir.Expression) -> ir.Expression | None:
    return ir.Literal(span=part.span, type=part.type, value=0.0) if _is_date(part) else None


def lower_cast(ctx: LoweringContext, node: ast.Cast) -> ir.Expression | None:
    """Lower `.as(T)`."""
    operand = ctx.lower(node.base)
    source, target = ctx.model.type_of(node.base), ctx.model.type_of(node)
    if operand is None:
        return None
    span, type_ = node.span, lower_type(target)
    match source, target:
        case types.EnumType(symbol=enum), types.PrimitiveType():
            if isinstance(operand, ir.EnumValue):
                return ir.Literal(span=span, type=type_, value=operand.value)
            numbers = tuple((m.name, m.value) for m in enum.members.values())
            return ir.Lookup(span=span, type=type_, operand=operand, table=numbers)
        case types.PrimitiveType(), types.EnumType(symbol=enum):
            members = {m.value: m.name for m in reversed(enum.members.values())}
            if isinstance(operand, ir.Literal) and operand.value in members:
                number = int(operand.value)
                return ir.EnumValue(span=span, type=type_, member=members[number], value=number)
            table = tuple(sorted(members.items()))
            return ir.Lookup(span=span, type=type_, operand=operand, table=table)
        case types.PrimitiveType(), types.PrimitiveType() if source != target:
            return ir.Conversion(span=span, type=type_, operand=operand)
        case (types.ActorType(symbol=given), types.ActorType(symbol=wanted)) | (
            types.StructType(symbol=given),
            types.StructType(symbol=wanted),
        ):
            if is_subtype(given, wanted):
                return operand
            if wanted.origin == "user":
                ctx.used.types.append(wanted)
            return ir.Downcast(span=span, type=type_, operand=operand)
    if source == target:
        return operand
    ctx.unsupported("OSC503", span, f"a `{source}` cannot be converted to `{target}` yet")
    return None


def lower_type_test(ctx: LoweringContext, node: ast.TypeTest) -> ir.Expression | None:
    """Lower `.is(T)`: a constant at compile time, the conditions of `T`, or a test."""
    operand = ctx.lower(node.base)
    given = symbol_of(ctx.model.type_of(node.base))
    wanted = symbol_of(ctx.model.types[node.type])
    if operand is None:
        return None
    if given is None or wanted is None or is_subtype(given, wanted):
        return ir.Literal(span=node.span, type=BOOL, value=given is wanted or given is not None)
    tests = list(_tests(ctx, operand, given, wanted, node.span))
    result = tests[0]
    for test in tests[1:]:
        result = ir.Binary(span=node.span, type=BOOL, operator="and", left=result, right=test)
    return result


def _tests(
    ctx: LoweringContext,
    operand: ir.Expression,
    given: sym.TypeSymbol,
    wanted: sym.TypeSymbol,
    span: Span,
) -> Iterator[ir.Expression]:
    """Yield the conditions for an object to be of a subtype, from the most general one on."""
    below = [type_ for type_ in supertypes(wanted) if not is_subtype(given, type_)]
    plain = [type_ for type_ in below if getattr(type_, "condition", None) is None]
    for type_ in reversed(below):
        condition = getattr(type_, "condition", None)
        if condition is None and type_ is not plain[0]:
            continue  # values of the most special of them are values of the others
        if condition is None:
            yield ir.TypeTest(span=span, type=BOOL, operand=operand, tested=type_.name)
            continue
        field = ctx.model.symbol_of(condition.field)
        value = ctx.lower(condition.value)
        if isinstance(field, sym.FieldSymbol) and value is not None:
            left = member_of(ctx, operand, field, span)
            yield ir.Binary(span=span, type=BOOL, operator="==", left=left, right=value)
