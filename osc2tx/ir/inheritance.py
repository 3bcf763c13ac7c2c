"""Inheritance between scenarios (§7.3.9): the additions of a scenario to its base.

A scenario of the IR is complete: it has all inherited members, narrowed by its constraints. For a
backend with inheritance, `additions` returns the additions of the scenario to its base.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from osc2tx.diagnostics import Span
from osc2tx.ir.behaviors import Behavior, CompositionBase
from osc2tx.ir.compare import field_names, means_same, same
from osc2tx.ir.coverage import Coverage
from osc2tx.ir.declarations import Actor, Constraint, Declaration, Method, Parameter, Struct
from osc2tx.ir.expressions import Expression, FieldRef, MethodCall, ScenarioSelf
from osc2tx.ir.nodes import AbstractScenario, Module, Placement, Scenario
from osc2tx.ir.values import ExpressionBase
from osc2tx.ir.verify import walk_behaviors
from osc2tx_shared.classes import dataclass, replace

NOT_COMPARED = ("comments", "end_comments")


@dataclass(frozen=True, slots=True, kw_only=True)
class Additions:
    """The additions of a scenario to its base.

    Attributes:
        ahead: New declarations that those of the base need here, and global parameters.
        narrowed: Declarations of the base that the scenario's constraints narrow, each as the base
            has it and as it is here. That of a value which the base draws or leaves open, and
            which is known here, may be a part of an object.
        early: Constants among those, which others of them read that the base declares before.
        declarations: New declarations.
        constraints: New constraints.
        coverage: New items, and those that are sampled differently.
        methods: New methods, and changed ones.
        placements: The additional placements, or all of them.
        places_anew: The placements replace those of the base.
        body: Its behavior; `None` if it is that of the base, or there is none.
    """

    ahead: tuple[Declaration, ...]
    narrowed: tuple[tuple[Declaration, Declaration], ...]
    early: frozenset[str]
    declarations: tuple[Declaration, ...]
    constraints: tuple[Constraint, ...]
    coverage: tuple[Coverage, ...]
    methods: tuple[Method, ...]
    placements: tuple[Placement, ...]
    places_anew: bool
    body: Behavior | None

    @classmethod
    def all_of(cls, scenario: AbstractScenario) -> Additions:
        """Return all that a scenario has, which inherits nothing."""
        return cls(
            ahead=(),
            narrowed=(),
            early=frozenset(),
            declarations=scenario.declarations,
            constraints=scenario.constraints,
            coverage=scenario.coverage,
            methods=scenario.methods,
            placements=scenario.placements,
            places_anew=True,
            body=scenario.body if isinstance(scenario, Scenario) else None,
        )


def additions(scenario: AbstractScenario, base: AbstractScenario) -> Additions | None:
    """Return the additions of a scenario to its base; `None` if it has to be declared as a whole.

    This is the case if a value of the base is computed from one that is declared later there, and
    is no constant here, or if it lacks a declaration or a coverage item of the base.

    Args:
        scenario: The complete scenario.
        base: Its complete base.
    """
    names = {each.name for each in base.declarations}
    added = tuple(each for each in scenario.declarations if each.name not in names)
    narrowed = _narrowed(scenario, base)
    sampled = {each.name for each in scenario.coverage}
    if narrowed is None or any(each.name not in sampled for each in base.coverage):
        return None
    bodies = {each.name: each.expression for each in scenario.methods}
    wanted = set(_reads((here for _, here in narrowed), added, bodies))
    ahead = tuple(d for d in added if d.name in wanted or getattr(d, "is_global", False))
    late = tuple(d for d in added if d not in ahead)
    early = _early(narrowed, bodies)
    if not _is_in_order(scenario, base, ahead, narrowed, early, late, bodies):
        return None
    places = _following(scenario.placements, base.placements)
    return Additions(
        ahead=ahead,
        narrowed=narrowed,
        early=early,
        declarations=late,
        constraints=_others(scenario.constraints, base.constraints),
        coverage=tuple(c for c in scenario.coverage if not _is_sampled_alike(c, base.coverage)),
        methods=_others(scenario.methods, base.methods),
        placements=scenario.placements if places is None else places,
        places_anew=places is None,
        body=_own_body(scenario, base),
    )


def without_bases(module: Module) -> Module:
    """Return a module whose scenarios inherit nothing: each has all that it inherits itself."""
    scenarios = tuple(replace(each, base=None) for each in module.scenarios)
    return replace(module, scenarios=scenarios, bases=())


def _narrowed(
    scenario: AbstractScenario, base: AbstractScenario
) -> tuple[tuple[Declaration, Declaration], ...] | None:
    """Return the declarations of the base that are otherwise here; `None` if they cannot be."""
    ours = {each.name: each for each in scenario.declarations}
    known = {each.name for each in base.declarations if each.name not in ours}
    values: dict[str, Expression] = {}
    changed: dict[str, Declaration] = {}
    for each in base.declarations:
        here = ours.get(each.name)
        if here is None or means_same(each, here):
            continue
        found: dict[str, Expression] = {}
        if _unify(each, here, known, found) and found:
            values |= found
        else:
            changed[each.name] = here
    if known - values.keys():
        return None
    pairs: list[tuple[Declaration, Declaration]] = []
    for each in base.declarations:
        if each.name in values and isinstance(each, Parameter):
            value = values[each.name]
            pairs.append((each, replace(each, value=value, domain=None, is_fixed=True)))
        elif each.name in changed:
            pairs.append((each, changed[each.name]))
    return tuple(pairs) if all(_can_narrow(*pair, base) for pair in pairs) else None


def _can_narrow(there: Declaration, here: Declaration, base: AbstractScenario) -> bool:
    """Whether a declaration of the base can be narrowed: values and objects, not their kind.

    A value that the base fixes is assigned anew, which nothing of the base may have read before.
    """
    match there, here:
        case (Actor(), Actor()):
            return there.lineage == here.lineage and there.is_given == here.is_given
        case (Struct(), Struct()):
            return there.lineage == here.lineage and (there.value is None) == (here.value is None)
        case (Parameter(is_fixed=True), Parameter(is_fixed=True)):
            return not any(there.name in _read_by(each) for each in base.declarations)
        case (Parameter(), Parameter()):
            return not there.is_fixed
        case _:
            return False


def _unify(there: Any, here: Any, known: set[str], found: dict[str, Expression]) -> bool:
    """Whether two parts are equal except for values that the base draws and that are known here.

    Args:
        there: The part as the base has it.
        here: The part as it is here.
        known: The names of those values.
        found: Filled with these values.
    """
    if isinstance(there, FieldRef) and there.name in known and isinstance(here, ExpressionBase):
        return same(found.setdefault(there.name, here), here)  # type: ignore[arg-type]
    if type(there) is not type(here):
        return False
    if isinstance(there, Span):
        return True
    if isinstance(there, tuple):
        pairs = zip(there, here, strict=False)
        return len(there) == len(here) and all(_unify(a, b, known, found) for a, b in pairs)
    if names := field_names(there):
        return all(
            _unify(getattr(there, name), getattr(here, name), known, found)
            for name in names
            if name not in NOT_COMPARED
        )
    return bool(there == here)


def _early(
    narrowed: Sequence[tuple[Declaration, Declaration]], bodies: Mapping[str, Expression | None]
) -> frozenset[str]:
    """Return the constants that narrow a declaration after one that reads them."""
    constants = {
        here.name
        for there, here in narrowed
        if isinstance(there, Parameter)
        and isinstance(here, Parameter)
        and here.is_fixed
        and not there.is_fixed
        and not _read_by(here, bodies)
    }
    found, before = set[str](), set[str]()
    for _, here in narrowed:
        found |= constants & before & {here.name}
        before |= _read_by(here, bodies)
    return frozenset(found)


def _is_in_order(
    scenario: AbstractScenario,
    base: AbstractScenario,
    ahead: Sequence[Declaration],
    narrowed: Iterable[tuple[Declaration, Declaration]],
    early: frozenset[str],
    late: Sequence[Declaration],
    bodies: Mapping[str, Expression | None],
) -> bool:
    """Whether the base can be declared first: each value is there when it is read.

    Declarations of one kind also keep the order that the scenario has as a whole, except constants,
    which are nowhere listed.
    """
    there_now = set(early)
    for each in ahead:
        if not set(_reads([each], scenario.declarations, bodies)) <= there_now:
            return False
        there_now.add(each.name)
    changed = {here.name: here for _, here in narrowed}
    for each in base.declarations:
        here = changed.get(each.name)
        if here is not None and not (
            set(_reads([here], scenario.declarations, bodies)) <= there_now
        ):
            return False
        there_now.add(each.name)
    whole = {each.name: each for each in scenario.declarations}
    inherited = (whole[each.name] for each in base.declarations if each.name in whole)
    declared = [each for each in (*ahead, *inherited, *late) if not _is_constant(each)]
    kinds = {type(each) for each in declared}
    return all(
        [each.name for each in declared if type(each) is kind]
        == [d.name for d in scenario.declarations if type(d) is kind and not _is_constant(d)]
        for kind in kinds
    )


def _is_constant(declaration: Declaration) -> bool:
    return isinstance(declaration, Parameter) and declaration.is_fixed


def _reads(
    declarations: Iterable[Declaration],
    among: Iterable[Declaration],
    bodies: Mapping[str, Expression | None],
) -> Iterator[str]:
    """Yield the names of declarations that others read, directly or through others."""
    by_name = {each.name: each for each in among}
    pending: list[Any] = list(declarations)
    seen = set[str]()
    while pending:
        for name in _read_by(pending.pop(), bodies):
            if name not in seen and name in by_name:
                seen.add(name)
                yield name


def _read_by(part: Any, bodies: Mapping[str, Expression | None] | None = None) -> set[str]:
    """Return the names of the fields in a part of the IR, also in methods that it calls."""
    names, called = set[str](), set[str]()
    pending: list[Any] = [part]
    while pending:
        each = pending.pop()
        if isinstance(each, FieldRef):
            names.add(each.name)
        is_own_call = isinstance(each, MethodCall) and isinstance(each.base, ScenarioSelf)
        if is_own_call and bodies and each.method not in called:
            called.add(each.method)
            pending.append(bodies.get(each.method))
        if isinstance(each, tuple):
            pending += each
        elif not isinstance(each, Span):
            pending += [getattr(each, name) for name in field_names(each)]
    return names


def _others(ours: Sequence[Any], inherited: Sequence[Any]) -> tuple[Any, ...]:
    """Return the parts that are not inherited unchanged."""
    return tuple(each for each in ours if not any(same(each, other) for other in inherited))


def _is_sampled_alike(item: Coverage, inherited: Iterable[Coverage]) -> bool:
    """Whether an item is inherited, for any values that constraints leave to it here."""
    plain = replace(item, graded=(), impossible=())
    return any(same(plain, replace(each, graded=(), impossible=())) for each in inherited)


def _following(
    ours: Sequence[Placement], inherited: Sequence[Placement]
) -> tuple[Placement, ...] | None:
    """Return the placements in addition to those of the base; `None` if these differ."""
    first, rest = ours[: len(inherited)], ours[len(inherited) :]
    is_same = len(first) == len(inherited) and all(map(same, first, inherited))
    return tuple(rest) if is_same else None


def _own_body(scenario: AbstractScenario, base: AbstractScenario) -> Behavior | None:
    """Return the behavior of a scenario, if it is not that of its base."""
    if not isinstance(scenario, Scenario):
        return None
    if not isinstance(base, Scenario):
        return scenario.body
    one, other = _unnamed(scenario), _unnamed(base)
    is_same = same(one, other) and same(scenario.overrides, base.overrides)
    return None if is_same else scenario.body


def is_named_after(scenario: Scenario) -> bool:
    """Whether the root of the tree has the name of the scenario."""
    body, name = scenario.body, scenario.name.rpartition(".")[2]
    is_unlabelled = isinstance(body, CompositionBase) and body.label is None and body.name == name
    return is_unlabelled and all(each.label != name for each in walk_behaviors(body))


def _unnamed(scenario: Scenario) -> Behavior:
    body: Any = scenario.body
    return replace(body, name="") if is_named_after(scenario) else scenario.body
