"""Expressions (§7.4)."""

from __future__ import annotations

from enum import Enum
from typing import TypeAlias

from osc2tx.syntax.ast.base import Name, Node, TypeName
from osc2tx_shared.classes import dataclass


class BinaryOperator(Enum):
    """Binary operators, lowest precedence first."""

    IMPLIES = "=>"
    OR = "or"
    AND = "and"
    EQUAL = "=="
    NOT_EQUAL = "!="
    LESS = "<"
    LESS_EQUAL = "<="
    GREATER = ">"
    GREATER_EQUAL = ">="
    IN = "in"
    ADD = "+"
    SUBTRACT = "-"
    MULTIPLY = "*"
    DIVIDE = "/"
    MODULO = "%"


class UnaryOperator(Enum):
    """Prefix operators."""

    NOT = "not"
    NEGATE = "-"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BoolLiteral(Node):
    """`true` or `false`."""

    value: bool


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class IntegerLiteral(Node):
    """A decimal or hexadecimal number; the sign is a prefix operator."""

    value: int


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FloatLiteral(Node):
    """A binary64 number, `inf` and `nan` included."""

    value: float


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PhysicalLiteral(Node):
    """A number with its unit, `35kph`; an integer stays an `int` so that it prints as written."""

    value: int | float
    unit: Name


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StringLiteral(Node):
    """A string, escapes resolved."""

    value: str


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EnumLiteral(Node):
    """`enum!member`; a bare member is a `NameExpression` until its type is known."""

    enum: Name
    member: Name


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class NameExpression(Node):
    """A bare name: field, parameter, label, event, enum member; `inf`/`nan` are literals."""

    name: Name


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ItExpression(Node):
    """`it` (§7.4.1.3)."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MemberAccess(Node):
    """`base.name`."""

    base: Expression
    name: Name


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Cast(Node):
    """`base.as(T)`."""

    base: Expression
    type: TypeName


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TypeTest(Node):
    """`base.is(T)`."""

    base: Expression
    type: TypeName


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Index(Node):
    """`base[index]`."""

    base: Expression
    index: Expression


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Argument(Node):
    """An argument, positional when `name` is missing."""

    name: Name | None
    value: Expression


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Call(Node):
    """`callee(arguments)` inside an expression."""

    callee: Expression
    arguments: tuple[Argument, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Unary(Node):
    """A prefix operator and its operand."""

    operator: UnaryOperator
    operand: Expression


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Binary(Node):
    """A binary operator; chains of one level nest to the left, `=>` to the right."""

    operator: BinaryOperator
    left: Expression
    right: Expression


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Conditional(Node):
    """`condition ? when_true : when_false`."""

    condition: Expression
    when_true: Expression
    when_false: Expression


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ListLiteral(Node):
    """`[a, b]`."""

    elements: tuple[Expression, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RangeLiteral(Node):
    """`[lower .. upper]` or `range(lower, upper)`."""

    lower: Expression
    upper: Expression


Expression: TypeAlias = (
    BoolLiteral
    | IntegerLiteral
    | FloatLiteral
    | PhysicalLiteral
    | StringLiteral
    | EnumLiteral
    | NameExpression
    | ItExpression
    | MemberAccess
    | Cast
    | TypeTest
    | Index
    | Call
    | Unary
    | Binary
    | Conditional
    | ListLiteral
    | RangeLiteral
)
