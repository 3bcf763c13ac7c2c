"""Runs a scenario, from the settings to the verdict and its files; the loop itself is in `loop`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import asdict, field
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from osc2tx_runtime.domain.placing.entries import Entries, entering_actors
from osc2tx_runtime.domain.placing.rehearsal import AllEnteredError, Rehearsal, ways_in
from osc2tx_runtime.errors import BeyondMapError, ScenarioError
from osc2tx_runtime.language.actions.base_action import BaseAction
from osc2tx_runtime.language.context import ExecutionContext
from osc2tx_runtime.language.settings import RunSettings
from osc2tx_runtime.language.trace import TraceWriter
from osc2tx_runtime.opendrive import RoadMap, read_map
from osc2tx_runtime.running.checked_world import checked_world
from osc2tx_runtime.running.loop import Observer, OnProgress, overloads, run_tree
from osc2tx_runtime.running.output_files import check_outputs
from osc2tx_runtime.running.requirements import check_requirements
from osc2tx_runtime.running.run_outputs import RunOutputs
from osc2tx_runtime.running.world_choice import make_world
from osc2tx_runtime.world.embedded import EmbeddedWorld
from osc2tx_shared.classes import dataclass, replace

if TYPE_CHECKING:
    from osc2tx_runtime.domain.monitoring.phase import Violation
    from osc2tx_runtime.domain.monitoring.run import Monitors
    from osc2tx_runtime.domain.placing.entries import WayIn
    from osc2tx_runtime.domain.scenario import Scenario
    from osc2tx_runtime.language.tree.base import Behaviour
    from osc2tx_runtime.world.protocol import World

REDRAWS = 100  # draws of one seed, where the map has no room for the drawn values


@dataclass(frozen=True, slots=True)
class RunResult:
    """How a run ended.

    Attributes:
        status: `success`, `failure` or `timeout`.
        reason: Empty for success.
        steps: Steps the world made.
        time: Simulated seconds.
        trace_lines: Lines of the trace, without line ends, if they are kept.
        digest: SHA-256 of the trace, if it is asked for.
        collisions: Time in seconds and the two actors of each new contact.
        warnings: Warnings of a run that continues all the same.
        place: Position of the failed element in the scenario; empty where it has none.
        violations: Conditions that did not hold in their phases.
    """

    status: str
    reason: str
    steps: int
    time: float
    trace_lines: tuple[str, ...] = ()
    collisions: tuple[tuple[float, str, str], ...] = field(default=())
    warnings: tuple[str, ...] = ()
    place: str = ""
    violations: tuple[Violation, ...] = ()
    digest: str | None = None


def run_scenario(
    scenario_class: Callable[[RunSettings], Scenario],
    settings: RunSettings | None = None,
    on_progress: OnProgress | None = None,
    *,
    world: World | None = None,
    keep_trace: bool = True,
    digest: bool = False,
    observer: Observer | None = None,
    read: Callable[[Path], RoadMap] = read_map,
) -> RunResult:
    """Run a scenario from its placement to its verdict.

    Args:
        scenario_class: A generated class.
        settings: Of the run.
        on_progress: Called about once per simulated second with time and `max_time`, in seconds.
        world: The world to run in; by default the one of the settings, on the scenario's map. It
            is closed at the end.
        keep_trace: Keep the lines of the trace; memory then grows with the length of the run.
        digest: Compute the digest of the trace.
        observer: Observes the run.
        read: Reads the map; callers with many runs can cache it.

    Raises:
        ScenarioError: If the scenario cannot start, or cannot continue.
    """
    settings = settings or RunSettings()
    check_outputs(settings)
    outputs = partial(RunOutputs, keep_lines=keep_trace, digest=digest)
    run = partial(_run, scenario_class, on_progress, observer, read, outputs)
    may_redraw = world is None and settings.world == "embedded" and settings.draws is None
    for draw in range(REDRAWS if may_redraw else 0):
        scenario = scenario_class(replace(settings, draw=settings.draw + draw))
        try:
            return run(scenario, None, is_last=False)
        except BeyondMapError:
            if not scenario.has_drawn_values:
                break
    scenario = scenario_class(settings)
    return run(scenario, world, is_last=True)


def _run(
    scenario_class: Callable[[RunSettings], Scenario],
    on_progress: OnProgress | None,
    observer: Observer | None,
    read: Callable[[Path], RoadMap],
    outputs_of: Callable[[RunSettings], RunOutputs],
    scenario: Scenario,
    world: World | None,
    *,
    is_last: bool,
) -> RunResult:
    """Run a scenario with the values that are drawn.

    Raises:
        BeyondMapError: The map surely has no room for the request, unless it `is_last`.
    """
    root, settings = scenario.create_tree(), scenario.settings
    outputs = outputs_of(settings)
    on_sample = None if observer is None else observer.sampled
    world = checked_world(world or make_world(scenario, read))
    try:
        context = make_context(scenario, world, TraceWriter(*outputs.takers, on_sample=on_sample))
        entering = [actor for actor in entering_actors(root) if actor not in settings.spawn]
        if entering:
            context.entries = Entries(rehearsed(scenario_class, settings, entering, world.map))
        place_actors(scenario, context)
        setup_tree(root, context)
        check_requirements(root, context)
        context.monitors = monitors = make_monitors(context)
        if not is_last:
            look_ahead(root)
        try:
            write_header(scenario, context)
            world.begin()
            outcome = run_tree(root, context, on_progress, observer)
        finally:
            outputs.close(world.map)
    finally:
        world.close()
    return RunResult(
        outcome.status,
        outcome.reason,
        outcome.steps,
        outcome.steps * context.dt,
        tuple(outputs.lines),
        tuple(context.collisions),
        (*map_warnings(world.map), *world.warnings(), *overloads(context)),
        outcome.place,
        tuple(monitors.violations),
        None if outputs.digest is None else str(outputs.digest),
    )


def rehearsed(
    scenario_class: Callable[[RunSettings], Scenario],
    settings: RunSettings,
    actors: Sequence[str],
    road_map: RoadMap,
) -> dict[str, WayIn]:
    """Return how actors enter that come later, from rehearsals without any output."""
    quiet = replace(settings, trace=None, report=None)

    def play(rehearsal: Rehearsal) -> None:
        scenario = scenario_class(quiet)
        root = scenario.create_tree()
        context = make_context(scenario, EmbeddedWorld(road_map, quiet.dt))
        context.entries = rehearsal
        place_actors(scenario, context)
        setup_tree(root, context)
        with suppress(AllEnteredError, ScenarioError):  # what is wrong, the run itself tells
            run_tree(root, context, observer=rehearsal)

    return ways_in(play, actors, road_map, quiet.dt)


def make_monitors(context: ExecutionContext) -> Monitors:
    """Return the monitors of a run."""
    from osc2tx_runtime.domain.monitoring.run import Monitors

    return Monitors(context)


def look_ahead(root: Behaviour) -> None:
    """Let every action check that the map has the elements it requires."""
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
    """Put the actors where the scenario wants them."""
    from osc2tx_runtime.domain.map.geodetic_points import check_globe
    from osc2tx_runtime.domain.placing.initializer import ScenarioInitializer
    from osc2tx_runtime.domain.scenario import bind_all

    bind_all(scenario, context)
    check_globe(scenario, context.world.map)
    ScenarioInitializer(context, scenario.map_objects).run(scenario.placements)


def setup_tree(root: Behaviour, context: ExecutionContext) -> None:
    """Give every node the context, members before their compositions."""
    for node in root.iterate():
        node.setup(context=context)


def write_header(scenario: Scenario, context: ExecutionContext) -> None:
    """Write the first line of the trace."""
    actors = {}
    for actor_id in context.cast():
        state = context.world.state(actor_id)
        actors[actor_id] = {
            "kind": context.actors[actor_id].kinds[0],
            "length": state.length,
            "width": state.width,
            "height": state.height,
            "rear": state.rear,
        }
    world = context.world
    header = {
        "scenario": scenario.name,
        "source": scenario.source,
        "map": context.world.map.name,
        "dt": context.dt,
        "seed": context.settings.seed,
        "parameters": dict(sorted(scenario.parameters.items(), key=_path)),
        "actors": actors,
        "one_of": scenario.one_of,
    }
    if scenario.parameter_units:
        units = sorted(scenario.parameter_units.items(), key=_path)
        header["units"] = {name: asdict(unit) for name, unit in units}
    if context.settings.conduct != "as_told":
        header["conduct"] = context.settings.conduct
    if context.settings.physics != "warn":
        header["physics"] = context.settings.physics
    if context.settings.fail_on:
        header["fail_on"] = list(context.settings.fail_on)
    if world.name != "embedded":
        header["world"] = world.name
    controls = {actor: world.control(actor) for actor in context.cast()}
    if any(control != "exact" for control in controls.values()):
        header["control"] = controls
    context.trace.header(header)


def _path(parameter: tuple[str, Any]) -> str:
    """The owner of a parameter: own ones first, those of invocations by path."""
    return parameter[0].rpartition(".")[0]


_NAMED = 3  # remarks; `osc2tx map` lists all


def map_warnings(road_map: RoadMap) -> tuple[str, ...]:
    """Return a sentence for each of the first remarks, and one for all seams."""
    name, remarks, seams = road_map.name, road_map.remarks, road_map.seams()
    found = [f"map {name}: {remark}" for remark in remarks[:_NAMED]]
    if len(remarks) > _NAMED:
        found.append(f"map {name}: {len(remarks) - _NAMED} more remarks; `osc2tx map` lists them")
    if seams:
        worst = max(seams, key=lambda seam: (seam.gap, seam.turn))
        found.append(
            f"map {name}: lanes do not fit together at {len(seams)} places, worst {worst};"
            " `osc2tx map` lists them"
        )
    return tuple(found)
