"""Lists that constraints describe element by element (§7.3.5.2.1).

`keep(l[k] == v)` says that the list has an element `k`. Its size is what `keep(l.size() == n)`
says, else it is just long enough; elements that nothing is said of are open.
"""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx import ir
from osc2tx.analysis.parameter_lookup import Place
from osc2tx.lowering.constraints import ConstraintLowering
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.expressions import lower_expression
from osc2tx.lowering.parameter_domains import all_values, as_type, conjuncts
from osc2tx.lowering.user_fields import is_plain
from osc2tx.lowering.value_types import lower_type
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
    """Return what constraints say of single elements, and of the size."""
    said: dict[int, ir.Expression] = {}
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
    return said, size


def _alike(element: types.Type, said: dict[int, ir.Expression]) -> ir.Expression | None:
    """Return what elements are drawn from of which nothing is said: the same as the first ones."""
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
