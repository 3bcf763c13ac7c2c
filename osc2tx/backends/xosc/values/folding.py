"""Constant folding: the values of expressions that do not change during a run.

Constants and the values of parameters are folded. A parameter that may be anything in a range is
what is given for it, a number or a `Symbol`, else the middle.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from copy import copy

from osc2tx import ir
from osc2tx.backends.xosc.values.constants import Bounds, Constant, Member, MethodResult, Named
from osc2tx.backends.xosc.values.objects import Objects, UserTypes
from osc2tx.losses.entries import Inexpressible
from osc2tx.xosc.expressions import Symbol
from osc2tx.xosc.numbers import Noted

MAKERS = frozenset(
    {
        "create_odr_point",
        "create_path",
        "create_route",
        "create_path_odr_points",
        "create_path_route_points",
        "create_route_point",
        "create_trajectory",
        "create_trajectory_odr_points",
        "create_trajectory_route_points",
        "create_xyz_point",
        "local_to_unix_time",
        "odr_to_route_point",
        "resolve_relative_path",
        "resolve_relative_trajectory",
        "semantic_state_to_state",
    }
)
"""Methods whose result is the same at any time."""

MOST_CALLS = 50
"""Methods that call each other, at most; a method may call itself for ever."""

_ARITHMETIC: Mapping[str, Callable[[float, float], float]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
    "%": operator.mod,
}
_COMPARISONS: Mapping[str, Callable[[float, float], bool]] = {
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
}

_NAMES = (ir.FieldRef, ir.ParameterRef)

LARGEST = 1e15
"""What is computed may not be larger, in SI units, as what is written."""


class Values(Objects):
    """Folds expressions of one scenario.

    Args:
        scenario: The scenario.
        types: Those that the files of its module declare.
        given: Values of fields, as an invocation hands them in.
        hidden: Why the values of fields from outside are only known during the run.

    Attributes:
        sizes: What actors are like where the scenario does not say it.
    """

    def __init__(
        self,
        scenario: ir.Scenario,
        types: UserTypes,
        given: Mapping[str, Constant],
        hidden: Mapping[str, Inexpressible],
    ) -> None:
        super().__init__(scenario, types)
        self._methods = {m.name: m for m in scenario.methods}
        self._given = given
        self._hidden = hidden
        self._arguments: Mapping[str, Constant] = {}  # of the method that is looked into
        self._depth = 0
        self.sizes: dict[str, Mapping[tuple[str, ...], float]] = {}

    def is_given(self, name: str) -> bool:
        """Whether a field has a value from outside."""
        return name in self._given or name in self._hidden

    def given_below(self, path: str) -> dict[str, Constant]:
        """Return what is handed in for an invocation of the scenario, by path below it."""
        given = self._given.items()
        return {n.removeprefix(path): value for n, value in given if n.startswith(path)}

    def number(self, expression: ir.Expression) -> float:
        """Return a number, in SI units, with the names in the expression as a note."""
        value = self.of(expression)
        number = self._plain_number(expression, value)
        if isinstance(value, (Bounds, Symbol)):
            return number
        is_named = any(isinstance(part, _NAMES) for part in ir.walk(expression))
        return Noted(number, expression.span.text) if is_named else number

    def _operand(self, expression: ir.Expression) -> float:
        """Return the same without a note: parts of expressions are not walked again for one."""
        return self._plain_number(expression, self.of(expression))

    def _plain_number(self, expression: ir.Expression, value: Constant) -> float:
        if isinstance(value, Bounds):
            return 0.5 * (value.lower + value.upper)
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise Inexpressible(f"`{expression.span.text}` is no number", expression.span)
        if isinstance(value, Symbol):
            return value
        if not isinstance(expression, ir.Literal) and not abs(value) <= LARGEST:
            reason = f"`{expression.span.text}` is {value:g}, which no world has"
            raise Inexpressible(reason, expression.span)
        return float(value)

    def bounds(self, expression: ir.Expression) -> tuple[float, float]:
        """Return the ends of a range, or twice the same number, in SI units."""
        value = self.of(expression)
        if isinstance(value, Bounds):
            return value.lower, value.upper
        number = self.number(expression)
        return number, number

    def actor(self, expression: ir.Expression) -> str:
        """Return the name of an actor."""
        value = self.of(expression)
        if not isinstance(value, Named):
            raise Inexpressible(f"`{expression.span.text}` is no actor", expression.span)
        return value.name

    def of(self, expression: ir.Expression) -> Constant:
        """Return the value of an expression."""
        match expression:
            case ir.Literal():
                return expression.value
            case ir.Quantity():
                return expression.si
            case ir.EnumValue(member=member):
                return Member(expression.type.name, member)
            case ir.FieldRef():
                return self._field(expression)
            case ir.ParameterRef(name=name) if name in self._arguments:
                return self._arguments[name]
            case ir.Attribute(base=base, name=name):
                return self._attribute(expression, base, name)
            case ir.Unary(operator=sign, operand=operand):
                return not self.of(operand) if sign == "not" else -self._operand(operand)
            case ir.Binary():
                return self._binary(expression)
            case ir.Conditional(condition=condition, when_true=yes, when_false=no):
                return self.of(yes if self.of(condition) else no)
            case ir.ListValue(elements=elements):
                return tuple(self.of(each) for each in elements)
            case ir.Index(base=base, index=index):
                return self._element(expression, base, index)
            case ir.ListOperation(base=base, operator=ir.ListOperator.SIZE):
                return len(self._list(base))
            case ir.RangeValue(lower=lower, upper=upper):
                return Bounds(self.number(lower), self.number(upper))
            case ir.Conversion(operand=operand):
                value = self.number(operand)
                return int(value) if expression.type.kind is ir.Kind.INTEGER else value
            case ir.MethodCall(base=ir.FieldRef(name=owner), method=method) if method in MAKERS:
                given = ((each.parameter, self.of(each.value)) for each in expression.arguments)
                return MethodResult(method, owner, tuple(given))
            case ir.MethodCall(base=ir.ScenarioSelf(), method=method) if method in self._methods:
                called = self._methods[method]
                pairs = zip(called.parameters, expression.arguments, strict=False)
                given_by_name = {a.parameter or p.name: self.of(a.value) for p, a in pairs}
                return self.result_of(called, given_by_name)
        raise Inexpressible(
            f"`{expression.span.text}` is only known during the run, and OpenSCENARIO XML"
            " does not compute",
            expression.span,
        )

    def _field(self, reference: ir.FieldRef) -> Constant:
        if reference.name in self._hidden:
            raise Inexpressible(self._hidden[reference.name].reason, reference.span)
        if reference.name in self._given:
            return self._given[reference.name]
        declaration = self._declared.get(reference.name)
        match declaration:
            case ir.Struct(value=made) if made is not None:
                return self.of(made)
            case ir.Actor(name=name) | ir.Struct(name=name):
                return Named(name)
            case ir.Parameter(value=value, domain=domain):
                if value is not None:
                    return self.of(value)
                if isinstance(domain, ir.RangeValue):
                    low, high = self.number(domain.lower), self.number(domain.upper)
                    return 0.5 * (low + high)
                if isinstance(domain, ir.Choices):
                    first = self.of(domain.elements[0])
                    return first[0] if isinstance(first, tuple) and first else first
            case ir.Variable(value=value, sample=None) if value is not None:
                return self.of(value)
        raise Inexpressible(
            f"the value of `{reference.name}` is only known during the run", reference.span
        )

    def _attribute(self, expression: ir.Expression, base: ir.Expression, name: str) -> Constant:
        path = [name]
        while isinstance(base, ir.Attribute):
            path.insert(0, base.name)
            base = base.base
        if isinstance(base, (ir.FieldRef, ir.ParameterRef, ir.Index)):
            owner = self.of(base)
            if isinstance(owner, Named):
                value = self.field(owner.name, *path)
                if value is None:
                    value = self.sizes.get(owner.name, {}).get(tuple(path))
                if value is not None:
                    return value
        raise Inexpressible(
            f"`{expression.span.text}` is only known during the run", expression.span
        )

    def _list(self, expression: ir.Expression) -> tuple[Constant, ...]:
        value = self.of(expression)
        if not isinstance(value, tuple):
            raise Inexpressible(f"`{expression.span.text}` is no list", expression.span)
        return value

    def _element(
        self, expression: ir.Expression, base: ir.Expression, index: ir.Expression
    ) -> Constant:
        elements, number = self._list(base), int(self.number(index))
        if not 0 <= number < len(elements):
            raise Inexpressible(f"`{expression.span.text}`: the list is shorter", expression.span)
        return elements[number]

    def result_of(self, method: ir.Method, given: Mapping[str, Constant]) -> Constant:
        """Return what a method of the scenario returns for arguments by parameter."""
        if method.expression is None or self._depth == MOST_CALLS:
            text = f"what `{method.name}` returns is only known during the run"
            raise Inexpressible(text, method.span)
        arguments = {p.name: self.of(p.default) for p in method.parameters if p.default is not None}
        arguments.update(given)
        inner = copy(self)
        inner._arguments, inner._depth = arguments, self._depth + 1
        return inner.of(method.expression)

    def _binary(self, expression: ir.Binary) -> Constant:
        name = expression.operator
        if name in ("and", "or", "=>"):
            left = bool(self.of(expression.left))
            if name == "=>":
                return not left or bool(self.of(expression.right))
            decided = left if name == "or" else not left
            return left if decided else bool(self.of(expression.right))
        if name in ("==", "!="):
            same = _plain(self.of(expression.left)) == _plain(self.of(expression.right))
            return same is (name == "==")
        left_number, right_number = self._operand(expression.left), self._operand(expression.right)
        if name in _COMPARISONS:
            return _COMPARISONS[name](left_number, right_number)
        if name not in _ARITHMETIC:
            raise Inexpressible(f"operator `{name}` has no counterpart", expression.span)
        if name in "/%" and float(right_number) == 0.0:  # a symbol equals no number
            raise Inexpressible(f"`{expression.span.text}` divides by zero", expression.span)
        return _ARITHMETIC[name](left_number, right_number)


def _plain(value: Constant) -> Constant:
    """Return the nominal value of a symbol: as numbers of documents, only equal texts are equal."""
    return float(value) if isinstance(value, Symbol) else value
