"""Results of the constraint analysis: parameters that are fixed, bounded or open.

`ConstraintAnalysis` is the result for later stages. Its queries about a parameter of a scenario:

    found = analysis.parameter(scenario, field)         # or a path: (scenario, pose, position, x)
    match found.state:
        case State.FIXED:    found.value                # in SI; enum members as symbols
        case State.BOUNDED:  found.domain, found.range  # interval or set; the range as written
        case State.DEFINED:  found.definition           # an expression to evaluate at the start
        case State.FREE:     ...                        # neither value nor finite range

`definition` is also set for a `FIXED` parameter with an expression, `v + 10kph`: the effective
expression, after overriding, so that a backend can write it as authored.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import field
from enum import Enum
from functools import partial

from osc2tx.analysis.constraints.collect import Collector, Shared
from osc2tx.analysis.constraints.constraint import Constraint, Entry
from osc2tx.analysis.constraints.domains import Choice, Domain, Interval, Value, close, is_void
from osc2tx.analysis.constraints.operation_list import Key, Part, domain_of_type
from osc2tx.analysis.constraints.overrides import EffectiveConstraints, apply_overrides
from osc2tx.analysis.constraints.parameter_lookup import name_of
from osc2tx.analysis.constraints.solver import smallest_conflict, solve
from osc2tx.analysis.constraints.specialisation import (
    Condition,
    Special,
    conditions_of,
    is_possible,
    specialised,
    types_below,
)
from osc2tx.semantics import SemanticModel, types
from osc2tx.semantics import symbols as sym
from osc2tx.semantics.scope import supertypes
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass, replace

MOST_CONFLICTS = 10  # reported for one type


class State(Enum):
    """How much is known of a parameter when compiling."""

    FIXED = "fixed"
    BOUNDED = "bounded"
    DEFINED = "defined"
    FREE = "free"


@dataclass(frozen=True, slots=True, eq=False)
class ParameterDomain:
    """The facts about one parameter.

    Attributes:
        key: The fields that lead to it.
        type: Its type.
        state: The state of knowledge.
        domain: The possible values; all of its type if it is free.
        definition: Its value by the effective equality.
        range: The range or list that it must be in, as written.
        constraints: Effective constraints that mention it, in the order of the text.
        replaced: Its defaults that were replaced.
    """

    key: Key
    type: types.Type
    state: State
    domain: Domain
    definition: ast.Expression | None = None
    range: ast.Expression | None = None
    constraints: tuple[Constraint, ...] = ()
    replaced: tuple[Constraint, ...] = ()

    @property
    def name(self) -> str:
        """The path as one would write it."""
        return name_of(self.key)

    @property
    def value(self) -> Value | sym.EnumMemberSymbol | None:
        """The one value of a fixed parameter, in SI; the member of an enum."""
        number = single_value(self.domain) if self.state is State.FIXED else None
        if isinstance(self.type, types.EnumType):
            members = self.type.symbol.members.values()
            return next((m for m in members if m.value == number), None)
        return number


@dataclass(frozen=True, slots=True, eq=False)
class TypeConstraints:
    """The constraints of one type, or of a global parameter.

    Attributes:
        owner: The type; `None` for a global parameter.
        in_force: Its constraints after overriding.
        domains: The domain of each parameter that a constraint mentions.
        conflicts: Groups of constraints that cannot hold together.
        by_key: The constraints that mention a parameter.
        members: The parameters whose paths begin with a field, an invocation or a composition.
        special: The conditional types that objects are of.
        undecided: The objects that may be of others, with those.
    """

    owner: sym.TypeSymbol | None
    in_force: EffectiveConstraints
    domains: Mapping[Key, Domain]
    conflicts: tuple[tuple[Constraint, ...], ...]
    by_key: Mapping[Key, tuple[Constraint, ...]] = field(default_factory=dict)
    members: Mapping[Part, Sequence[Key]] = field(default_factory=dict)
    special: Mapping[Key, tuple[Special, ...]] = field(default_factory=dict)
    undecided: tuple[tuple[Key, Special], ...] = ()

    def parameter(self, key: Key, type_: types.Type) -> ParameterDomain:
        """Return the facts about a parameter."""
        mentioned = self.by_key.get(key, ())
        settings = [c for c in mentioned if c.subject == key and c.value is not None]
        definition = next((c.value for c in reversed(settings) if not c.is_range), None)
        within = next((c.value for c in reversed(settings) if c.is_range), None)
        domain = self.domains.get(key, domain_of_type(type_))
        if single_value(domain) is not None:
            state = State.FIXED
        elif definition is not None:
            state = State.DEFINED
        elif within is not None or _is_bounded(domain, type_):
            state = State.BOUNDED
        else:
            state = State.FREE
        return ParameterDomain(
            key=key,
            type=type_,
            state=state,
            domain=domain,
            definition=definition,
            range=within,
            constraints=mentioned,
            replaced=tuple(c for c in self.in_force.replaced if c.subject == key),
        )

    def domains_to_set(self) -> Mapping[Key, Domain]:
        """Return the domain of each parameter if all defaults may be replaced.

        Settings of a run choose from it, as they replace defaults. Parameters that no default
        affects, even through constraints on several parameters, keep their domain.
        """
        firm = self.firm
        plain = set(self.in_force.constraints).difference(firm)
        reached = self.connected(key for each in plain for key in each.operations.keys)
        again = [c.operations for c in firm if not c.operations.keys.isdisjoint(reached)]
        kept = {key: domain for key, domain in self.domains.items() if key not in reached}
        return {**kept, **solve(again, range(len(again))).domains} if reached else self.domains

    def connected(self, keys: Iterable[Key]) -> set[Key]:
        """Return parameters and all others that constraints connect with them."""
        pending, reached = list(keys), set[Key]()
        while pending:
            key = pending.pop()
            if key not in reached:
                reached.add(key)
                for constraint in self.by_key.get(key, ()):
                    pending += constraint.operations.keys
        return reached

    @property
    def firm(self) -> tuple[Constraint, ...]:
        """The constraints that settings cannot replace: all but plain defaults."""
        return tuple(
            c for c in self.in_force.constraints if not c.is_default or not c.subject or c.is_range
        )


@dataclass(frozen=True, slots=True, eq=False)
class ConstraintAnalysis:
    """The constraints of all types that the user's files declare or extend."""

    types: Mapping[sym.TypeSymbol, TypeConstraints]

    def parameter(
        self, owner: sym.TypeSymbol, root: sym.FieldSymbol, *members: sym.FieldSymbol
    ) -> ParameterDomain:
        """Return the facts, in a scenario or other type, about a field or a path below it."""
        return self.types[owner].parameter((root, *members), (root, *members)[-1].type)

    def parameters(self, owner: sym.TypeSymbol) -> Iterator[ParameterDomain]:
        """Yield all plain parameters of a type, those of its bases first."""
        for ancestor in reversed(list(supertypes(owner))):
            for member in ancestor.members.values():
                if not isinstance(member, sym.FieldSymbol) or member.is_variable:
                    continue
                if not isinstance(member.type, types.ActorType | types.StructType):
                    yield self.parameter(owner, member)


