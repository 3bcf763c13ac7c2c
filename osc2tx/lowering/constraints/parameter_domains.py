"""Domains of parameters in the IR, with bounds as the source writes them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from osc2tx import ir
from osc2tx.analysis import single_value
from osc2tx.analysis.constraints.conjunctions import conjuncts
from osc2tx.analysis.constraints.constraint import Constraint
from osc2tx.analysis.constraints.domains import Choice, Domain, Interval, Number, Value, close
from osc2tx.analysis.constraints.operation_list import Key, domain_of_type
from osc2tx.analysis.constraints.value_text import unit_of
from osc2tx.diagnostics import Span
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.value_types import lower_type, lower_unit, number_in
from osc2tx.lowering.values.expressions import lower_expression
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass

Op = ast.BinaryOperator

COMPARISONS = (Op.LESS, Op.LESS_EQUAL, Op.GREATER, Op.GREATER_EQUAL)
NOT_STRICT = (Op.LESS_EQUAL, Op.GREATER_EQUAL)
LARGEST_WHOLE = 2**62  # larger bounds of integers are replaced by those of their type


@dataclass(slots=True)
class DomainWriter:
    """Writes values and domains of one parameter.

    Attributes:
        ctx: The checked program.
        key: The parameter.
        type: Its type.
        constraints: Those that mention it.
    """

    ctx: LoweringContext
    key: Key
    type: types.Type
    constraints: Sequence[Constraint]

    def point(self, domain: Domain) -> ir.Expression | None:
        """Return the one value of a domain, as the source has it if it does."""
        value = single_value(domain)
        for authored in (*self._equalities(), *self._bounds()):
            if isinstance(value, int | float) and _is_close(_number(authored), value):
                return authored
            if isinstance(authored, ir.Literal) and authored.value == value:
                return authored
        return None if value is None else self._literal(value)

    def equality(self, but: Sequence[Constraint] = ()) -> ir.Expression | None:
        """Return the value of the parameter in a longer constraint, some left out."""
        return next(self._equalities(but), None)

    def domain(self, domain: Domain) -> ir.Domain | None:
        """Return a domain; `None` if it is all of the type."""
        if isinstance(domain, Choice):
            return self._choices(domain)
        if self._is_natural(domain):
            return None
        lower, upper = (self._bound(bound) for bound in (domain.lower, domain.upper))
        type_ = lower_type(types.RangeType(self.type))
        if lower is not None and upper is not None:
            return ir.RangeValue(span=lower.span, type=type_, lower=lower, upper=upper)
        bound = upper if lower is None else lower
        if bound is None:
            return None
        return ir.HalfRange(span=bound.span, type=type_, bound=bound, is_lower=upper is None)

    @property
    def has_bounds(self) -> bool:
        """Whether the source gives it a constant bound."""
        return any(_number(bound) is not None for bound in self._bounds())

    def relatives(
        self, constraints: Sequence[Constraint]
    ) -> Iterator[tuple[ir.HalfRange, Constraint]]:
        """Yield the bounds that some constraints give, `x >= a`, each with its constraint."""
        for constraint in constraints:
            part = (
                constraint.node.expression
                if isinstance(constraint.node, ast.KeepConstraint)
                else None
            )
            if not isinstance(part, ast.Binary) or part.operator not in NOT_STRICT:
                continue
            for side, other in ((part.left, part.right), (part.right, part.left)):
                if constraint.place.locate(side) != self.key:
                    continue
                bound = next(self._lowered(constraint, other), None)
                if bound is None:
                    continue
                is_lower = (part.operator is Op.GREATER_EQUAL) == (side is part.left)
                type_ = lower_type(types.RangeType(self.type))
                half = ir.HalfRange(span=bound.span, type=type_, bound=bound, is_lower=is_lower)
                yield half, constraint

    def is_constant(self, bounds: ir.RangeValue) -> bool:
        """Whether both bounds are known when compiling."""
        return None not in (_number(bounds.lower), _number(bounds.upper))

    # --- parts ---

    @property
    def _span(self) -> Span:
        """The last constraint; where others settle the value, the parameter itself."""
        return self.constraints[-1].span if self.constraints else self.key[-1].span

    def _is_natural(self, domain: Interval) -> bool:
        whole = domain_of_type(self.type)
        return isinstance(whole, Interval) and (domain.lower, domain.upper) == (
            whole.lower,
            whole.upper,
        )

    def _choices(self, domain: Choice) -> ir.Choices | None:
        if domain.excluded or domain == domain_of_type(self.type):
            return None
        if isinstance(self.type, types.EnumType):
            members = self.type.symbol.members.values()
            found = (m.value for m in members if m.value in domain.values)
            values: list[Value] = list(dict.fromkeys(found))
        else:
            values = sorted(domain.values, key=str)
        elements = tuple(self._literal(value) for value in values)
        return ir.Choices(span=self._span, type=lower_type(self.type), elements=elements)

    def _bound(self, bound: Number) -> ir.Expression | None:
        if math.isinf(bound) or abs(bound) > LARGEST_WHOLE:
            return None
        for authored in self._bounds():
            if _is_close(_number(authored), bound):
                return authored
        return self._literal(bound)

    def _literal(self, value: bool | int | float | str) -> ir.Expression:
        span, type_ = self._span, lower_type(self.type)
        if isinstance(self.type, types.EnumType):
            members = self.type.symbol.members.values()
            member = next(m for m in members if m.value == value)
            return ir.EnumValue(span=span, type=type_, member=member.name, value=member.value)
        if isinstance(self.type, types.PhysicalType) and isinstance(value, int | float):
            unit = self._unit()
            if unit is not None:
                number = number_in(unit, value)
                return ir.Quantity(span=span, type=type_, value=number, unit=lower_unit(unit))
        return ir.Literal(span=span, type=type_, value=value)

    def _unit(self) -> sym.UnitSymbol | None:
        """Return the unit of the constraints; where they name none, the library's for SI."""
        written = unit_of(self.ctx.model, tuple(self.constraints))
        if written is not None and written.type == self.type:
            return written
        plain = (
            unit
            for unit in self.ctx.model.known_units
            if unit.type == self.type
            and unit.origin == "library"
            and (unit.factor, unit.offset) == (1.0, 0.0)
        )
        return min(plain, key=lambda unit: (len(unit.name), unit.name), default=None)

    def _equalities(self, but: Sequence[Constraint] = ()) -> Iterator[ir.Expression]:
        """Yield the values that parts of hard constraints equate with the parameter."""
        for constraint, part in self._parts():
            if part.operator is Op.EQUAL and not constraint.is_default and constraint not in but:
                for side, other in ((part.left, part.right), (part.right, part.left)):
                    if constraint.place.locate(side) == self.key:
                        yield from self._lowered(constraint, other)

    def _bounds(self) -> Iterator[ir.Expression]:
        """Yield the values that the parameter is compared with."""
        for constraint in self.constraints:
            if constraint.subject == self.key and isinstance(constraint.value, ast.RangeLiteral):
                yield from self._lowered(constraint, constraint.value.lower)
                yield from self._lowered(constraint, constraint.value.upper)
        for constraint, part in self._parts():
            sides = ((part.left, part.right), (part.right, part.left))
            others = [other for side, other in sides if constraint.place.locate(side) == self.key]
            for other in others:
                if constraint.place.locate(other) is not None:
                    continue  # no constant, and maybe nothing that has a value here
                if part.operator in COMPARISONS:
                    yield from self._lowered(constraint, other)
                elif part.operator is Op.IN and isinstance(other, ast.RangeLiteral):
                    yield from self._lowered(constraint, other.lower)
                    yield from self._lowered(constraint, other.upper)

    def _parts(self) -> Iterator[tuple[Constraint, ast.Binary]]:
        for constraint in self.constraints:
            if isinstance(constraint.node, ast.KeepConstraint):
                for part in conjuncts(constraint.node.expression):
                    if isinstance(part, ast.Binary):
                        yield constraint, part

    def _lowered(self, constraint: Constraint, node: ast.Expression) -> Iterator[ir.Expression]:
        lowered = lower_expression(self.ctx.at(constraint.place), node)
        if lowered is not None:
            yield as_type(lowered, self.type)


