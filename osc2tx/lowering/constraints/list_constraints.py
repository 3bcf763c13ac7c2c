"""Lists that constraints describe element by element (§7.3.5.2.1).

`keep(l[k] == v)` implies that the list has an element `k`. Its size is given by `keep(l.size() ==
n)`, else it is just long enough; elements without constraints are open.
"""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx import ir
from osc2tx.analysis.constraints.conjunctions import conjuncts
from osc2tx.analysis.constraints.constraint import Constraint
from osc2tx.analysis.constraints.operation_list import Key
from osc2tx.analysis.constraints.parameter_lookup import Place
from osc2tx.lowering.constraints.constraints import ConstraintLowering
from osc2tx.lowering.constraints.parameter_domains import (
    COMPARISONS,
    all_values,
    as_type,
)
from osc2tx.lowering.context import LoweringContext, statement_comments
from osc2tx.lowering.declarations.user_fields import is_plain
from osc2tx.lowering.value_types import lower_type
from osc2tx.lowering.values.expressions import lower_expression
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.syntax import ast

Op = ast.BinaryOperator

# Longer lists are not written by hand.
LONGEST = 1000


def lower_list(
    ctx: LoweringContext, field: sym.FieldSymbol, constraints: ConstraintLowering
) -> ir.ListValue | None:
    """Return a list that has no value as a whole; `None` if no constraint describes it."""
    assert isinstance(field.type, types.ListType)
    said, size = _said(ctx, field, constraints)
    said = _without_list(field.name, said)
    if size is None:
        size = max(said, default=-1) + 1
    if not 0 < size <= LONGEST:
        return None
    alike = _alike(field.type.element, said)
    elements = [
        _element(ctx, field, field.type.element, k, said.get(k, alike)) for k in range(size)
    ]
    present = tuple(element for element in elements if element is not None)
    if len(present) < size:
        return None
    return ir.ListValue(span=field.span, type=lower_type(field.type), elements=present)


def _said(
    ctx: LoweringContext, field: sym.FieldSymbol, constraints: ConstraintLowering
) -> tuple[dict[int, ir.Expression], int | None]:
    """Return the constraints on single elements, and on the size."""
    assert isinstance(field.type, types.ListType)
    said: dict[int, ir.Expression] = {}
    bounds: dict[int, dict[bool, ir.Expression]] = {}
    size = None
    for constraint in constraints.found.in_force.constraints:
        if not isinstance(constraint.node, ast.KeepConstraint):
            continue
        for part in conjuncts(constraint.node.expression):
            for subject, value in _sides(part):
                if isinstance(subject, ast.Index) and isinstance(subject.index, ast.IntegerLiteral):
                    if constraint.place.locate(subject.base) != (field,):
                        continue
                    lowered = lower_expression(ctx.at(constraint.place), value)
                    if lowered is not None:
                        said[subject.index.value] = lowered
                elif _is_size(ctx, subject, field, constraint.place):
                    size = value.value if isinstance(value, ast.IntegerLiteral) else None
            for index, is_lower, bound in _bounds(ctx, field, constraint, part):
                bounds.setdefault(index, {}).setdefault(is_lower, bound)
    for index, ends in bounds.items():
        if index not in said and len(ends) == 2:
            type_ = lower_type(types.RangeType(field.type.element))
            said[index] = ir.RangeValue(
                span=ends[True].span, type=type_, lower=ends[True], upper=ends[False]
            )
    return said, size


def _bounds(
    ctx: LoweringContext, field: sym.FieldSymbol, constraint: Constraint, part: ast.Expression
) -> Iterator[tuple[int, bool, ir.Expression]]:
    """Yield the constant that a comparison bounds an element by, and whether from below."""
    if not isinstance(part, ast.Binary) or part.operator not in COMPARISONS:
        return
    for side, other in ((part.left, part.right), (part.right, part.left)):
        if not isinstance(side, ast.Index) or not isinstance(side.index, ast.IntegerLiteral):
            continue
        if constraint.place.locate(side.base) != (field,) or not _is_constant(other):
            continue
        bound = lower_expression(ctx.at(constraint.place), other)
        if bound is not None:
            is_greater = part.operator in (Op.GREATER, Op.GREATER_EQUAL)
            yield side.index.value, is_greater == (side is part.left), bound


def _is_constant(node: ast.Expression) -> bool:
    """Whether an expression is a plain number or physical value."""
    negated = isinstance(node, ast.Unary) and node.operator is ast.UnaryOperator.NEGATE
    number = node.operand if isinstance(node, ast.Unary) and negated else node
    return isinstance(number, ast.IntegerLiteral | ast.FloatLiteral | ast.PhysicalLiteral)


