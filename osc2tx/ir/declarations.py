"""Declarations of scenarios: cast, values, events, methods, and relations between the values."""

from __future__ import annotations

from typing import TypeAlias

from osc2tx.diagnostics import Span
from osc2tx.ir.behaviors import Moment, Trigger
from osc2tx.ir.expressions import Choices, Domain, Expression, RangeValue
from osc2tx.ir.values import Unit, ValueType
from osc2tx_shared.classes import dataclass

# Before the name of a global parameter that a field of the scenario hides: no field has a blank in
# its name.
GLOBAL_MARK = "global "


def setting_name(name: str) -> str:
    """Return the name of a global parameter in settings of a run."""
    return name.removeprefix(GLOBAL_MARK)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DeclarationBase:
    """The common base of the declarations of a scenario."""

    name: str
    span: Span
    comments: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FieldValue:
    """A field of an actor or struct that a constraint fixes.

    Attributes:
        path: Members below the object; behind a list the number of an element of it.
        value: Its value.
        span: Span of the value.
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
        values: The fields that constraints fix.
        is_given: Its invoker has to pass it, as some of its values are open.
        is_global: One for all scenarios of a run.
    """

    type: str
    lineage: tuple[str, ...]
    values: tuple[FieldValue, ...]
    is_given: bool = False
    is_global: bool = False


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Struct(DeclarationBase):
    """A value of a struct type: equal to another one, or with fields that constraints fix.

    Attributes:
        type: Its struct type.
        values: The fields that constraints fix.
        value: The equal value.
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
        unit: Of a physical type: the unit that the source uses for it.
    """

    type: ValueType
    value: Expression | None
    domain: Domain | None
    is_fixed: bool
    is_global: bool = False
    unit: Unit | None = None

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
    """When a variable takes a new value, and which.

    Attributes:
        expression: Gives the value.
        trigger: When; a moment is one of the scenario itself.
    """

    expression: Expression
    trigger: Trigger | Moment


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Variable(DeclarationBase):
    """A value that may change during a run: at its samples, if it has any."""

    type: ValueType
    value: Expression | None
    sample: Sample | None = None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MethodParameter:
    """A parameter of a method, event or modifier."""

    name: str
    type: ValueType
    default: Expression | None
    comments: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Event(DeclarationBase):
    """An event; without a trigger it is emitted, or sent from outside."""

    trigger: Trigger | None
    is_implicit: bool
    parameters: tuple[MethodParameter, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class External:
    """A function of Python code of the user."""

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
