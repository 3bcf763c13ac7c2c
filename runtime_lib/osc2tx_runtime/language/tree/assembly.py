"""Completes the tree of a scenario before it runs: names, overrides, variables, placements."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from functools import cache
from typing import TYPE_CHECKING

from osc2tx_runtime.errors import ScenarioError, UnsupportedError
from osc2tx_runtime.language.actions.action import Action
from osc2tx_runtime.language.actions.base_action import BaseAction
from osc2tx_runtime.language.declared import BaseActor
from osc2tx_runtime.language.settings import near
from osc2tx_runtime.language.source_map import SourceMap
from osc2tx_runtime.language.tree.base import Behaviour, Leaf, Node
from osc2tx_runtime.language.tree.compositions import Composition, Serial
from osc2tx_runtime.language.tree.conflicts import find_rivals
from osc2tx_runtime.language.tree.coverage import Recording
from osc2tx_runtime.language.tree.directives import Until
from osc2tx_runtime.language.tree.ending import End, Ending
from osc2tx_runtime.language.tree.events import Event
from osc2tx_runtime.language.tree.invocation import (
    Invocation,
    own_nodes,
    started_at_once,
    unique_name,
)
from osc2tx_runtime.language.tree.one_of import OneOf
from osc2tx_runtime.language.tree.override import Mode, guard
from osc2tx_runtime.language.tree.parallel import Parallel
from osc2tx_runtime.language.tree.variables import Sampling, SamplingStart

if TYPE_CHECKING:
    from osc2tx_runtime.language.actions.placement import Placement
    from osc2tx_runtime.language.scenario_parts import ScenarioParts


def assemble(scenario: ScenarioParts, tree: Behaviour) -> Behaviour:
    """Return the tree of a scenario, completed by names, positions and added nodes.

    The trees of invoked scenarios are already assembled.
    """
    apply_lines(tree, scenario._source_map)
    name_nodes(scenario, tree)
    for node in own_nodes(tree):
        node.scope, node.listeners = scenario._path, scenario.label_events
    for path, event in scenario._inner_events.items():
        event.alias = find_event(scenario, path)
    check_labels(scenario, tree)
    for overridden, by, mode in scenario._overrides:
        tree = with_override(scenario, tree, overridden, by, mode)
    ends = [node for node in own_nodes(tree) if isinstance(node, End)]
    if ends:
        tree = around(scenario, tree, Ending(tree, ends))
    if scenario.one_of == "race":
        for node in own_nodes(tree):
            if isinstance(node, OneOf):
                node.find_rivals = find_rivals  # called at setup, when slots are known
    services: list[Leaf] = []
    if variables := list(scenario._variables.values()):
        at_start = [variable for variable in variables if variable.trigger == "start"]
        if at_start:
            first = SamplingStart(at_start)
            first.source, first.scope = getattr(tree, "source", ""), scenario._path
            tree = around(scenario, tree, Serial(f"{tree.name}, sampled at its start", first, tree))
        if len(at_start) < len(variables):
            services.append(Sampling(variables, tree))
    if scenario._items:
        services.append(Recording(list(scenario._items.values()), scenario.name))
    return with_services(scenario, tree, services) if services else tree


def apply_lines(root: Behaviour, source_map: SourceMap) -> None:
    """Set the source positions of the nodes of a scenario and of the modifiers of its actions.

    The trees of invoked scenarios have their own source maps. If the source map does not match the
    tree, the nodes get the file without a line.
    """
    nodes = [node for node in own_nodes(root) if not node.synthetic]
    fits = len(nodes) == len(source_map.nodes)
    for node in own_nodes(root):
        node.source = source_map.file
    for index, entry in enumerate(source_map.nodes if fits else ()):
        node = nodes[index]
        node.source = source_map.place(entry)
        places = source_map.modifiers.get(index, ())
        if isinstance(node, Action) and len(places) == len(node.modifiers):
            known = (None if each is None else source_map.place(each) for each in places)
            node.modifier_sources = tuple(each or node.source for each in known)


def name_nodes(scenario: ScenarioParts, tree: Behaviour) -> None:
    """Set unique names of the nodes of a scenario, and the keys of their random values.

    The keys are names of the module: of the enclosing composition, and of the node or its activity.
    """
    names: dict[str, None] = {}
    draws: dict[str, None] = {}
    for node in in_order(tree, scenario._root.actors.values(), only_own=True):
        if not isinstance(node, Node):
            continue
        if not isinstance(node, Composition) and node.name != node.label:
            node.name = unique_name(node.name, names)
        what = node.action_name if isinstance(node, BaseAction) and not node.label else node.name
        node.draws = unique_name(f"{composition_around(node)}/{what}", draws)
        names[node.name] = draws[node.draws] = None


def composition_around(node: Behaviour) -> str:
    """Return the name of the composition of a node; empty for the root."""
    above = node.parent
    while above is not None and not isinstance(above, Composition):
        above = above.parent
    return "" if above is None else above.name


def check_labels(scenario: ScenarioParts, tree: Behaviour) -> None:
    """Report an awaited label that no node has."""
    known = {node.label for node in own_nodes(tree) if node.label}
    for label, moment in scenario.label_events:
        if label not in known:
            hint = near(label, known)
            raise ScenarioError(f"@{label}.{moment}: no node has this label{hint}", scenario.source)


def find_event(scenario: ScenarioParts, path: str) -> Event:
    """Return the event of a path: `near`, `cut.end`, or `p1.` before either.

    Raises:
        ScenarioError: There is none.
    """
    label, _, rest = path.partition(".")
    if not rest:
        if label in scenario.events:
            return scenario.events[label]
        hint = near(label, scenario.events)
        raise ScenarioError(f"@{path}: {scenario.name} has no such event{hint}", scenario.source)
    invoked = scenario._invoked.get(label)
    if rest in ("start", "end", "fail") and (invoked is None or rest not in invoked.events):
        return scenario._label_event(label, rest)
    return find_event(scenario.invoked(label), rest)


def find_node(scenario: ScenarioParts, tree: Behaviour, path: str) -> Node:
    """Return the node with a label, also `p1.cut` in an invoked scenario.

    Raises:
        ScenarioError: There is none.
    """
    label, _, rest = path.partition(".")
    by_label = {node.label: node for node in own_nodes(tree) if node.label}
    if label not in by_label:
        hint = near(label, by_label)
        raise ScenarioError(f"override: no node has the label {label}{hint}", scenario.source)
    node = by_label[label]
    if not rest:
        return node
    invocation = node.decorated if isinstance(node, Until) else node
    return find_node(scenario, invocation.children[0], rest)


def with_override(
    scenario: ScenarioParts, tree: Behaviour, overridden: str, by: str, mode: Mode
) -> Behaviour:
    """Return the tree with a guard around a behavior that another overrides."""
    if overridden == by:
        raise ScenarioError(f"override: {by} cannot override itself", scenario.source)
    around = guard(find_node(scenario, tree, overridden))
    around.add(find_node(scenario, tree, by), mode)
    return tree if around.parent is not None else around


def with_services(scenario: ScenarioParts, tree: Behaviour, services: list[Leaf]) -> Behaviour:
    """Return the tree in parallel with the nodes that sample variables and coverage items."""
    for service in services:
        service.source, service.scope = getattr(tree, "source", ""), scenario._path
    return around(scenario, tree, Parallel(f"{tree.name}, with what it samples", tree, *services))


def around(scenario: ScenarioParts, tree: Behaviour, whole: Node) -> Node:
    """Return a node around a tree that is not in the module."""
    whole.synthetic, whole.label = True, None
    whole.source, whole.scope = getattr(tree, "source", ""), scenario._path
    whole.listeners = scenario.label_events
    return whole


def invoked_placements(scenario: ScenarioParts, tree: Behaviour) -> list[Placement]:
    """Return the placements of the scenarios that start with a tree.

    Those of scenarios that start later become conditions on the start of their actions again.
    """
    found: list[Placement] = []
    race = scenario.one_of == "race"
    for node, at_once in started_at_once(tree, race):
        if not isinstance(node, Invocation):
            continue
        if at_once:
            found += node.scenario.placements
            continue
        for placement in node.scenario.placements:
            if placement.implied:
                found.append(placement)
            elif not placement.throughout:
                state_at_start(node, placement, race)
    return found


def state_at_start(invocation: Invocation, placement: Placement, race: bool) -> None:
    """State a placement at the first action of its actor.

    Raises:
        UnsupportedError: It has no action when the scenario starts.
    """
    for action, at_once in started_at_once(invocation, race):
        if not at_once or not isinstance(action, Action) or action.actor is not placement.actor:
            continue
        own = (*action.modifiers, *action.states_itself())
        stated = [m for m in placement.modifiers if m not in own]
        starts = [m.at_start() for m in stated if m.facts.rules.starts]
        if len(starts) == len(stated) and all(map(action.takes, starts)):
            action.state_at_start(starts, placement.source)
            return
    raise UnsupportedError(
        f"{invocation.name} places {placement.actor.id}, but does not start with the scenario; let"
        f" an action of {placement.actor.id} state it",
        placement.source,
    )


def number_nodes(scenario: ScenarioParts, tree: Behaviour) -> None:
    """Note the position of each node in the whole tree, those of invoked scenarios included."""
    for position, node in enumerate(in_order(tree, scenario.actors.values())):
        if isinstance(node, Node):
            node.position = position


def in_order(
    tree: Behaviour, actors: Iterable[BaseActor], *, only_own: bool = False
) -> list[Behaviour]:
    """Return the nodes of a tree, parents first, in an order independent of the source.

    Parallel members are ordered by the declaration of their actors, then by name, then by content:
    the order of the members in the module has no effect.

    Args:
        tree: The tree.
        actors: In the order of their declaration.
        only_own: Omit the nodes of invoked scenarios.
    """
    declared = {id(actor): index for index, actor in enumerate(actors)}

    @cache
    def key(member: Behaviour) -> tuple[int, str]:
        acting = [id(node.actor) for node in member.iterate() if isinstance(node, Action)]
        return (
            min((declared.get(actor, len(declared)) for actor in acting), default=-1),
            member.name,
        )

    @cache
    def content(member: Behaviour) -> list[tuple[int, str]]:
        return [key(node) for node in ordered(member)]

    def members(node: Behaviour) -> Iterable[Behaviour]:
        if not isinstance(node, Parallel | OneOf):
            return node.children
        keys = Counter(key(child) for child in node.children)
        return sorted(
            node.children,
            key=lambda child: (first := key(child), content(child) if keys[first] > 1 else []),
        )

    def ordered(start: Behaviour, only_own: bool = False) -> list[Behaviour]:
        found, waiting = [], [start]
        while waiting:
            node = waiting.pop()
            found.append(node)
            if not (only_own and isinstance(node, Invocation)):
                waiting += reversed([*members(node)])
        return found

    return ordered(tree, only_own)
