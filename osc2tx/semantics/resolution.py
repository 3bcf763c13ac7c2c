"""The state shared by the functions of the resolution pass."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import field
from typing import Protocol

from osc2tx.diagnostics import DiagnosticSink, Label, Span
from osc2tx.diagnostics.fixes import Help
from osc2tx.semantics.dialects import Relaxations
from osc2tx.semantics.model import Binding
from osc2tx.semantics.scope import Context, Scope
from osc2tx.semantics.symbols import (
    ActionSymbol,
    ActorSymbol,
    BehaviorSymbol,
    EventSymbol,
    FieldSymbol,
    ParameterSymbol,
    ScenarioSymbol,
    StructSymbol,
    Symbol,
    TypeSymbol,
    UnitSymbol,
)
from osc2tx.semantics.types import Type
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass, replace


@dataclass(frozen=True, slots=True)
class Environment:
    """The environment of an expression.

    Attributes:
        context: Namespace and use list of the text.
        owner: The type whose body contains the expression.
        it: The meaning of `it`, if it is not the instance of the owner.
        actor: The type of `actor`.
        invoked: The behavior whose `with` block this is.
        locals: Method parameters and event fields.
    """

    context: Context
    owner: TypeSymbol | None = None
    it: Type | None = None
    actor: ActorSymbol | None = None
    invoked: BehaviorSymbol | None = None
    locals: Mapping[str, ParameterSymbol] = field(default_factory=dict)

    def with_it(self, type_: Type) -> Environment:
        """Return the same place with another `it`."""
        return replace(self, it=type_)

    def with_locals(self, symbols: Iterable[ParameterSymbol]) -> Environment:
        """Return the same place with further local names."""
        return replace(self, locals={**self.locals, **{s.name: s for s in symbols}})


class InferFunction(Protocol):
    """The function that returns the type of an expression."""

    def __call__(
        self,
        r: Resolution,
        expression: ast.Expression,
        env: Environment,
        expected: Type | None = None,
    ) -> Type:
        """Return the type, and report errors."""


@dataclass(slots=True, eq=False, repr=False)
class Resolution:
    """Scope and side tables of one resolution pass.

    Attributes:
        scope: All definitions.
        sink: Receives the diagnostics.
        relaxations: The dialect, and its relaxations so far.
        standard: `"2.1"` or `"2.2"`.
        infer: The expression typer.
        unimported: Returns the library if the program has not imported all of it.
        event_fields: The event behind each name that `as` bound.
        actor_fields: The implicit field `actor` per actor type.
        implied_objects: The objects that a program has without declaring them, per type.
        quantities: The values of strings of ScenarioRunner such as `"npc_speed"`.
        adopted: Fields for actors of the caller, which a dialect identifies by their names.
        invoked: The symbol of the name in an invocation; `None` if it was reported.
        visible: The names that are visible in a type, and outside of all: for suggestions.
    """

    scope: Scope
    sink: DiagnosticSink
    relaxations: Relaxations
    standard: str
    infer: InferFunction
    unimported: Callable[[], Scope] | None = None
    types: dict[ast.Node, Type] = field(default_factory=dict)
    references: dict[ast.Node, Symbol] = field(default_factory=dict)
    bindings: dict[ast.Node, Binding] = field(default_factory=dict)
    units: dict[ast.PhysicalLiteral, UnitSymbol] = field(default_factory=dict)
    event_fields: dict[Symbol, EventSymbol] = field(default_factory=dict)
    actor_fields: dict[ActorSymbol, FieldSymbol] = field(default_factory=dict)
    implied_objects: dict[ActorSymbol | StructSymbol, FieldSymbol] = field(default_factory=dict)
    quantities: dict[ast.StringLiteral, ast.MemberAccess] = field(default_factory=dict)
    adopted: set[FieldSymbol] = field(default_factory=set)
    invoked: dict[ast.Name, ScenarioSymbol | ActionSymbol | None] = field(default_factory=dict)
    visible: dict[TypeSymbol | None, frozenset[str]] = field(default_factory=dict)

    def type_of(
        self, expression: ast.Expression, env: Environment, expected: Type | None = None
    ) -> Type:
        """Return the type of an expression."""
        return self.infer(self, expression, env, expected)

    def report(
        self,
        code: str,
        span: Span,
        message: str,
        *,
        help: Help = None,
        notes: Sequence[str] = (),
        labels: Sequence[Label] = (),
    ) -> None:
        """Report a mistake."""
        self.sink.report(code, span, message, help=help, notes=notes, labels=labels)

    def relaxes(
        self,
        code: str,
        span: Span,
        message: str,
        *,
        key: str = "",
        help: Help = None,
        labels: Sequence[Label] = (),
    ) -> bool:
        """Whether the dialect accepts a deviation, which is then a warning, once per file."""
        if code not in self.relaxations.dialect.relaxed:
            return False
        if self.relaxations.is_new(code, span.source.name, key):
            self.sink.report(code, span, message, help=help, labels=labels)
        return True

    def needs_standard(self, span: Span, what: str) -> None:
        """Report a construct of 2.2 in a program of 2.1."""
        if self.standard < "2.2":
            self.report(
                "OSC213", span, f"{what} needs OpenSCENARIO DSL 2.2", help="check with `--std 2.2`"
            )


def declared_here(symbol: Symbol, what: str = "declared here") -> tuple[Label, ...]:
    """Return a label at a declaration, unless it is built in."""
    return () if symbol.origin == "builtin" else (Label(symbol.span, what),)
