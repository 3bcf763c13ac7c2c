"""Symbols, the named declarations of a program, and the types that refer to them.

The definition pass makes symbols; the resolution pass fills `type`, `base` and the like. After
that, symbols do not change. Symbols have types and types have symbols, so both are here; `types`
has all types.
"""

from __future__ import annotations

from dataclasses import field
from typing import TypeAlias

from osc2tx.diagnostics import Span
from osc2tx.semantics.basic_types import (
    DIMENSIONLESS,
    ERROR,
    Dimension,
    ErrorType,
    EventType,
    PhysicalType,
    PrimitiveType,
    VoidType,
)
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass


@dataclass(slots=True, kw_only=True, eq=False, repr=False)
class Symbol:
    """A named declaration.

    Attributes:
        name: Simple name.
        namespace: Namespace it was defined in; `"null"` for the null namespace.
        span: Where its name is declared.
        origin: `"user"`, `"library"` or `"prelude"` (of a dialect).
    """

    name: str
    namespace: str
    span: Span
    origin: str = "user"

    def __repr__(self) -> str:
        """Kind and name alone: symbols refer to each other in circles."""
        return f"{type(self).__name__}({self.name!r})"


@dataclass(slots=True, kw_only=True, eq=False, repr=False)
class UnitSymbol(Symbol):
    """A unit: `si = value * factor + offset`."""

    type: Type = ERROR
    factor: float = 1.0
    offset: float = 0.0


@dataclass(slots=True, kw_only=True, eq=False, repr=False)
class PhysicalTypeSymbol(Symbol):
    """A physical type."""

    dimension: Dimension = DIMENSIONLESS


@dataclass(slots=True, kw_only=True, eq=False, repr=False)
class EnumMemberSymbol(Symbol):
    """A member of an enum with its value."""

    enum: EnumSymbol
    value: int


@dataclass(slots=True, kw_only=True, eq=False, repr=False)
class EnumSymbol(Symbol):
    """An enum; members in order, extensions included."""

    members: dict[str, EnumMemberSymbol] = field(default_factory=dict)


@dataclass(slots=True, kw_only=True, eq=False, repr=False)
class ParameterSymbol(Symbol):
    """A formal parameter of a method or event."""

    type: Type = ERROR
    default: ast.Expression | None = None


@dataclass(slots=True, kw_only=True, eq=False, repr=False)
class FieldSymbol(Symbol):
    """A field: of a structured type, of a modifier (then it is a parameter), or global.

    Attributes:
        owner: The type that declares it; `None` for a global parameter.
        is_variable: Declared with `var`.
        default: Its default value or sample.
        node: The declaration; `None` for built-in fields such as `duration` and `actor`.
        constraints: The `keep`s of its type and of its `with` block.
    """

    owner: MemberOwner | None
    type: Type = ERROR
    is_variable: bool = False
    default: ast.Expression | ast.SampleExpression | None = None
    node: ast.ParameterDeclaration | ast.VariableDeclaration | None = None
    constraints: tuple[ast.KeepConstraint, ...] = ()


@dataclass(slots=True, kw_only=True, eq=False, repr=False)
class EventSymbol(Symbol):
    """An event; `is_implicit` if it is used without declaration, as a dialect allows."""

    owner: MemberOwner | None
    parameters: tuple[ParameterSymbol, ...] = ()
    node: ast.EventDeclaration | None = None
    is_implicit: bool = False


@dataclass(slots=True, kw_only=True, eq=False, repr=False)
class MethodSymbol(Symbol):
    """A method of a structured or primitive type, or a built-in operator of lists and ranges."""

    owner: MemberOwner | None
    parameters: tuple[ParameterSymbol, ...] = ()
    result: Type = ERROR
    node: ast.MethodDeclaration | None = None


@dataclass(slots=True, kw_only=True, eq=False, repr=False)
class LabelSymbol(Symbol):
    """A label in a `do` tree; its type is that of the labelled member."""

    owner: MemberOwner
    node: ast.BehaviorMember
    type: Type = ERROR


Member: TypeAlias = FieldSymbol | EventSymbol | MethodSymbol | LabelSymbol


