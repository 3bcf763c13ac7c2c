"""Members of structured types, and event specifications (§7.3.5 - §7.3.12, §7.5)."""

from __future__ import annotations

from enum import Enum
from typing import TypeAlias

from osc2tx.syntax.ast.base import Name, Node, Statement, TypeName
from osc2tx.syntax.ast.expressions import Argument, Expression
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LevelCondition(Node):
    """A plain boolean expression: true as long as it holds."""

    expression: Expression


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RiseCondition(Node):
    """`rise(e)`."""

    expression: Expression


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FallCondition(Node):
    """`fall(e)`."""

    expression: Expression


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ElapsedCondition(Node):
    """`elapsed(d)`."""

    duration: Expression


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EveryCondition(Node):
    """`every(period, offset: o)`."""

    period: Expression
    offset: Expression | None


EventCondition: TypeAlias = (
    LevelCondition | RiseCondition | FallCondition | ElapsedCondition | EveryCondition
)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EventSpecification(Node):
    """`@path [as field] [if condition]`, or a condition alone.

    Attributes:
        event: The path after `@` as a `NameExpression` or `MemberAccess`.
        field: The name after `as`.
        condition: The condition; alone when `event` is missing.
    """

    event: Expression | None
    field: Name | None
    condition: EventCondition | None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ParameterSpecification(Node):
    """A formal parameter of a method or event: `name: type = default`."""

    name: Name
    type: TypeName
    default: Expression | None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EventDeclaration(Statement):
    """`event name(parameters) is specification`."""

    name: Name
    parameters: tuple[ParameterSpecification, ...]
    specification: EventSpecification | None


class KeepStrength(Enum):
    """How firm a constraint is (§7.3.11); a plain `keep` is hard."""

    HARD = "hard"
    DEFAULT = "default"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class KeepConstraint(Statement):
    """`keep(expression)`."""

    strength: KeepStrength
    expression: Expression


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RemoveDefault(Statement):
    """`remove_default(parameter)`."""

    parameter: Expression


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CoverageDeclaration(Statement):
    """`cover(…)` or `record(…)`.

    Attributes:
        kind: `"cover"` or `"record"`.
    """

    kind: str
    arguments: tuple[Argument, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ParameterDeclaration(Statement):
    """`a, b: T = default with: constraints`."""

    names: tuple[Name, ...]
    type: TypeName
    default: Expression | None
    constraints: tuple[KeepConstraint | RemoveDefault | CoverageDeclaration, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SampleExpression(Node):
    """`sample(expression, event, default)`, the initial value of a variable."""

    expression: Expression
    event: EventSpecification
    default: Expression | None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class VariableDeclaration(Statement):
    """`var a, b: T = value`."""

    names: tuple[Name, ...]
    type: TypeName
    default: Expression | SampleExpression | None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ExpressionBody(Node):
    """`is expression e`."""

    expression: Expression


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UndefinedBody(Node):
    """`is undefined`."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ExternalBody(Node):
    """`is external a.b(arguments)`."""

    path: tuple[str, ...]
    arguments: tuple[Argument, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MethodDeclaration(Statement):
    """`def name(parameters) -> result is [only] body`."""

    name: Name
    parameters: tuple[ParameterSpecification, ...]
    result: TypeName | None
    is_only: bool
    body: ExpressionBody | UndefinedBody | ExternalBody


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ModifierApplication(Statement):
    """`actor.modifier(arguments)` as a member or in a `with` block."""

    actor: Expression | None
    modifier: Name
    arguments: tuple[Argument, ...]


StructMember: TypeAlias = (
    EventDeclaration
    | ParameterDeclaration
    | VariableDeclaration
    | KeepConstraint
    | RemoveDefault
    | MethodDeclaration
    | CoverageDeclaration
    | ModifierApplication
)
