"""Values of expressions that do not change during a run.

Constants and the values of parameters are folded. A parameter that may be anything in a range is
what is given for it, a number or a `Symbol`, else the middle.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping
from typing import TypeAlias

from osc2tx import ir
from osc2tx.backends.xosc.report import Inexpressible
from osc2tx.backends.xosc.symbols import Symbol
from osc2tx.light_dataclass import dataclass


@dataclass(frozen=True, slots=True)
class Member:
    """A member of an enum."""

    enum: str
    name: str


@dataclass(frozen=True, slots=True)
class Named:
    """An actor or struct of the scenario, by its name."""

    name: str


@dataclass(frozen=True, slots=True)
class Bounds:
    """A range."""

    lower: float
    upper: float


@dataclass(frozen=True, slots=True)
class Made:
    """What a method of the library makes of constants: a point, a path, states of lamps.

    Attributes:
        method: The method.
        owner: Name of the actor or struct whose method it is.
        arguments: By parameter.
    """

    method: str
    owner: str
    arguments: tuple[tuple[str, Constant], ...]

    def get(self, parameter: str) -> Constant | None:
        """Return an argument."""
        return dict(self.arguments).get(parameter)


Constant: TypeAlias = (
    "bool | int | float | str | Member | Named | Bounds | Made | tuple[Constant, ...]"
)

MAKERS = frozenset(
    {
        "create_odr_point",
        "create_path",
        "create_path_odr_points",
        "create_path_route_points",
        "create_route_point",
        "create_trajectory",
        "create_trajectory_odr_points",
        "create_trajectory_route_points",
        "create_xyz_point",
        "odr_to_route_point",
        "resolve_relative_path",
        "resolve_relative_trajectory",
        "semantic_state_to_state",
    }
)
"""Methods whose result is the same at any time."""

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


class Values:
    """Folds expressions of one scenario.

    Args:
        scenario: The scenario.
        given: Values of fields that an invocation hands in.
    """

    def __init__(self, scenario: ir.Scenario, given: Mapping[str, Constant] | None = None) -> None:
        self._declared = {d.name: d for d in scenario.declarations}
        self._given = dict(given or {})

    def is_given(self, name: str) -> bool:
        """Whether a field has a value from outside."""
        return name in self._given

    def number(self, expression: ir.Expression) -> float:
        """Return a number, in SI units.

        Raises:
            Inexpressible: It is none, or is only known during the run.
        """
        value = self.of(expression)
        if isinstance(value, Bounds):
            return 0.5 * (value.lower + value.upper)
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise Inexpressible(f"`{expression.span.text}` is no number", expression.span)
        return value if isinstance(value, Symbol) else float(value)

    def actor(self, expression: ir.Expression) -> str:
        """Return the name of an actor.

        Raises:
            Inexpressible: It is only known during the run.
        """
        value = self.of(expression)
        if not isinstance(value, Named):
            raise Inexpressible(f"`{expression.span.text}` is no actor", expression.span)
        return value.name

    def field(self, name: str, path: tuple[str, ...]) -> Constant | None:
        """Return what a constraint fixes about an actor or struct; `None` if nothing does."""
        declaration = self._declared.get(name)
        if isinstance(declaration, (ir.Actor, ir.Struct)):
            for value in declaration.values:
                if value.path == path:
                    return self.of(value.value)
        return None

    def type_of(self, name: str) -> str:
        """Return the type of an actor or struct."""
        declaration = self._declared.get(name)
        return declaration.type if isinstance(declaration, (ir.Actor, ir.Struct)) else ""

    def is_library_shape(self, name: str) -> bool:
        """Whether a struct is a course that the library describes (§8.9.22)."""
        declaration = self._declared.get(name)
        return isinstance(declaration, ir.Struct) and declaration.type.startswith("common_")

    def of(self, expression: ir.Expression) -> Constant:
        """Return the value of an expression.

        Raises:
            Inexpressible: It is only known during the run.
        """
        match expression:
            case ir.Literal(value=value):
                return value
            case ir.Quantity():
                return expression.si
            case ir.EnumValue(member=member):
                return Member(expression.type.name, member)
            case ir.FieldRef():
                return self._field(expression)
            case ir.Attribute(base=base, name=name):
                return self._attribute(expression, base, name)
            case ir.Unary(operator=sign, operand=operand):
                return self._unary(sign, operand)
            case ir.Binary():
                return self._binary(expression)
            case ir.Conditional(condition=condition, when_true=yes, when_false=no):
                return self.of(yes if self.of(condition) else no)
            case ir.ListValue(elements=elements):
                return tuple(self.of(each) for each in elements)
            case ir.RangeValue(lower=lower, upper=upper):
                return Bounds(self.number(lower), self.number(upper))
            case ir.Conversion(operand=operand):
                return self._converted(expression, operand)
            case ir.MethodCall(base=ir.FieldRef(name=owner), method=method) if method in MAKERS:
                given = ((each.parameter, self.of(each.value)) for each in expression.arguments)
                return Made(method, owner, tuple(given))
        raise Inexpressible(
            f"`{expression.span.text}` is only known during the run, and OpenSCENARIO XML"
            " does not compute",
            expression.span,
        )

    def _field(self, reference: ir.FieldRef) -> Constant:
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
                    return self.of(domain.elements[0])
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
        if isinstance(base, ir.FieldRef):
            owner = self.of(base)
            if isinstance(owner, Named):
                value = self.field(owner.name, tuple(path))
                if value is not None:
                    return value
        raise Inexpressible(
            f"`{expression.span.text}` is only known during the run", expression.span
        )

    def _unary(self, sign: str, operand: ir.Expression) -> Constant:
        return not self.of(operand) if sign == "not" else -self.number(operand)

    def _binary(self, expression: ir.Binary) -> Constant:
        name = expression.operator
        if name in ("and", "or", "=>"):
            left = bool(self.of(expression.left))
            if name == "=>":
                return not left or bool(self.of(expression.right))
            decided = left if name == "or" else not left
            return left if decided else bool(self.of(expression.right))
        if name in ("==", "!="):
            same = self.of(expression.left) == self.of(expression.right)
            return same is (name == "==")
        left_number, right_number = self.number(expression.left), self.number(expression.right)
        if name in _COMPARISONS:
            return _COMPARISONS[name](left_number, right_number)
        if name not in _ARITHMETIC:
            raise Inexpressible(f"operator `{name}` has no counterpart", expression.span)
        if name in "/%" and right_number == 0.0:
            raise Inexpressible(f"`{expression.span.text}` divides by zero", expression.span)
        return _ARITHMETIC[name](left_number, right_number)

    def _converted(self, expression: ir.Expression, operand: ir.Expression) -> Constant:
        value = self.number(operand)
        return int(value) if expression.type.kind is ir.Kind.INTEGER else value
