"""Constraints between open parameters as relations that can be solved.

Parameters that are numbers are symbols: the side of a comparison is a sum of them if its symbol is
one, and the same one whatever values they have.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from osc2tx import ir
from osc2tx.backends.xosc.logical.parameters import OpenParameter
from osc2tx.backends.xosc.report import Inexpressible
from osc2tx.backends.xosc.scopes import Scope, key_of
from osc2tx.backends.xosc.values.constants import Constant, as_number
from osc2tx.support.solving import All, Among, Any, Linear, Relation
from osc2tx.xosc.expressions import Sum, Symbol

NEVER = Any(())
OPPOSITE = {"<": ">=", "<=": ">", ">": "<=", ">=": "<", "==": "!=", "!=": "=="}


def relations_of(
    parameters: Sequence[OpenParameter], scopes: Sequence[Scope], others: Sequence[Scope]
) -> list[Relation]:
    """Return the relations of the constraints in all scopes, and of bounds that are computed.

    Args:
        parameters: The open parameters.
        scopes: A scenario and those that it invokes, in which open parameters are symbols.
        others: The same for other values of them.
    """
    found: list[Relation] = []
    for scope, other in zip(scopes, others, strict=True):
        reader = _Reader(parameters, scope, other)
        found += [reader.relation(each.expression, True) for each in scope.scenario.constraints]
        found += reader.bounds()
    return found


class _Reader:
    """Reads the expressions of one scope."""

    def __init__(self, parameters: Sequence[OpenParameter], scope: Scope, other: Scope) -> None:
        self._values, self._others = scope.values, other.values
        self._keys = {f"${p.name}": p.key for p in parameters}
        by_key = {parameter.key: parameter for parameter in parameters}
        declared = (d for d in scope.scenario.declarations if isinstance(d, ir.Parameter))
        keys = {d.name: key_of(scope.path, d) for d in declared}
        self._open = {name: by_key[key] for name, key in keys.items() if key in by_key}

    def bounds(self) -> Iterator[Relation]:
        """Yield what bounds that are computed from other parameters leave."""
        for parameter in self._open.values():
            if parameter.is_dependent and parameter.range_ is not None:
                own = Sum({f"${parameter.name}": 1.0}, 0.0)
                try:
                    low, high = map(self._sum, (parameter.range_.lower, parameter.range_.upper))
                except Inexpressible:
                    continue
                yield self._not_above(low, own)
                yield self._not_above(own, high)

    def relation(self, expression: ir.Expression, holds: bool) -> Relation:
        """Return what a condition demands that is to hold, or not; where it is unknown, nothing."""
        match expression:
            case ir.Unary(operator="not", operand=operand):
                return self.relation(operand, not holds)
            case ir.Binary(operator="and" | "or" | "=>" as operator, left=left, right=right):
                is_conjunction = (operator == "and") is holds
                parts = (
                    self.relation(left, holds is not (operator == "=>")),
                    self.relation(right, holds),
                )
                return All(parts) if is_conjunction else Any(parts)
            case ir.Binary(operator=operator) if operator in OPPOSITE:
                return self._comparison(expression, operator if holds else OPPOSITE[operator])
            case ir.FieldRef(name=name) if name in self._open and self._open[name].choices:
                return Among(self._open[name].key, lambda value: bool(value) is holds)
        try:
            return Relation() if bool(self._value(expression)) is holds else NEVER
        except Inexpressible:
            return Relation()

    def _comparison(self, expression: ir.Binary, operator: str) -> Relation:
        try:
            left, right = self._sum(expression.left), self._sum(expression.right)
        except Inexpressible:
            return self._membership(expression.left, expression.right, operator)
        match operator:
            case "<" | "<=":
                return self._not_above(left, right, is_strict=operator == "<")
            case ">" | ">=":
                return self._not_above(right, left, is_strict=operator == ">")
        is_strict = operator == "!="
        sides = ((left, right), (right, left))
        parts = [self._not_above(*each, is_strict=is_strict) for each in sides]
        return Any(parts) if is_strict else All(parts)

    def _membership(self, one: ir.Expression, other: ir.Expression, operator: str) -> Relation:
        """Return what a comparison with a member of an enumeration or a text demands."""
        if isinstance(other, ir.FieldRef) and other.name in self._open:
            one, other = other, one
        known = self._open.get(one.name) if isinstance(one, ir.FieldRef) else None
        if known is None or not known.choices or operator not in ("==", "!="):
            return Relation()
        try:
            value = self._value(other)
        except Inexpressible:
            return Relation()
        return Among(known.key, lambda each: (each == value) is (operator == "=="))

    def _value(self, expression: ir.Expression) -> Constant:
        """Return the value of an expression, as a symbol if it is computed from parameters.

        Raises:
            Inexpressible: How depends on them, or it is known during the run alone.
        """
        value = self._values.of(expression)
        if value != self._others.of(expression):
            raise Inexpressible("it depends on open parameters", expression.span)
        return value

    def _sum(self, expression: ir.Expression) -> Sum:
        """Return a number as a sum of parameters.

        Raises:
            Inexpressible: It is no such sum.
        """
        value = self._value(expression)
        number = as_number(value)
        found = value.sum if isinstance(value, Symbol) else Sum({}, number or 0.0)
        if number is None or not found.terms.keys() <= self._keys.keys():
            raise Inexpressible("it is no sum of parameters", expression.span)
        return found

    def _not_above(self, left: Sum, right: Sum, *, is_strict: bool = False) -> Relation:
        """Return the relation `left <= right`, or `left < right`."""
        found = left.plus(right, -1.0)
        weights = {self._keys[name]: weight for name, weight in found.terms.items()}
        return Linear(weights, found.constant, is_strict=is_strict)
