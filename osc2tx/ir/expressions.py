"""Expressions of the IR, with resolved names and known units."""

from __future__ import annotations

from enum import Enum
from typing import TypeAlias

from osc2tx.diagnostics import Span
from osc2tx.ir.values import ExpressionBase, Unit
from osc2tx_shared.classes import dataclass


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
    """The value of a parameter in the occurrence of an event that is being looked at.

    Attributes:
        event: The event, below the labels of invocations.
        parameter: The parameter.
        owner: Key of the invoked scenario that has the event, if one has.
    """

    event: str
    parameter: str
    owner: str | None = None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class InvokedValue(ExpressionBase):
    """A parameter of a scenario that is invoked with a label, known after its invocation."""

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
    """A list; the elements of an element that is a list belong to it (§7.4.2.7)."""

    elements: tuple[Expression, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RangeValue(ExpressionBase):
    """A closed range."""

    lower: Expression
    upper: Expression


class ListOperator(Enum):
    """The operators of lists (§7.4.2.7)."""

    SIZE = "size"
    FILTER = "filter"
    FIRST_INDEX = "first_index"
    COUNT = "count"
    HAS = "has"
    MAP = "map"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Element(ExpressionBase):
    """The element that an operator of a list looks at; `depth` counts those around it."""

    depth: int


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ListOperation(ExpressionBase):
    """An operator of a list; `argument` is computed for each element."""

    base: Expression
    operator: ListOperator
    argument: Expression | None
    depth: int


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Index(ExpressionBase):
    """An element of a list, counted from zero."""

    base: Expression
    index: Expression


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Conversion(ExpressionBase):
    """A number as a number of another type, the one that `type` names."""

    operand: Expression


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Lookup(ExpressionBase):
    """The entry of a table for a value: an enum member for its number, or vice versa."""

    operand: Expression
    table: tuple[tuple[int | str, int | str], ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TypeTest(ExpressionBase):
    """Whether an actor is of the actor type `tested`, or one derived from it."""

    operand: Expression
    tested: str


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Downcast(ExpressionBase):
    """An object as one of the more special type that `type` names; an error if it is none."""

    operand: Expression


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UserShape(ExpressionBase):
    """A shape with methods of the scenario, as the profile of the quantity of a modifier.

    Attributes:
        operand: The object.
        kind: The shape of the library that it derives from, `any_speed_shape`.
        compute: Name of its method `compute` in the scenario.
        duration: Likewise; `None`: it lasts as long as the action.
    """

    operand: Expression
    kind: str
    compute: str
    duration: str | None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Undefined(ExpressionBase):
    """The body of a method without implementation: an error when it is invoked (§7.3.7.1)."""

    method: str


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HalfRange(ExpressionBase):
    """A range with one bound; `is_lower` if that is the lower one."""

    bound: Expression
    is_lower: bool


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Choices(ExpressionBase):
    """A set of alternative values.

    Attributes:
        elements: The values; a list denotes its elements.
    """

    elements: tuple[Expression, ...]


Domain: TypeAlias = RangeValue | HalfRange | Choices
"""The possible values of a parameter."""

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
    | UserShape
    | Undefined
)
