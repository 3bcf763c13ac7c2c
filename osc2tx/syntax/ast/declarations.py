"""Files, imports, namespaces and the declarations at file level (§7.2.2.1, §7.7)."""

from __future__ import annotations

from typing import TypeAlias

from osc2tx.syntax.ast.base import BehaviorName, Name, Node, Statement
from osc2tx.syntax.ast.behaviors import BehaviorSpecification
from osc2tx.syntax.ast.expressions import BoolLiteral, EnumLiteral, NameExpression
from osc2tx.syntax.ast.members import MethodDeclaration, ParameterDeclaration, StructMember
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Import(Statement):
    """`import "uri"` or `import a.b.c`; exactly one of the two is set."""

    uri: str | None
    module: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class NamespaceStatement(Statement):
    """`namespace name use others`."""

    name: str
    uses: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UseStatement(Statement):
    """`use a.b` on its own line: not in the standard, but in files one meets."""

    path: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ExportItem(Node):
    """`name`, `ns::name`, `*` or `ns::*`; `name` is `None` for the star forms."""

    namespace: str | None
    name: str | None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ExportStatement(Statement):
    """`export items`."""

    items: tuple[ExportItem, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SiExponent(Node):
    """`m: 1` inside `SI(…)`."""

    base: str
    exponent: int


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PhysicalTypeDeclaration(Statement):
    """`type name is SI(exponents)`."""

    name: Name
    exponents: tuple[SiExponent, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UnitDeclaration(Statement):
    """`unit name of type is SI(exponents, factor: f, offset: o)`."""

    name: Name
    physical_type: Name
    exponents: tuple[SiExponent, ...]
    factor: float
    offset: float


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EnumMember(Statement):
    """A member with its explicit value, a number or another member (2.2)."""

    name: Name
    value: int | EnumLiteral | NameExpression | None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EnumDeclaration(Statement):
    """`enum name: [members]`."""

    name: Name
    members: tuple[EnumMember, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class InheritanceCondition(Node):
    """`(field == value)` of a conditional inheritance."""

    field: Name
    value: EnumLiteral | NameExpression | BoolLiteral


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StructDeclaration(Statement):
    """`struct name inherits base(condition):`."""

    name: Name
    base: Name | None
    condition: InheritanceCondition | None
    members: tuple[StructMember, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ActorDeclaration(Statement):
    """`actor name inherits base(condition):`."""

    name: Name
    base: Name | None
    condition: InheritanceCondition | None
    members: tuple[StructMember, ...]


BehaviorBodyMember: TypeAlias = StructMember | BehaviorSpecification


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ScenarioDeclaration(Statement):
    """`scenario [actor.]name inherits base(condition):`."""

    name: BehaviorName
    base: BehaviorName | None
    condition: InheritanceCondition | None
    members: tuple[BehaviorBodyMember, ...]
    end_comments: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ActionDeclaration(Statement):
    """`action [actor.]name inherits base(condition):`."""

    name: BehaviorName
    base: BehaviorName | None
    condition: InheritanceCondition | None
    members: tuple[BehaviorBodyMember, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ModifierDeclaration(Statement):
    """`modifier [actor.]name of behavior:`."""

    name: BehaviorName
    behavior: BehaviorName | None
    members: tuple[BehaviorBodyMember, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EnumExtension(Statement):
    """`extend name: [members]`."""

    name: Name
    members: tuple[EnumMember, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TypeExtension(Statement):
    """`extend name:` of a structured type or a behavior."""

    name: BehaviorName
    members: tuple[BehaviorBodyMember, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PrimitiveExtension(Statement):
    """`extend float:` with methods (2.2)."""

    primitive: str
    members: tuple[MethodDeclaration, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class GlobalParameter(Statement):
    """`global name: type = default`."""

    parameter: ParameterDeclaration


Declaration: TypeAlias = (
    PhysicalTypeDeclaration
    | UnitDeclaration
    | EnumDeclaration
    | StructDeclaration
    | ActorDeclaration
    | ScenarioDeclaration
    | ActionDeclaration
    | ModifierDeclaration
    | EnumExtension
    | TypeExtension
    | PrimitiveExtension
    | GlobalParameter
)

FileStatement: TypeAlias = NamespaceStatement | UseStatement | ExportStatement | Declaration


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class File(Node):
    """One source file: imports first, then everything else (§7.2.2.1)."""

    imports: tuple[Import, ...]
    statements: tuple[FileStatement, ...]
