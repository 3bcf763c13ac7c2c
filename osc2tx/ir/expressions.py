"""Expressions of the IR: what is computed, with every name resolved and every unit known."""

from __future__ import annotations

from enum import Enum
from typing import TypeAlias

from osc2tx.diagnostics import Span
from osc2tx.light_dataclass import dataclass


class Kind(Enum):
    """What sort of value an expression has."""

    BOOL = "bool"
    INTEGER = "int"
    FLOAT = "float"
    STRING = "string"
    QUANTITY = "quantity"
    ENUM = "enum"
    ACTOR = "actor"
    STRUCT = "struct"
    LIST = "list"
    RANGE = "range"


@dataclass(frozen=True, slots=True)
class ValueType:
    """The type of a value; `name` is the declared name (`speed`, `vehicle`, `color`, …)."""

    kind: Kind
    name: str

    def __str__(self) -> str:
        """The declared name."""
        return self.name


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit: `si = value * factor + offset`; `is_standard` if the library declares it."""

    name: str
    factor: float
    offset: float
    is_standard: bool


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ExpressionBase:
    """What all expressions have: a type and the place they come from."""

    span: Span
    type: ValueType


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Literal(ExpressionBase):
    """A truth value, a plain number or a string."""

    value: bool | int | float | str


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Quantity(ExpressionBase):
    """A number with its unit, as it was written."""

    value: int | float
    unit: Unit

    @property
    def si(self) -> float:
        """The value in SI base units."""
        return self.value * self.unit.factor + self.unit.offset


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EnumValue(ExpressionBase):
    """A member of the enum that `type` names."""

    member: str
    value: int


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FieldRef(ExpressionBase):
    """A field of the scenario; `is_variable` if its value changes during a run."""

    name: str
    is_variable: bool = False


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ParameterRef(ExpressionBase):
    """A parameter of the method that the expression is the body of."""

    name: str


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ScenarioSelf(ExpressionBase):
    """The scenario itself, as the object of a call of its own method."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EventArgument(ExpressionBase):
    """The value of a parameter in the occurrence of an event that is being looked at."""

    event: str
    parameter: str


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Attribute(ExpressionBase):
    """A member of an actor or struct, `hero.speed`.

    Attributes:
        base: The object.
        owner: The type that declares the member.
        name: The member.
        is_variable: Whether it changes during a run.
    """

    base: Expression
    owner: str
    name: str
    is_variable: bool


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Argument:
    """An argument of a call; `is_positional` as the source has it."""

    parameter: str
    value: Expression
    is_positional: bool
    span: Span


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MethodCall(ExpressionBase):
    """A method of an actor, a struct or the scenario; `owner` is the type that declares it."""

    base: Expression
    owner: str
    method: str
    arguments: tuple[Argument, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Unary(ExpressionBase):
    """`not` or `-`."""

    operator: str
    operand: Expression


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Binary(ExpressionBase):
    """A binary operator of the language, by its spelling."""

    operator: str
    left: Expression
    right: Expression


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Conditional(ExpressionBase):
    """`condition ? when_true : when_false`."""

    condition: Expression
    when_true: Expression
    when_false: Expression


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ListValue(ExpressionBase):
    """A list."""

    elements: tuple[Expression, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RangeValue(ExpressionBase):
    """A closed range."""

    lower: Expression
    upper: Expression


Expression: TypeAlias = (
    Literal
    | Quantity
    | EnumValue
    | FieldRef
    | ParameterRef
    | ScenarioSelf
    | EventArgument
    | Attribute
    | MethodCall
    | Unary
    | Binary
    | Conditional
    | ListValue
    | RangeValue
)


def children(expression: Expression) -> tuple[Expression, ...]:
    """Return the direct sub-expressions, left to right."""
    match expression:
        case (
            Literal()
            | Quantity()
            | EnumValue()
            | FieldRef()
            | ParameterRef()
            | ScenarioSelf()
            | EventArgument()
        ):
            return ()
        case Attribute(base=base):
            return (base,)
        case MethodCall(base=base, arguments=arguments):
            return (base, *(argument.value for argument in arguments))
        case Unary(operand=operand):
            return (operand,)
        case Binary(left=left, right=right):
            return (left, right)
        case Conditional(condition=condition, when_true=when_true, when_false=when_false):
            return (condition, when_true, when_false)
        case ListValue(elements=elements):
            return elements
        case RangeValue(lower=lower, upper=upper):
            return (lower, upper)


def walk(expression: Expression) -> tuple[Expression, ...]:
    """Return the expression and everything below it, without recursion."""
    found: list[Expression] = []
    pending = [expression]
    while pending:
        current = pending.pop()
        found.append(current)
        pending.extend(reversed(children(current)))
    return tuple(found)


def is_live(expression: Expression) -> bool:
    """Whether the value depends on the state of the world, so that it must be read late."""
    return any(
        isinstance(part, MethodCall | EventArgument)
        or (isinstance(part, Attribute | FieldRef) and part.is_variable)
        for part in walk(expression)
    )