def all_values(type_: types.Type, span: Span) -> ir.Choices | None:
    """Return all values of an enum or of `bool`; `None` for types with more of them."""
    elements: tuple[ir.Expression, ...]
    plain = lower_type(type_)
    if isinstance(type_, types.EnumType):
        elements = tuple(
            ir.EnumValue(span=span, type=plain, member=member.name, value=member.value)
            for member in type_.symbol.members.values()
        )
    elif type_ == types.BOOL:
        elements = tuple(ir.Literal(span=span, type=plain, value=v) for v in (False, True))
    else:
        return None
    return ir.Choices(span=span, type=plain, elements=elements)


def as_type(expression: ir.Expression, type_: types.Type) -> ir.Expression:
    """Return a converted value (§7.4.2.6): a float, or a range of itself."""
    if isinstance(type_, types.RangeType) and expression.type.kind is not ir.Kind.RANGE:
        bound, plain = as_type(expression, type_.element), lower_type(type_)
        return ir.RangeValue(span=expression.span, type=plain, lower=bound, upper=bound)
    is_whole = isinstance(expression, ir.Literal) and type(expression.value) is int
    if is_whole and type_ == types.FLOAT and isinstance(expression, ir.Literal):
        value = float(expression.value)
        return ir.Literal(span=expression.span, type=lower_type(type_), value=value)
    return expression


def written_domain(domain: ir.Domain, type_: types.Type, hard: Domain) -> Domain:
    """Return the least domain that a domain of the IR gives a parameter."""
    whole = domain_of_type(type_)
    match domain:
        case ir.RangeValue(lower=lower, upper=upper):
            bounds = [_number(lower), _number(upper)]
        case ir.HalfRange(bound=bound, is_lower=True):
            bounds = [_number(bound), math.inf]
        case ir.HalfRange(bound=bound):
            bounds = [-math.inf, _number(bound)]
        case ir.Choices():
            return hard if isinstance(hard, Choice) else whole
    if not isinstance(whole, Interval) or None in bounds:
        return whole
    low, high = sorted(bound for bound in bounds if bound is not None)
    return Interval(max(low, whole.lower), min(high, whole.upper))


def _number(expression: ir.Expression) -> Number | None:
    """Return the value of a constant number in SI; `None` for anything else."""
    match expression:
        case ir.Quantity():
            return expression.si
        case ir.Literal(value=bool() | str()):
            return None
        case ir.Literal(value=int() | float() as value):
            return value
        case ir.Unary(operator="-", operand=operand):
            number = _number(operand)
            return None if number is None else -number
        case _:
            return None


def _is_close(first: Number | None, second: Number) -> bool:
    return first is not None and close(first, second)
