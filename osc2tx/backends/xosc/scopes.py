"""Scopes: a scenario and those that it invokes, each with its own names.

The XML has one level of names, so an invoked scenario is written down in place: its cast is that of
the invoker where it is handed in, its other actors and its events get the label of the invocation
in front of their names.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from dataclasses import field
from typing import NamedTuple

from osc2tx import ir
from osc2tx.backends.xosc.entities.cast import CastMember, cast_member
from osc2tx.backends.xosc.names import Deed, deeds
from osc2tx.backends.xosc.values.constants import Constant, Named
from osc2tx.backends.xosc.values.folding import Values
from osc2tx.backends.xosc.values.objects import types_of
from osc2tx.ir.starts import starts_at_actions
from osc2tx.losses.entries import Inexpressible, Remedy
from osc2tx.xosc.names import Names
from osc2tx_shared.classes import dataclass, replace


@dataclass(slots=True, eq=False)
class Scope:
    """A scenario as it is written down at one place.

    Attributes:
        scenario: The scenario.
        values: Its constants.
        cast: Its physical actors, by their names in it.
        prefix: Before the names of what is its own.
        path: Labels of the invocations down to it, for keys of parameters.
        inner: Scopes of the scenarios that it invokes, by the span of the invocation.
        undecided: Why it is open which conditional scenario an invocation runs; likewise.
        by_label: The same by label.
        deeds: How often its members do the same.
        own: Those of its cast that nobody has handed in.
        is_first: It begins with the run.
    """

    scenario: ir.Scenario
    values: Values
    cast: dict[str, CastMember]
    prefix: str
    path: str
    deeds: Mapping[Deed, int]
    inner: dict[Hashable, Scope] = field(default_factory=dict)
    undecided: dict[Hashable, Inexpressible] = field(default_factory=dict)
    by_label: dict[str, Scope] = field(default_factory=dict)
    own: list[CastMember] = field(default_factory=list)
    is_first: bool = True

    def of(self, node: ir.InvokeScenario) -> Scope:
        """Return the scope of an invoked scenario.

        Raises:
            Inexpressible: It is a scenario around it, or which one it is depends on the run.
        """
        if node.span in self.undecided:
            raise self.undecided[node.span]
        if node.span not in self.inner:
            raise Inexpressible(
                f"`{node.scenario}` invokes itself, and OpenSCENARIO XML has no recursion",
                node.span,
            )
        return self.inner[node.span]

    def all(self) -> list[Scope]:
        """Return this scope and those below it, outer ones first."""
        return [self, *(scope for inner in self.inner.values() for scope in inner.all())]

    def members(self) -> list[CastMember]:
        """Return all entities, those of this scenario first."""
        return [member for scope in self.all() for member in scope.own]


MOST_MEMBERS = 5_000
"""Members of a document, with those of invoked scenarios: each is written in place."""

MOST_INVOKED = 2_000
"""Those of invoked scenarios alone, of which a short text can have any number."""

MOST_DEPTH = 30
"""Scenarios in each other; the verifier refuses those that invoke themselves."""


def open_scopes(
    scenario: ir.Scenario, module: ir.Module, chosen: Mapping[str, Constant] | None = None
) -> Scope:
    """Return the scope of a scenario, with those of what it invokes.

    Chosen are values of open parameters, by their keys.

    Raises:
        Inexpressible: It is too large with the scenarios that it invokes.
    """
    return _Opener(module, chosen or {}).open(scenario, {}, {}, _Place("", "", (scenario.key,)))


def key_of(path: str, parameter: ir.Parameter) -> str:
    """Return what tells a parameter of a scope apart; a global one is the same everywhere."""
    if parameter.is_global:
        return ir.setting_name(parameter.name)
    return f"{path}.{parameter.name}" if path else parameter.name


def chosen_key(node: ir.InvokeScenario, values: Values) -> str:
    """Return the key of the scenario that an invocation runs, by the values of its arguments."""
    given = {argument.parameter: argument.value for argument in node.arguments}
    for special in node.specials:
        if all(values.of(given[v.parameter]) == values.of(v.value) for v in special.values):
            return special.key
    return node.key


class _Place(NamedTuple):
    """Where a scenario is invoked: see `Scope`; `around` are its key and those around it."""

    prefix: str
    path: str
    around: tuple[str, ...]
    is_first: bool = True


class _Opener:
    def __init__(self, module: ir.Module, chosen: Mapping[str, Constant]) -> None:
        self._by_key = {scenario.key: scenario for scenario in module.scenarios}
        self._types = types_of(module)
        self._names = Names()  # `|my car|` and `my_car` are two actors
        self._paths = Names()
        self._chosen = chosen
        self._shared: dict[str, CastMember] = {}  # global actors
        self._invoked = 0  # members of invoked scenarios

    def open(
        self,
        scenario: ir.Scenario,
        given: Mapping[str, Constant],
        handed_in: Mapping[str, CastMember],
        place: _Place,
        unknown: Mapping[str, Inexpressible] | None = None,
    ) -> Scope:
        nodes = ir.walk_behaviors(scenario.body)
        self._invoked += len(nodes) if place.path else 0
        is_large = len(nodes) > MOST_MEMBERS or self._invoked > MOST_INVOKED
        if is_large or len(place.around) > MOST_DEPTH:
            raise Inexpressible(
                f"with invoked scenarios in place, a document would have more than {MOST_INVOKED}"
                f" of their members, {MOST_MEMBERS} in all or {MOST_DEPTH} levels",
                scenario.span,
                Remedy(instead="a document for each of the scenarios that it invokes is exact"),
            )
        keys = {
            d.name: key_of(place.path, d)
            for d in scenario.declarations
            if isinstance(d, ir.Parameter)
        }
        chosen = {n: self._chosen[key] for n, key in keys.items() if key in self._chosen}
        values = Values(scenario, self._types, {**chosen, **given}, unknown or {})
        done = deeds(scenario)
        scope = Scope(
            scenario,
            values,
            dict(handed_in),
            place.prefix,
            place.path,
            done,
            is_first=place.is_first,
        )
        for declaration in scenario.declarations:
            if isinstance(declaration, ir.Actor) and declaration.name not in handed_in:
                self._join(declaration, scope)
        for node in nodes:
            if isinstance(node, ir.InvokeScenario):
                try:
                    callee = self._by_key[chosen_key(node, scope.values)]
                except Inexpressible as error:
                    scope.undecided[node.span] = error
                    continue
                if callee.key in place.around:
                    continue
                is_first = place.is_first and ir.is_first(scenario.body, node)
                if not is_first:
                    callee = starts_at_actions(callee)
                self._invoke(node, callee, scope, place.around, is_first=is_first)
        return scope

    def _join(self, actor: ir.Actor, scope: Scope) -> None:
        """Add an actor to the cast; a global one is the same everywhere."""
        shared = ir.setting_name(actor.name) if actor.is_global else None
        member = None if shared is None else self._shared.get(shared)
        if member is None:
            member = cast_member(actor, shared or scope.prefix + actor.name, scope.values)
            if member is None:
                return
            member = replace(member, name=self._names.new(member.name))
            scope.own.append(member)
            if shared is not None:
                self._shared[shared] = member
        scope.cast[actor.name] = member
        scope.values.sizes[actor.name] = member.sizes

    def _invoke(
        self,
        node: ir.InvokeScenario,
        callee: ir.Scenario,
        scope: Scope,
        around: tuple[str, ...],
        *,
        is_first: bool,
    ) -> None:
        label = node.label or node.scenario.rpartition(".")[2]
        given = scope.values.given_below(f"{label}.")
        unknown: dict[str, Inexpressible] = {}
        handed_in: dict[str, CastMember] = {}
        arguments = [(each.parameter, each.value) for each in (*node.arguments, *node.times)]
        if node.actor is not None:
            arguments.append(("actor", node.actor))
        for name, expression in arguments:
            try:
                value = scope.values.of(expression)
            except Inexpressible as error:
                unknown[name] = error  # where it is used it is reported
                continue
            if isinstance(value, Named) and value.name in scope.cast:
                handed_in[name] = scope.cast[value.name]
            else:
                given[name] = value
        path = self._paths.new(f"{scope.path}_{label}" if scope.path else label)
        place = _Place(f"{scope.prefix}{label}_", path, (*around, callee.key), is_first)
        inner = self.open(callee, given, handed_in, place, unknown)
        scope.inner[node.span] = inner
        if node.label is not None:
            scope.by_label[node.label] = inner
