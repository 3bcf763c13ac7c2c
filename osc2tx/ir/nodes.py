"""Modules and scenarios of the IR."""

from __future__ import annotations

from typing import TypeAlias

from osc2tx.diagnostics import Span
from osc2tx.ir.behaviors import Behavior, ModifierCall, Trigger
from osc2tx.ir.coverage import Coverage
from osc2tx.ir.expressions import Choices, Domain, Expression, RangeValue
from osc2tx.ir.values import ValueType, qualified
from osc2tx.support.light_dataclass import dataclass

# Before the name of a global parameter that a field of the scenario hides: no field has a blank in
# its name.
GLOBAL_MARK = "global "


def setting_name(name: str) -> str:
    """Return how settings of a run call a global parameter, whatever hides it."""
    return name.removeprefix(GLOBAL_MARK)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DeclarationBase:
    """What every declaration of a scenario has."""

    name: str
    span: Span
    comments: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FieldValue:
    """A field of an actor or struct that a constraint fixes.

    Attributes:
        path: Members below the object; behind a list the number of an element of it.
        value: What it is.
        span: Of the value.
        comments: Comment lines of the constraint.
    """

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
        is_given: Only an invoker knows all that there is to say of it, and has to hand it in.
        is_global: One for all scenarios of a run.
    """

    type: str
    lineage: tuple[str, ...]
    values: tuple[FieldValue, ...]
    is_given: bool = False
    is_global: bool = False


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Struct(DeclarationBase):
    """A value of a struct type: one that it equals, or with fields that constraints fix.

    Attributes:
        type: Its struct type.
        values: What constraints fix about it.
        value: What it equals.
        lineage: The type and its bases, most derived first.
        is_global: One for all scenarios of a run.
    """

    type: str
    values: tuple[FieldValue, ...]
    value: Expression | None = None
    lineage: tuple[str, ...] = ()
    is_global: bool = False


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Parameter(DeclarationBase):
    """A value that is constant during a run and may be set before it.

    Without default it is drawn from its domain, or must be given if that has no end.

    Attributes:
        type: Its type.
        value: Its value (`is_fixed`) or default.
        domain: The values it may take.
        is_fixed: A hard constraint leaves no other value.
        is_global: One value for all scenarios of a run.
    """

    type: ValueType
    value: Expression | None
    domain: Domain | None
    is_fixed: bool
    is_global: bool = False

    @property
    def is_required(self) -> bool:
        """Whether the scenario leaves it open, so that a value must be given."""
        return self.value is None and not isinstance(self.domain, RangeValue | Choices)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Constraint:
    """A relation between values that is checked before the run (§7.3.11)."""

    expression: Expression
    span: Span
    comments: tuple[str, ...] = ()


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
class External:
    """A function of the user's own Python code."""

    module: str
    function: str


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Method:
    """A method of the scenario, or of a type it uses, with an expression or code of the user.

    Attributes:
        name: Its name; that of a method of a type has the type before a dot.
        parameters: Of a method of a type, the object first.
        result: Type of the result, if there is one.
        expression: The body; `None` if it is external.
        external: Where the body is.
    """

    name: str
    span: Span
    parameters: tuple[MethodParameter, ...]
    result: ValueType | None
    expression: Expression | None
    external: External | None = None
    comments: tuple[str, ...] = ()


Declaration: TypeAlias = Actor | Struct | Parameter | Variable | Event


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Placement:
    """Where and how an actor is at the start of the scenario, or what the roads of a map are.

    Attributes:
        actor: The actor, or the map.
        modifiers: What holds at the start.
        span: Where that is said.
        comments: The comment lines above it.
        of_map: It is about roads.
        is_throughout: All of it holds later as well, so a scenario that another invokes in the
            middle of a run can do without.
    """

    actor: str
    modifiers: tuple[ModifierCall, ...]
    span: Span
    comments: tuple[str, ...] = ()
    of_map: bool = False
    is_throughout: bool = False


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
        constraints: What must hold between the values.
        methods: Its methods, in source order.
        placements: Initial placement, in source order.
        body: Its `do` tree.
        end_comments: Comment lines below its last member.
        overrides: Which labelled members end which others.
        coverage: What is sampled for coverage.
        is_invoked: A scenario of the module invokes it.
        is_imported: It stands here because a scenario of the file invokes it.
        is_action: It is an action that says what it does.
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
    coverage: tuple[Coverage, ...] = ()
    constraints: tuple[Constraint, ...] = ()
    is_invoked: bool = False
    is_imported: bool = False
    is_action: bool = False

    @property
    def key(self) -> str:
        """Tell the scenario apart from others of the same name."""
        return f"{self.span.source.name}:{self.span.start}"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UserField:
    """A field of a type that the scenario's files declare.

    Attributes:
        name: Its name.
        type: Its type.
        default: What it is if nobody says; without it must be given.
        is_optional: An object may do without: its own file never speaks of it.
    """

    name: str
    span: Span
    type: ValueType
    default: Expression | None
    comments: tuple[str, ...] = ()
    is_optional: bool = False


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UserType:
    """An actor or struct that the scenario's files declare.

    Attributes:
        name: As in the source; that of a combination names its types, `tall_and_long`.
        bases: The type it inherits from; several if it is the combination of conditional types
            that one object is of.
        is_actor: Whether it is an actor.
        fields: Those of its own that have values.
        unused: Those of its own that no file speaks of.
        methods: Its own methods, in source order.
    """

    name: str
    span: Span
    bases: tuple[str, ...]
    is_actor: bool
    fields: tuple[UserField, ...]
    comments: tuple[str, ...] = ()
    unused: tuple[UserField, ...] = ()
    methods: tuple[Method, ...] = ()

    @property
    def all_fields(self) -> tuple[UserField, ...]:
        """Its own fields, in source order."""
        return tuple(sorted((*self.fields, *self.unused), key=lambda field: field.span.start))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UserEnum:
    """An enum that the scenario's files declare, with all its members."""

    name: str
    span: Span
    members: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ActionParameter:
    """A parameter of a user's own action; one with a default has a value in every invocation."""

    name: str
    type: ValueType
    has_default: bool


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UserAction:
    """An action that the scenario's files declare, and a package of the user carries out.

    Attributes:
        name: Its name.
        owner: The actor type that it belongs to, if any.
        parameters: Its own and those of its bases.
        takes_modifiers: Whether modifiers of movement may be applied to it.
    """

    name: str
    owner: str | None
    span: Span
    parameters: tuple[ActionParameter, ...]
    takes_modifiers: bool
    comments: tuple[str, ...] = ()

    @property
    def qualified_name(self) -> str:
        """`vehicle.creep`; the name alone if it belongs to no actor."""
        return qualified(self.owner, self.name)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Module:
    """All scenarios of one source file, with the settings that give them their meaning.

    Attributes:
        types: Types of their objects that are not the library's, bases first, then the others of
            the file.
        actions: Actions they invoke that are not the library's, in order of use, then the others
            of the file.
        enums: Enums of the file, and those of imported files that it speaks of.
        comments: The comment lines at the head of the file.
    """

    source: str
    standard: str
    dialect: str
    one_of: str
    scenarios: tuple[Scenario, ...]
    comments: tuple[str, ...] = ()
    types: tuple[UserType, ...] = ()
    actions: tuple[UserAction, ...] = ()
    enums: tuple[UserEnum, ...] = ()
