"""Checks of the actors of a scenario: map, start position and start speed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field

from osc2tx.analysis.constraints.propagation import ConstraintAnalysis, State, analyse_global
from osc2tx.analysis.library_facts import entry_of, is_library_actor, library_modifiers
from osc2tx.analysis.same_actors import same_actors
from osc2tx.analysis.tree_walk import do_directives, do_members
from osc2tx.catalogue import catalogue
from osc2tx.diagnostics import Span
from osc2tx.semantics import SemanticModel, types
from osc2tx.semantics import symbols as sym
from osc2tx.semantics.scope import supertypes
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass


@dataclass(slots=True, eq=False)
class _Part:
    """The first action of an actor.

    Attributes:
        has_place: Whether its start position is stated.
        has_pace: Whether its start speed is stated.
        is_settled: Whether the first action that takes time was visited.
    """

    has_place: bool = False
    has_pace: bool = False
    is_settled: bool = False


@dataclass(slots=True, eq=False)
class _Cast:
    parts: dict[sym.FieldSymbol, _Part] = field(default_factory=dict)
    maps: list[sym.FieldSymbol] = field(default_factory=list)


def openings_of_cast(
    model: SemanticModel, scenario: sym.ScenarioSymbol, constraints: ConstraintAnalysis
) -> Iterator[tuple[str, Span]]:
    """Yield the open values of the actors of a scenario."""
    if scenario.actor is not None:
        yield f"the {scenario.actor.name} that does it", scenario.node.name.span
    cast = _find_cast(model, scenario)
    same = same_actors(constraints.types[scenario])
    for actor, is_ in same.items():
        if actor in cast.parts and is_.other in cast.parts:
            cast.parts[actor] = cast.parts[is_.other]
    for ancestor in supertypes(scenario):
        for statement in ancestor.statements:
            if isinstance(statement, ast.ModifierApplication):
                for modifier in library_modifiers(model, statement):
                    _look_at_modifier(model, cast, statement.actor, modifier)
    for directive in do_directives(scenario):
        for member in do_members(directive.member):
            if isinstance(member, ast.Invocation):
                _look_at_invocation(model, cast, member)
    if cast.parts and not any(_has_file(model, scenario, m, constraints) for m in cast.maps):
        yield "map file", scenario.node.name.span
    for actor, part in cast.parts.items():
        if actor in same:
            continue
        if not part.has_place and not _has_pose(scenario, actor, constraints):
            yield f"place of {actor.name}", actor.span
        if not part.has_pace and part.is_settled:
            yield f"speed of {actor.name}", actor.span


def _find_cast(model: SemanticModel, scenario: sym.ScenarioSymbol) -> _Cast:
    cast = _Cast()
    own = (m for t in reversed(list(supertypes(scenario))) for m in t.members.values())
    for member in (*model.global_parameters, *own):
        if not isinstance(member, sym.FieldSymbol) or not isinstance(member.type, types.ActorType):
            continue
        actor = member.type.symbol
        if is_library_actor(actor, "map"):
            cast.maps.append(member)
        elif is_library_actor(actor, "physical_object"):
            has_pace = not is_library_actor(actor, "movable_object")
            cast.parts[member] = _Part(has_pace=has_pace)
    return cast


def _part_of(model: SemanticModel, cast: _Cast, actor: ast.Expression | None) -> _Part | None:
    symbol = model.symbol_of(actor) if actor is not None else None
    return cast.parts.get(symbol) if isinstance(symbol, sym.FieldSymbol) else None


def _look_at_modifier(
    model: SemanticModel,
    cast: _Cast,
    actor: ast.Expression | None,
    node: ast.ModifierApplication,
) -> None:
    part = _part_of(model, cast, actor)
    binding = model.bindings.get(node)
    if binding is None:
        return
    if node.modifier.text == "tow_trailer":  # a towed trailer is behind its towing vehicle
        for _, value in binding.arguments:
            _settle(_part_of(model, cast, value))
    if part is None or part.is_settled:
        return
    at = next((value for p, value in binding.arguments if p.name == "at"), None)
    entry = catalogue().modifiers.get(node.modifier.text)
    if entry is None:
        return
    part.has_pace |= entry.paces
    if at is None or at.span.text.rpartition("!")[2] != "end":
        part.has_place |= entry.places


def _look_at_invocation(model: SemanticModel, cast: _Cast, node: ast.Invocation) -> None:
    binding = model.bindings.get(node)
    if binding is None:
        return
    callee = binding.callee
    if not isinstance(callee, sym.ActionSymbol) or callee.origin == "user":
        for _, value in binding.arguments:  # its own members decide about its actors
            _settle(_part_of(model, cast, value))
        _settle(_part_of(model, cast, node.actor))
        return
    for member in node.with_members:
        if isinstance(member, ast.ModifierApplication):
            for modifier in library_modifiers(model, member):
                whose = member.actor if member.actor is not None else node.actor
                _look_at_modifier(model, cast, whose, modifier)
    part = _part_of(model, cast, node.actor)
    if part is None or part.is_settled:
        return
    entry = entry_of(callee)
    if entry is not None:
        part.has_place |= entry.places
        part.has_pace |= entry.paces
        part.is_settled = not entry.is_momentary


def _settle(part: _Part | None) -> None:
    if part is not None:
        part.has_place = part.has_pace = part.is_settled = True


def _has_file(
    model: SemanticModel,
    scenario: sym.ScenarioSymbol,
    map_: sym.FieldSymbol,
    constraints: ConstraintAnalysis,
) -> bool:
    """Whether the road network is stated."""
    is_global = map_ in model.global_parameters
    of_global = [analyse_global(model, map_)] if is_global else []
    for found in (constraints.types[scenario], *of_global):
        for key in found.by_key:
            match key:
                case (root, sym.FieldSymbol(name="map_file") as file) if root is map_:
                    return found.parameter(key, file.type).state is not State.FREE
                case _:
                    continue
    return any(
        isinstance(statement, ast.ModifierApplication)
        and statement.modifier.text == "set_map_file"
        and statement.actor is not None
        and model.symbol_of(statement.actor) is map_
        for ancestor in supertypes(scenario)
        for statement in ancestor.statements
    )


def _has_pose(
    scenario: sym.ScenarioSymbol, actor: sym.FieldSymbol, constraints: ConstraintAnalysis
) -> bool:
    return any(
        key[0] is actor and len(key) > 1 and getattr(key[1], "name", "") in ("pose", "position")
        for key in constraints.types[scenario].by_key
    )
