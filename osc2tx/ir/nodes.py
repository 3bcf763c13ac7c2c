"""Modules and scenarios of the IR."""

from __future__ import annotations

from typing import TypeAlias

from osc2tx.diagnostics import Span
from osc2tx.ir.behaviors import Behavior, ModifierCall, Trigger
from osc2tx.ir.expressions import Expression, RangeValue, ValueType
from osc2tx.light_dataclass import dataclass


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DeclarationBase:
    """What every declaration of a scenario has."""

    name: str
    span: Span
    comments: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FieldValue:
    """A field of an actor or struct that a constraint fixes; `path` below the object."""

    path: tuple[str, ...]
    value: Expression
    span: Span
    comments: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Actor(DeclarationBase):
    """A member of the cast.

    Attributes:
        type: Its actor type.
        lineage: The type and its library ancestors, most derived first.
        values: What constraints fix about it.
    """

    type: str
    lineage: tuple[str, ...]
    values: tuple[FieldValue, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Struct(DeclarationBase):
    """A value of a struct type, its fields fixed by constraints."""

    type: str
    values: tuple[FieldValue, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Parameter(DeclarationBase):
    """A value that is constant during a run and may be set before it.

    Attributes:
        type: Its type.
        value: Its value (`is_fixed`) or default.
        domain: The values it may take; drawn from where there is no default.
        is_fixed: A hard constraint leaves no other value.
        is_global: One value for all scenarios of a run.
    """

    type: ValueType
    value: Expression | None
    domain: RangeValue | None
    is_fixed: bool
    is_global: bool = False


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Sample:
    """When a variable takes a new value, and which."""

    expression: Expression
    trigger: Trigger


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Variable(DeclarationBase):
    """A value that may change during a run: at its samples, if it has any."""

    type: ValueType
    value: Expression | None
    sample: Sample | None = None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MethodParameter:
    """A parameter of a method or event."""

    name: str
    type: ValueType
    default: Expression | None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Event(DeclarationBase):
    """An event; without trigger it is emitted, or comes from outside."""

    trigger: Trigger | None
    is_implicit: bool
    parameters: tuple[MethodParameter, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Method:
    """A method of the scenario whose body is an expression."""

    name: str
    span: Span
    parameters: tuple[MethodParameter, ...]
    result: ValueType
    expression: Expression
    comments: tuple[str, ...] = ()


Declaration: TypeAlias = Actor | Struct | Parameter | Variable | Event


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Placement:
    """Where and how an actor is at the start of the scenario."""

    actor: str
    modifiers: tuple[ModifierCall, ...]
    span: Span
    comments: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Override:
    """`override(overridden, by, mode)` (§7.3.12.1.1); the first two are labels."""

    span: Span
    overridden: str
    by: str
    mode: str


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Scenario:
    """A scenario, ready to be written down by a backend.

    Attributes:
        name: As in the source.
        comments: The comment lines above it.
        declarations: Cast, values and events in source order.
        methods: Its methods, in source order.
        placements: Initial placement, in source order.
        body: Its `do` tree.
        end_comments: Comment lines below its last member.
        overrides: Which labelled members end which others.
        is_imported: It stands here because a scenario of the file invokes it.
    """

    name: str
    span: Span
    comments: tuple[str, ...]
    declarations: tuple[Declaration, ...]
    methods: tuple[Method, ...]
    placements: tuple[Placement, ...]
    body: Behavior
    end_comments: tuple[str, ...] = ()
    overrides: tuple[Override, ...] = ()
    is_imported: bool = False

    @property
    def key(self) -> str:
        """Tell the scenario apart from others of the same name."""
        return f"{self.span.source.name}:{self.span.start}"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Module:
    """All scenarios of one source file, with the settings that give them their meaning.

    Attributes:
        comments: The comment lines at the head of the file.
    """

    source: str
    standard: str
    dialect: str
    one_of: str
    scenarios: tuple[Scenario, ...]
    comments: tuple[str, ...] = ()