@dataclass(slots=True, kw_only=True, eq=False, repr=False)
class TypeSymbol(Symbol):
    """The common base of structs, actors, behaviors and modifiers.

    Attributes:
        members: Own members by name, those of extensions included; where two namespaces have the
            same name, the later one by `namespace::name`.
        namesakes: Those later ones, by name.
        statements: Own member statements in source order, those of extensions at the end.
        is_extended: Whether it is of the library and files of the user extend it (§7.3.9).
    """

    members: dict[str, Member] = field(default_factory=dict)
    namesakes: dict[str, list[Member]] = field(default_factory=dict)
    statements: list[ast.Statement] = field(default_factory=list)
    is_extended: bool = False

    @property
    def is_as_library(self) -> bool:
        """Whether the library alone declares its members."""
        return self.origin == "library" and not self.is_extended

    @property
    def added(self) -> list[ast.Statement]:
        """The statements that extensions in files of the user add to a type of the library."""
        home = self.span.source
        return [s for s in self.statements if s.span.source is not home] if self.is_extended else []

    def named(self, text: str) -> list[Member]:
        """Return the own members of a name, one for each namespace that has one."""
        first = self.members.get(text)
        return [] if first is None else [first, *self.namesakes.get(text, ())]


@dataclass(slots=True, kw_only=True, eq=False, repr=False)
class StructSymbol(TypeSymbol):
    """A struct."""

    base: StructSymbol | None = None
    condition: ast.InheritanceCondition | None = None


@dataclass(slots=True, kw_only=True, eq=False, repr=False)
class ActorSymbol(TypeSymbol):
    """An actor type."""

    base: ActorSymbol | None = None
    condition: ast.InheritanceCondition | None = None


@dataclass(slots=True, kw_only=True, eq=False, repr=False)
class BehaviorSymbol(TypeSymbol):
    """A scenario, action or modifier, with the actor type it is associated with."""

    actor: ActorSymbol | None = None

    @property
    def qualified_name(self) -> str:
        """`vehicle.drive`, or the simple name without an actor."""
        return f"{self.actor.name}.{self.name}" if self.actor else self.name


@dataclass(slots=True, kw_only=True, eq=False, repr=False)
class ScenarioSymbol(BehaviorSymbol):
    """A scenario."""

    node: ast.ScenarioDeclaration
    base: ScenarioSymbol | None = None
    condition: ast.InheritanceCondition | None = None


@dataclass(slots=True, kw_only=True, eq=False, repr=False)
class ActionSymbol(BehaviorSymbol):
    """An action.

    Attributes:
        derived: The actions that are declared to inherit from it; only of a user's own.
    """

    node: ast.ActionDeclaration
    base: ActionSymbol | None = None
    condition: ast.InheritanceCondition | None = None
    derived: list[ActionSymbol] = field(default_factory=list)


@dataclass(slots=True, kw_only=True, eq=False, repr=False)
class ModifierSymbol(BehaviorSymbol):
    """A modifier; its fields are its parameters.

    Attributes:
        target: The behavior it may be applied to (`of …`); `None` for any.
    """

    node: ast.ModifierDeclaration
    target: ScenarioSymbol | ActionSymbol | None = None


@dataclass(slots=True, kw_only=True, eq=False, repr=False)
class PrimitiveSymbol(TypeSymbol):
    """A primitive type with the methods that extensions gave it (2.2)."""


MemberOwner: TypeAlias = TypeSymbol


@dataclass(frozen=True, slots=True)
class EnumType:
    """The type that an enum declaration defines."""

    symbol: EnumSymbol

    def __str__(self) -> str:
        """The enum's name."""
        return self.symbol.name


@dataclass(frozen=True, slots=True)
class StructType:
    """The type that a struct declaration defines."""

    symbol: StructSymbol

    def __str__(self) -> str:
        """The struct's name."""
        return self.symbol.name


@dataclass(frozen=True, slots=True)
class ActorType:
    """The type that an actor declaration defines."""

    symbol: ActorSymbol

    def __str__(self) -> str:
        """The actor's name."""
        return self.symbol.name


@dataclass(frozen=True, slots=True)
class BehaviorType:
    """The type of an invocation of a scenario or action."""

    symbol: ScenarioSymbol | ActionSymbol

    def __str__(self) -> str:
        """The behavior's name, with its actor."""
        return self.symbol.qualified_name


@dataclass(frozen=True, slots=True)
class ListType:
    """`list of T`."""

    element: Type

    def __str__(self) -> str:
        """As written."""
        return f"list of {self.element}"


@dataclass(frozen=True, slots=True)
class RangeType:
    """A range of numeric values; in 2.1 only the type of range expressions."""

    element: Type

    def __str__(self) -> str:
        """As written."""
        return f"range of {self.element}"


Type: TypeAlias = (
    PrimitiveType
    | PhysicalType
    | EnumType
    | StructType
    | ActorType
    | BehaviorType
    | ListType
    | RangeType
    | EventType
    | VoidType
    | ErrorType
)