def _without_list(name: str, said: dict[int, ir.Expression]) -> dict[int, ir.Expression]:
    """Return the values of elements; one that reads another element gets its value.

    Drawn elements have no value to insert, and circular ones keep their reference:
    `in_order_of_use` reports them.
    """

    def replacement(part: ir.Expression) -> ir.Expression | None:
        match part:
            case ir.Index(base=ir.FieldRef(name=read), index=ir.Literal(value=int(index))) if (
                read == name and index in said and index not in pending
            ):
                value = said[index]
                if isinstance(value, ir.RangeValue | ir.ListValue):
                    return None
                pending.append(index)
                inlined = ir.rewrite(value, replacement)
                pending.pop()
                return inlined
        return None

    pending: list[int] = []
    found = {}
    for index, value in said.items():
        pending.append(index)
        found[index] = ir.rewrite(value, replacement)
        pending.pop()
    return found


def _alike(element: types.Type, said: dict[int, ir.Expression]) -> ir.Expression | None:
    """Return the domain of elements without constraints: the same as that of the first ones."""
    if isinstance(element, types.RangeType):
        return None
    several = (ir.RangeValue, ir.ListValue)
    return next((said[k] for k in sorted(said) if isinstance(said[k], several)), None)


def _sides(part: ast.Expression) -> Iterator[tuple[ast.Expression, ast.Expression]]:
    if isinstance(part, ast.Binary) and part.operator in (Op.EQUAL, Op.IN):
        yield part.left, part.right


def _is_size(
    ctx: LoweringContext, node: ast.Expression, field: sym.FieldSymbol, place: Place
) -> bool:
    binding = ctx.model.bindings.get(node)
    if binding is None or binding.receiver is None or binding.callee.name != "size":
        return False
    return place.locate(binding.receiver) == (field,)


def _element(
    ctx: LoweringContext,
    field: sym.FieldSymbol,
    type_: types.Type,
    index: int,
    said: ir.Expression | None,
) -> ir.Expression | None:
    name = f"{field.name}.{index}"
    match said:
        case None if is_plain(type_):
            return ctx.draw(name, all_values(type_, field.span), lower_type(type_), field.span)
        case None:
            return None
        case ir.RangeValue() if not isinstance(type_, types.RangeType):
            return ctx.draw(name, said, lower_type(type_))
        case ir.ListValue(elements=elements):
            domain = ir.Choices(span=said.span, type=lower_type(type_), elements=elements)
            return ctx.draw(name, domain, lower_type(type_))
        case _:
            return as_type(said, type_)


LISTS = frozenset({"vehicle.axles", "traffic_participant.intended_infrastructure"})
"""Lists of the library whose elements are fixed one by one."""


def fixed_elements(
    ctx: LoweringContext, constraints: ConstraintLowering, object_: sym.FieldSymbol
) -> Iterator[ir.FieldValue]:
    """Yield the values that constraints fix of elements; their paths have numbers behind the lists.

    Args:
        ctx: The checked program.
        constraints: Constraints of the scenario; those that are found are marked as written.
        object_: The object.
    """
    for constraint in constraints.found.in_force.constraints:
        node = constraint.node
        if not isinstance(node, ast.KeepConstraint) or constraint.is_default:
            continue
        part = node.expression
        if not isinstance(part, ast.Binary) or part.operator is not ast.BinaryOperator.EQUAL:
            continue
        for side, other in ((part.left, part.right), (part.right, part.left)):
            path = _path(ctx, constraints, constraint, object_, side)
            if path is not None:
                value = lower_expression(ctx.at(constraint.place), other)
                constraints.use(constraint)
                if value is not None:
                    yield ir.FieldValue(
                        path=path, value=value, span=value.span, comments=statement_comments(node)
                    )
                break


def _path(
    ctx: LoweringContext,
    constraints: ConstraintLowering,
    constraint: Constraint,
    object_: sym.FieldSymbol,
    expression: ast.Expression,
) -> tuple[str, ...] | None:
    """Return the path of an element or of a member of it; `None` for anything else."""
    members: list[str] = []
    current = expression
    while isinstance(current, ast.MemberAccess):
        symbol = ctx.model.symbol_of(current)
        if not isinstance(symbol, sym.FieldSymbol) or symbol.is_variable:
            return None
        members.insert(0, symbol.name)
        current = current.base
    if not isinstance(current, ast.Index) or not isinstance(current.index, ast.IntegerLiteral):
        return None
    key = constraint.place.locate(current.base)
    if key is None or len(key) != 2 or key[0] is not object_ or _is_whole(constraints, key):
        return None
    field = key[1]
    if not isinstance(field, sym.FieldSymbol) or field.owner is None:
        return None
    if f"{field.owner.name}.{field.name}" not in LISTS:
        return None
    return field.name, str(current.index.value), *members


def _is_whole(constraints: ConstraintLowering, key: Key) -> bool:
    """Whether the list has a value as a whole."""
    about = constraints.found.by_key.get(key, ())
    return any(c.subject == key and c.value is not None for c in about)
