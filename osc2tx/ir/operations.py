"""Expressions over lists, domains and types."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING

from osc2tx.ir.values import ExpressionBase
from osc2tx.support.light_dataclass import dataclass

if TYPE_CHECKING:
    from osc2tx.ir.expressions import Expression


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
    """What a table has for a value: an enum member for its number, or the other way round."""

    operand: Expression
    table: tuple[tuple[int | str, int | str], ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TypeTest(ExpressionBase):
    """Whether an actor is of the actor type `tested`, or one derived from it."""

    operand: Expression
    tested: str


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Downcast(ExpressionBase):
    """An actor as one of the more special type that `type` names; an error if it is none."""

    operand: Expression


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class OwnShape(ExpressionBase):
    """A shape with methods of the scenario's own, as the course of what a modifier controls.

    Attributes:
        operand: The object.
        kind: The shape of the library that it derives from, `any_speed_shape`.
        compute: Name of its method `compute`, as that of the scenario.
        duration: Likewise; `None`: it goes on as long as the action.
    """

    operand: Expression
    kind: str
    compute: str
    duration: str | None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HalfRange(ExpressionBase):
    """A range with one bound; `is_lower` if that is the lower one."""

    bound: Expression
    is_lower: bool


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Choices(ExpressionBase):
    """A set of values of which one holds."""

    elements: tuple[Expression, ...]
