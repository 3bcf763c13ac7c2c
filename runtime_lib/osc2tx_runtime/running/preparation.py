"""Preparation of a run before its first step; `check` does the same."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.placing.entries import Entries, entering_actors
from osc2tx_runtime.domain.placing.rehearsal import AllEnteredError, Rehearsal, ways_in
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.actions.base_action import BaseAction
from osc2tx_runtime.language.context import ExecutionContext
from osc2tx_runtime.language.settings import RunSettings
from osc2tx_runtime.language.trace import TraceWriter
from osc2tx_runtime.language.tree.alternatives import choose_alternatives
from osc2tx_runtime.opendrive import RoadMap
from osc2tx_runtime.running.checked_world import checked_world
from osc2tx_runtime.running.loop import run_tree
from osc2tx_runtime.running.requirements import check_requirements
from osc2tx_runtime.running.world_choice import make_world
from osc2tx_runtime.world.embedded import EmbeddedWorld
from osc2tx_shared.classes import replace

if TYPE_CHECKING:
    from osc2tx_runtime.domain.monitoring.run import Monitors
    from osc2tx_runtime.domain.placing.entries import WayIn
    from osc2tx_runtime.domain.scenario import Scenario
    from osc2tx_runtime.language.tree.base import Behaviour
    from osc2tx_runtime.world.protocol import World


@contextmanager
def prepared(
    scenario_class: Callable[[RunSettings], Scenario],
    scenario: Scenario,
    root: Behaviour,
    world: World | None,
    read: Callable[[Path], RoadMap],
    trace: TraceWriter | None = None,
    *,
    is_last: bool,
) -> Iterator[tuple[ExecutionContext, Monitors]]:
    """Place the actors, set up the tree, and check what it requires; close the world at the end.

    Args:
        scenario_class: Creates further scenarios, for rehearsals.
        scenario: The scenario with its drawn values.
        root: Its tree.
        world: The world; default: that of the settings, on the scenario's map.
        read: Reads the map.
        trace: Takes the trace.
        is_last: Whether there are no other values to draw.

    Raises:
        BeyondMapError: The map certainly has no room for the request, unless it `is_last`.
        ScenarioError: The scenario cannot start.
    """
    settings = scenario.settings
    world = checked_world(world or make_world(scenario, read))
    try:
        context = make_context(scenario, world, trace)
        entering = [actor for actor in entering_actors(root) if actor not in settings.spawn]
        if entering:
            context.entries = Entries(rehearsed(scenario_class, settings, entering, world.map))
        place_actors(scenario, context)
        setup_tree(root, context)
        check_requirements(root, context)
        context.monitors = monitors = make_monitors(context)
        if not is_last:
            look_ahead(root)
        yield context, monitors
    finally:
        world.close()


def rehearsed(
    scenario_class: Callable[[RunSettings], Scenario],
    settings: RunSettings,
    actors: Sequence[str],
    road_map: RoadMap,
) -> dict[str, WayIn]:
    """Return the ways in of actors that enter, from rehearsals without output."""
    quiet = replace(settings, trace=None, report=None)

    def play(rehearsal: Rehearsal) -> None:
        scenario = scenario_class(quiet)
        root = scenario.create_tree()
        context = make_context(scenario, EmbeddedWorld(road_map, quiet.dt))
        context.entries, rehearsal.implied = rehearsal, scenario.implied_starts
        place_actors(scenario, context)
        setup_tree(root, context)
        with suppress(AllEnteredError, ScenarioError):  # the run itself reports the error
            run_tree(root, context, observer=rehearsal)

    return ways_in(play, actors, road_map, quiet.dt)


def make_monitors(context: ExecutionContext) -> Monitors:
    """Return the monitors of a run."""
    from osc2tx_runtime.domain.monitoring.run import Monitors

    return Monitors(context)


def look_ahead(root: Behaviour) -> None:
    """Let all actions check that the map has the elements that they require."""
    for node in root.iterate():
        if isinstance(node, BaseAction):
            node.look_ahead()


def make_context(
    scenario: Scenario, world: World, trace: TraceWriter | None = None
) -> ExecutionContext:
    """Return the context of a run."""
    settings = scenario.settings
    return ExecutionContext(
        world,
        settings,
        scenario.actors,
        events=scenario.events,
        objects=scenario.map_objects,
        trace=trace,
        label_events=scenario.label_events,
        one_of=scenario.one_of,
        first_come=scenario.first_come,
    )


def place_actors(scenario: Scenario, context: ExecutionContext) -> None:
    """Place the actors as the scenario states."""
    from osc2tx_runtime.domain.map.geodetic_points import check_globe
    from osc2tx_runtime.domain.placing.initializer import ScenarioInitializer
    from osc2tx_runtime.domain.scenario import bind_all

    bind_all(scenario, context)
    check_globe(scenario, context.world.map)
    ScenarioInitializer(context, scenario.map_objects).run(scenario.placements)


def setup_tree(root: Behaviour, context: ExecutionContext) -> None:
    """Set up all nodes with the context, members before their compositions."""
    choose_alternatives(root, context)
    for node in root.iterate():
        node.setup(context=context)
