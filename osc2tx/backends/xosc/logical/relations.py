"""Constraints between open parameters as relations that can be solved."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TypeAlias

from osc2tx import ir
from osc2tx.backends.xosc.logical.parameters import OpenParameter
from osc2tx.backends.xosc.report import Inexpressible
from osc2tx.backends.xosc.scopes import Scope, key_of
from osc2tx.support.solving import All, Among, Any, Linear, Relation

Sum: TypeAlias = tuple[dict[str, float], float]
"""Weights by the key of a parameter, and what is added."""

NEVER = Any(())
OPPOSITE = {"<": ">=", "<=": ">", ">": "<=", ">=": "<", "==": "!=", "!=": "=="}


def relations_of(scopes: Sequence[Scope], parameters: Sequence[OpenParameter]) -> list[Relation]:
    """Return the relations of the constraints in all scopes, and of bounds that are computed."""
    found: list[Relation] = []
    for scope in scopes:
        reader = _Reader(scope, parameters)
        found += [reader.relation(each.expression, True) for each in scope.scenario.constraints]
        found += reader.bounds(parameters)
    return found


class _Reader:
    """Reads the expressions of one scope."""

    def __init__(self, scope: Scope, parameters: Sequence[OpenParameter]) -> None:
        self._scope = scope
        self._declared = {
            d.name: d for d in scope.scenario.declarations if isinstance(d, ir.Parameter)
        }
        by_key = {parameter.key: parameter for parameter in parameters}
        keys = {name: key_of(scope.path, d) for name, d in self._declared.items()}
        self._open = {name: by_key[key] for name, key in keys.items() if key in by_key}

    def bounds(self, parameters: Sequence[OpenParameter]) -> Iterator[Relation]:
        """Yield what bounds that are computed from other parameters leave."""
        for parameter in self._open.values():
            range_ = parameter.range_
            if not parameter.is_dependent or range_ is None:
                continue
            low, high, own = self._sum(range_.lower), self._sum(range_.upper), {parameter.key: 1.0}
            if low is not None and high is not None:
                yield _not_above(low, (own, 0.0), is_strict=False)
                yield _not_above((own, 0.0), high, is_strict=False)

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
            if not self._is_open(expression) and bool(self._scope.values.of(expression)) != holds:
                return NEVER
        except Inexpressible:
            pass  # known during the run alone
        return Relation()

    def _comparison(self, expression: ir.Binary, operator: str) -> Relation:
        left, right = self._sum(expression.left), self._sum(expression.right)
        if left is None or right is None:
            return self._equality(expression, operator)
        match operator:
            case "<" | "<=":
                return _not_above(left, right, is_strict=operator == "<")
            case ">" | ">=":
                return _not_above(right, left, is_strict=operator == ">")
            case "==":
                sides = ((left, right), (right, left))
                return All([_not_above(*each, is_strict=False) for each in sides])
        sides = ((left, right), (right, left))
        return Any([_not_above(*each, is_strict=True) for each in sides])

    def _equality(self, expression: ir.Binary, operator: str) -> Relation:
        """Return what a comparison with a member of an enumeration or a text demands."""
        for one, other in (
            (expression.left, expression.right),
            (expression.right, expression.left),
        ):
            known = isinstance(one, ir.FieldRef) and self._open.get(one.name)
            if known and known.choices and operator in ("==", "!=") and not self._is_open(other):
                return self._is_value(known, other, operator == "==")
        return Relation()

    def _is_value(self, known: OpenParameter, other: ir.Expression, holds: bool) -> Relation:
        try:
            value = self._scope.values.of(other)
        except Inexpressible:
            return Relation()
        return Among(known.key, lambda each: (each == value) is holds)

    def _sum(self, expression: ir.Expression) -> Sum | None:
        """Return a number as a sum of parameters; None if it is no such sum."""
        match expression:
            case ir.FieldRef(name=name) if name in self._open:
                parameter = self._open[name]
                return ({parameter.key: 1.0}, 0.0) if _is_number(parameter) else None
            case ir.FieldRef(name=name) if self._computed(name) is not None:
                return self._sum(self._computed(name) or expression)
            case ir.Unary(operator="-", operand=operand):
                return _scaled(self._sum(operand), -1.0)
            case ir.Binary(operator="+" | "-" as operator, left=left, right=right):
                return _added(
                    self._sum(left), _scaled(self._sum(right), 1.0 if operator == "+" else -1.0)
                )
            case ir.Binary(operator="*" | "/" as operator, left=left, right=right):
                one, other = self._sum(left), self._sum(right)
                if operator == "*" and one is not None and not one[0]:
                    one, other = other, one
                if other is None or other[0] or (operator == "/" and other[1] == 0.0):
                    return None
                return _scaled(one, other[1] if operator == "*" else 1.0 / other[1])
            case ir.Conversion(operand=operand) if expression.type.kind is not ir.Kind.INTEGER:
                return self._sum(operand)
        if self._is_open(expression):
            return None
        try:
            return {}, float(self._scope.values.number(expression))
        except Inexpressible:
            return None

    def _computed(self, name: str) -> ir.Expression | None:
        """Return the expression of a parameter that the scenario computes from others."""
        declared = self._declared.get(name)
        return None if declared is None or self._scope.values.is_given(name) else declared.value

    def _is_open(self, expression: ir.Expression) -> bool:
        """Whether a value depends on open parameters, or on what an invocation hands in."""
        for part in ir.walk(expression):
            if not isinstance(part, ir.FieldRef):
                continue
            is_handed_in = bool(self._scope.path) and self._scope.values.is_given(part.name)
            computed = self._computed(part.name)
            if part.name in self._open or is_handed_in:
                return True
            if computed is not None and self._is_open(computed):
                return True
        return False


def _is_number(parameter: OpenParameter) -> bool:
    return parameter.node is None and parameter.change is None and parameter.is_number


def _scaled(sum_: Sum | None, factor: float) -> Sum | None:
    if sum_ is None:
        return None
    return {key: weight * factor for key, weight in sum_[0].items()}, sum_[1] * factor


def _added(one: Sum | None, other: Sum | None) -> Sum | None:
    if one is None or other is None:
        return None
    weights = dict(one[0])
    for key, weight in other[0].items():
        weights[key] = weights.get(key, 0.0) + weight
    return weights, one[1] + other[1]


def _not_above(left: Sum, right: Sum, *, is_strict: bool) -> Relation:
    """Return the relation `left <= right`, or `left < right`."""
    weights, rest = _added(left, _scaled(right, -1.0)) or ({}, 0.0)
    present: Mapping[str, float] = {key: weight for key, weight in weights.items() if weight != 0.0}
    return Linear(present, rest, is_strict=is_strict)