def analyse_constraints(model: SemanticModel) -> ConstraintAnalysis:
    """Collect and propagate the constraints of every type in the user's files."""
    conditions = conditions_of(model)
    shared: Shared = {}
    return ConstraintAnalysis(
        {
            owner: _analyse_objects(
                model, owner, partial(Collector.collect, owner=owner), conditions, shared
            )
            for owner in declared_types(model)
        }
    )


def _analyse_objects(
    model: SemanticModel,
    owner: sym.TypeSymbol | None,
    collect: Callable[[Collector], list[Entry]],
    conditions: tuple[Condition, ...],
    shared: Shared | None = None,
) -> TypeConstraints:
    """Analyse constraints, and again while more is found about the types of their objects."""
    special: dict[Key, tuple[Special, ...]] = {}
    while True:
        collector = Collector(model, special, shared)
        found = _analyse(owner, collect(collector))
        more = specialised(conditions, collector.objects, found.domains, special)
        if more == special or found.conflicts:
            break
        special = more
    undecided = tuple(
        (key, condition.type)
        for key, declared in collector.objects.items()
        for condition in types_below(conditions, declared, special.get(key, ()))
        if is_possible(found.domains.get((*key, condition.field)), condition.determinant)
    )
    return replace(found, special=special, undecided=undecided)


def analyse_global(model: SemanticModel, parameter: sym.FieldSymbol) -> TypeConstraints:
    """Collect and propagate the constraints on a global parameter."""
    collect = partial(Collector.collect_global, parameter=parameter)
    return _analyse_objects(model, None, collect, conditions_of(model))


def analyse_globals(model: SemanticModel) -> TypeConstraints:
    """Collect and propagate the constraints on all global parameters."""
    return _analyse(None, Collector(model).collect_globals())


def declared_types(model: SemanticModel) -> list[sym.TypeSymbol]:
    """Return the types of the user's files; scenarios last, as they use the others."""
    found = [s for s in model.symbols if isinstance(s, sym.TypeSymbol) and s.origin == "user"]
    return sorted(found, key=lambda symbol: isinstance(symbol, sym.ScenarioSymbol))


def _analyse(owner: sym.TypeSymbol | None, entries: list[Entry]) -> TypeConstraints:
    in_force = apply_overrides(entries)
    constraints = in_force.constraints
    expressions = [constraint.operations for constraint in constraints]
    active = list(range(len(constraints)))
    conflicts: list[tuple[Constraint, ...]] = []
    solution = solve(expressions, active)
    while solution.conflict and len(conflicts) < MOST_CONFLICTS:
        core = smallest_conflict(expressions, solution.conflict)
        conflicts.append(tuple(constraints[index] for index in core))
        active = [index for index in active if index != core[-1]]
        solution = solve(expressions, active)
    by_key: dict[Key, list[Constraint]] = {}
    for constraint in constraints:
        for key in constraint.operations.keys_in_order:
            by_key.setdefault(key, []).append(constraint)
    members: dict[Part, list[Key]] = {}
    for key in by_key:
        members.setdefault(key[0], []).append(key)
    return TypeConstraints(
        owner=owner,
        in_force=in_force,
        domains=solution.domains,
        conflicts=tuple(conflicts),
        by_key={key: tuple(found) for key, found in by_key.items()},
        members=members,
    )


def single_value(domain: Domain) -> Value | None:
    """Return the value of a domain that holds one, up to rounding."""
    if isinstance(domain, Choice):
        return next(iter(domain.values)) if domain.is_point else None
    if domain.nan or is_void(domain) or domain.lower_open or domain.upper_open:
        return None
    if domain.lower == domain.upper:
        return domain.lower
    if isinstance(domain.lower, int) or not close(domain.lower, domain.upper):
        return None
    return (domain.lower + domain.upper) / 2


def _is_bounded(domain: Domain, type_: types.Type) -> bool:
    """Whether a domain is a finite range, or a choice narrower than its type."""
    if isinstance(domain, Choice):
        return not domain.excluded and domain != domain_of_type(type_)
    whole = domain_of_type(type_)
    if not isinstance(whole, Interval) or is_void(domain):
        return False
    return domain.lower > whole.lower and domain.upper < whole.upper
