"""Types and units of values in the IR."""

from __future__ import annotations

from enum import Enum

from osc2tx.diagnostics import Span
from osc2tx_shared.classes import dataclass


class Kind(Enum):
    """The kind of value of an expression."""

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
    """The type of a value.

    Attributes:
        kind: Its kind.
        name: The declared name (`speed`, `vehicle`, `color`, …).
        element: The element type of a list or range.
        members: The members of an enum that the standard library does not have in this form.
    """

    kind: Kind
    name: str
    element: ValueType | None = None
    members: tuple[str, ...] = ()

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


class TrailingComment(str):
    """A comment line that stands behind the first line of a statement; those above come first."""

    __slots__ = ()


class CommentBelow(str):
    """A comment line below a statement, the last of its lines."""

    __slots__ = ()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ExpressionBase:
    """The common base of expressions: a type and a span."""

    span: Span
    type: ValueType


def qualified(owner: str | None, name: str) -> str:
    """Return the name of an action: `vehicle.creep`, or `log` if it belongs to no actor."""
    return name if owner is None else f"{owner}.{name}"
