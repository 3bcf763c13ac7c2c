"""Expressions of the IR: what is computed, with every name resolved and every unit known."""

from __future__ import annotations

from typing import TypeAlias

from osc2tx.diagnostics import Span
from osc2tx.ir.operations import (
    Choices,
    Conversion,
    Downcast,
    Element,
    HalfRange,
    Index,
    ListOperation,
    Lookup,
    OwnShape,
    TypeTest,
)
from osc2tx.ir.values import ExpressionBase, Unit
from osc2tx.support.light_dataclass import dataclass


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
class InvokedValue(ExpressionBase):
    """A parameter of a scenario that is invoked with a label, known once that stands."""

    label: str
    name: str


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
    """A method of an object, a plain value or the scenario.

    Attributes:
        base: The object.
        owner: The type that declares the method.
        method: Its name.
        arguments: In source order.
        is_pure: The result depends on object and arguments alone, not on the world.
        needs_no_object: The result depends on the arguments alone.
    """

    base: Expression
    owner: str
    method: str
    arguments: tuple[Argument, ...]
    is_pure: bool = False
    needs_no_object: bool = False


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
    """A list; what an element that is a list itself holds belongs to it (§7.4.2.7)."""

    elements: tuple[Expression, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RangeValue(ExpressionBase):
    """A closed range."""

    lower: Expression
    upper: Expression


Domain: TypeAlias = RangeValue | HalfRange | Choices
"""What a parameter may be."""

Expression: TypeAlias = (
    Literal
    | Quantity
    | EnumValue
    | FieldRef
    | ParameterRef
    | ScenarioSelf
    | EventArgument
    | InvokedValue
    | Attribute
    | MethodCall
    | Unary
    | Binary
    | Conditional
    | ListValue
    | RangeValue
    | HalfRange
    | Choices
    | Element
    | ListOperation
    | Index
    | Conversion
    | Lookup
    | TypeTest
    | Downcast
    | OwnShape
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
            | InvokedValue()
            | Element()
        ):
            return ()
        case Attribute(base=base):
            return (base,)
        case MethodCall(base=base, arguments=arguments):
            values = tuple(argument.value for argument in arguments)
            return values if expression.needs_no_object else (base, *values)
        case ListOperation(base=base, argument=argument):
            return (base,) if argument is None else (base, argument)
        case Index(base=base, index=index):
            return (base, index)
        case (
            Unary(operand=operand)
            | Conversion(operand=operand)
            | Lookup(operand=operand)
            | TypeTest(operand=operand)
            | Downcast(operand=operand)
            | OwnShape(operand=operand)
        ):
            return (operand,)
        case Binary(left=left, right=right):
            return (left, right)
        case Conditional(condition=condition, when_true=when_true, when_false=when_false):
            return (condition, when_true, when_false)
        case ListValue(elements=elements) | Choices(elements=elements):
            return elements
        case HalfRange(bound=bound):
            return (bound,)
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
        isinstance(part, EventArgument)
        or (isinstance(part, MethodCall) and not part.is_pure)
        or (isinstance(part, Attribute | FieldRef) and part.is_variable)
        for part in walk(expression)
    )
