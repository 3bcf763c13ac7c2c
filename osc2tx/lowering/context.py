"""Context of lowering: the program, diagnostics, and the meaning of names."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import field
from typing import TypeVar

from osc2tx import ir
from osc2tx.analysis import ConstraintAnalysis
from osc2tx.analysis.constraints.constraint import Constraint
from osc2tx.analysis.constraints.domains import Domain
from osc2tx.analysis.constraints.operation_list import Key
from osc2tx.analysis.constraints.parameter_lookup import Place
from osc2tx.analysis.same_actors import SameActor
from osc2tx.diagnostics import DiagnosticSink, Span
from osc2tx.ir.source_text import condensed
from osc2tx.lowering.constraints.parameter_settings import Setting
from osc2tx.lowering.value_types import authored_unit
from osc2tx.semantics import SemanticModel
from osc2tx.semantics.symbols import (
    ActionSymbol,
    ActorSymbol,
    FieldSymbol,
    MethodSymbol,
    ModifierSymbol,
    ScenarioSymbol,
    StructSymbol,
    Symbol,
    TypeSymbol,
)
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass, replace

Part = TypeVar("Part")


@dataclass(frozen=True, slots=True)
class Receiver:
    """The object whose members plain names mean, in the body of a method of its type."""

    owner: TypeSymbol
    value: ir.Expression


@dataclass(frozen=True, slots=True)
class Program:
    """What is known of the program before its scenarios are lowered.

    Attributes:
        model: The program.
        analysis: The result of the analysis of its constraints.
        lower_with: The function that lowers expressions of any kind.
        mentioned: The fields that some expression of the program reads, and in which files.
        default_keeps: Constraints that give fields a default in the type that declares them.
        handed_in: Parameters of invoked scenarios that an invocation sets.
        computed: Those of them that some invocation gives no plain name.
        object_types: The types of which the program may have objects.
    """

    model: SemanticModel
    analysis: ConstraintAnalysis
    lower_with: Callable[[LoweringContext, ast.Expression], ir.Expression | None]
    mentioned: Mapping[FieldSymbol, frozenset[str]] = field(default_factory=dict)
    default_keeps: Mapping[FieldSymbol, ast.KeepConstraint] = field(default_factory=dict)
    handed_in: frozenset[Symbol] = frozenset()
    computed: frozenset[Symbol] = frozenset()
    object_types: tuple[TypeSymbol, ...] = ()


@dataclass(slots=True)
class UsedDeclarations:
    """Declarations that the lowered scenarios use, in order of use.

    Attributes:
        types: Types of declared objects that are not the library's.
        combined: Combinations of conditional types that objects are of, by name.
        actions: Actions that are invoked.
        modifiers: User-defined modifiers that are applied.
        purity: Methods, and whether their results do not depend on the world.
    """

    types: list[ActorSymbol | StructSymbol] = field(default_factory=list)
    combined: dict[str, ir.UserType] = field(default_factory=dict)
    actions: list[ActionSymbol] = field(default_factory=list)
    modifiers: list[ModifierSymbol] = field(default_factory=list)
    purity: dict[MethodSymbol, bool] = field(default_factory=dict)


@dataclass(slots=True)
class ScenarioState:
    """What the lowering of one scenario has made and met so far, in order of use.

    Attributes:
        globals: The global parameters that it uses.
        event_fields: Events that fields such as `x` in `@e as x` stand for, by their names and the
            keys of the invoked scenarios that have them.
        invoked: The scenarios and composed actions that it invokes.
        drawn: Parameters that stand for ranges in its tree, structs that constraints of
            invocations describe, and variables of modifiers.
        given: Values of parameters of invocations that constraints may mention.
        methods: Methods of types that it calls, by name.
        object_events: Events of its objects that it waits for, by path.
        object_variables: Sampled variables of its objects that it reads, by path: the field, and
            the object.
    """

    globals: dict[str, FieldSymbol] = field(default_factory=dict)
    event_fields: dict[int, tuple[str, str | None]] = field(default_factory=dict)
    invoked: list[ScenarioSymbol | ActionSymbol] = field(default_factory=list)
    drawn: list[ir.Parameter | ir.Struct | ir.Actor | ir.Variable] = field(default_factory=list)
    given: dict[Key, ir.Expression] = field(default_factory=dict)
    methods: dict[str, MethodSymbol] = field(default_factory=dict)
    object_events: dict[str, ir.Event | None] = field(default_factory=dict)
    object_variables: dict[str, tuple[FieldSymbol, ir.Expression]] = field(default_factory=dict)

    def ahead(self) -> ScenarioState:
        """Return a state to look ahead with: it knows what this one knows, which stays as it is."""
        return replace(
            self,
            globals=dict(self.globals),
            invoked=[],
            drawn=[],
            methods=dict(self.methods),
            object_events=dict(self.object_events),
            object_variables=dict(self.object_variables),
        )


@dataclass(frozen=True)  # without slots: a variant is a copy of the dict with one other field
class LoweringContext:
    """The program, the state of the lowering, and the meaning of the names in a part of a scenario.

    Attributes:
        program: The checked program.
        used: The declarations that its scenarios use.
        sink: Receives the diagnostics.
        constants: Values of parameters that constraints set to a constant, with the rest of their
            domains; the same in all scenarios that inherit them.
        state: The state of the lowering of the scenario.
        own_names: Names of the members of the scenario.
        known_files: Names of the files of the scenario, and of those that they import.
        same_actors: The actors of the scenario that are equal to others.
        place: Scope of the names in an expression, in constraints.
        it: The meaning of `it` there.
        receiver: The object whose method an expression is the body of.
        expanding: Methods of modifiers that the expression is the body of, the outermost first.
        attached: Events and variables of the modifier or extended action that is looked at, and
            their names in the scenario.
        locals: Values of parameters that are not those of a method.
        actor: The meaning of `actor` in a modifier; elsewhere it is the field of the scenario.
    """

    program: Program
    used: UsedDeclarations
    sink: DiagnosticSink
    constants: dict[Constraint, tuple[Setting, Domain | None]] = field(default_factory=dict)
    state: ScenarioState = field(default_factory=ScenarioState)
    own_names: frozenset[str] = frozenset()
    known_files: frozenset[str] = frozenset()
    same_actors: Mapping[FieldSymbol, SameActor] = field(default_factory=dict)
    place: Place | None = None
    it: ir.Expression | None = None
    receiver: Receiver | None = None
    expanding: tuple[str, ...] = ()
    attached: Mapping[Symbol, str] = field(default_factory=dict)
    locals: Mapping[str, ir.Expression] = field(default_factory=dict)
    actor: ir.Expression | None = None

    @property
    def model(self) -> SemanticModel:
        """The model of the program."""
        return self.program.model

    def lower(self, node: ast.Expression) -> ir.Expression | None:
        """Return an expression as the IR has it; `None` if a part of it was refused.

        For modules that `expressions` itself imports.
        """
        return self.program.lower_with(self, node)

    def of_scenario(
        self,
        own_names: frozenset[str],
        known_files: frozenset[str],
        same: Mapping[FieldSymbol, SameActor],
    ) -> LoweringContext:
        """Return the context for another scenario of the same program, with such members."""
        return self._with(
            state=ScenarioState(), own_names=own_names, known_files=known_files, same_actors=same
        )

    def at(self, place: Place) -> LoweringContext:
        """Return the context for an expression of a constraint."""
        return self._with(place=place, it=None)

    def with_it(self, it: ir.Expression) -> LoweringContext:
        """Return the context for an expression in which `it` is something."""
        return self._with(it=it)

    def with_actor(self, actor: ir.Expression | None) -> LoweringContext:
        """Return the context for members in which `actor` is something."""
        return self._with(actor=actor)

    def with_local(self, name: str, value: ir.Expression) -> LoweringContext:
        """Return the context for an expression in which a parameter stands for something."""
        return self._with(locals={**self.locals, name: value})

    def with_attached(self, names: Mapping[Symbol, str]) -> LoweringContext:
        """Return the context for members that a modifier or an extended action adds."""
        return self._with(attached={**self.attached, **names})

    def in_method(self, name: str) -> LoweringContext:
        """Return the context for the body of a method of a modifier."""
        return self._with(expanding=(*self.expanding, name))

    def inside(self, receiver: Receiver) -> LoweringContext:
        """Return the context for the body of a method of a type."""
        return self._with(receiver=receiver, place=None, it=receiver.value)

    def _with(self, **changes: object) -> LoweringContext:
        """Return a context with other fields: `replace` would set all, for each argument."""
        made = object.__new__(LoweringContext)
        made.__dict__.update(self.__dict__, **changes)
        return made

    def quiet(self) -> LoweringContext:
        """Return a context to look ahead with: nothing is reported, and nothing is noted."""
        return self._with(sink=DiagnosticSink(), constants={}, state=self.state.ahead())

    def draw(
        self, name: str, domain: ir.Domain | None, type_: ir.ValueType, span: Span | None = None
    ) -> ir.FieldRef:
        """Return a value from a domain, as a parameter that one can set like any other.

        Its name has a blank or a dot, so that no plain name of the scenario can be the same.

        Args:
            name: The name.
            domain: The domain to draw from; `None` if settings must give it.
            type_: Its type.
            span: Its position; without one, the position of the domain.
        """
        place = span or (domain.span if domain is not None else None)
        assert place is not None
        unique = self.unique(name)
        parameter = ir.Parameter(
            name=unique,
            span=place,
            type=type_,
            value=None,
            domain=domain,
            is_fixed=False,
            unit=authored_unit(self.model, type_, (domain,)),
        )
        self.state.drawn.append(parameter)
        return ir.FieldRef(span=place, type=type_, name=unique)

    def unique(self, name: str) -> str:
        """Return a name that nothing drawn has, with a number if need be."""
        taken = {each.name for each in self.state.drawn}
        number, unique = 1, name
        while unique in taken:
            number += 1
            unique = f"{name} {number}"
        return unique

    def unsupported(self, code: str, span: Span, what: str, help: str | None = None) -> None:
        """Report what cannot be lowered."""
        self.sink.report(code, span, what, help=help)


def present(parts: Sequence[Part | None]) -> tuple[Part, ...]:
    """Drop what could not be lowered; it has been reported."""
    return tuple(part for part in parts if part is not None)


def apart(lines: tuple[str, ...]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the comment lines above and behind a statement, and those below it."""
    below = tuple(line for line in lines if isinstance(line, ir.CommentBelow))
    return lines[: len(lines) - len(below)], below


def stated_keeps(statements: Iterable[ast.Statement]) -> Iterator[str]:
    """Yield constraints as comment lines, each below its own comments."""
    for statement in statements:
        if isinstance(statement, ast.KeepConstraint):
            yield from map(str, statement_comments(statement))
            yield condensed(statement.span.text)


def comments_around(lines: tuple[str, ...], inside: Iterable[str]) -> tuple[str, ...]:
    """Return the comment lines of a statement, with some from inside of it below those above it."""
    marked = [each for each in lines if isinstance(each, ir.TrailingComment | ir.CommentBelow)]
    return (*lines[: len(lines) - len(marked)], *map(str, inside), *marked)


def statement_comments(node: ast.Statement) -> tuple[str, ...]:
    """Return the comment lines that belong to a statement: above, behind and below it."""
    if node.trailing_comment is None and not node.comments_below:
        return node.comments
    behind = () if node.trailing_comment is None else (ir.TrailingComment(node.trailing_comment),)
    return (*node.comments, *behind, *map(ir.CommentBelow, node.comments_below))
