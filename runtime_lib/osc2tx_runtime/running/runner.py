"""Runs a scenario, from the settings to the verdict and its files; the loop itself is in `loop`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import asdict, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

from osc2tx_runtime.domain.placing.entries import Entries, entering_actors
from osc2tx_runtime.domain.placing.rehearsal import AllEnteredError, Rehearsal, ways_in
from osc2tx_runtime.errors import BeyondMapError, ScenarioError
from osc2tx_runtime.language.actions.base_action import BaseAction
from osc2tx_runtime.language.context import ExecutionContext
from osc2tx_runtime.language.settings import RunSettings
from osc2tx_runtime.language.trace import TraceWriter
from osc2tx_runtime.opendrive import RoadMap, read_map
from osc2tx_runtime.running.checked_world import checked_world
from osc2tx_runtime.running.loop import Observer, OnProgress, Outcome, overloads, run_tree
from osc2tx_runtime.running.output_files import check_outputs, write_output
from osc2tx_runtime.running.requirements import check_requirements
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

ResultT = TypeVar("ResultT", covariant=True)

REDRAWS = 100  # draws of one seed, where the map has no room for the drawn values


@dataclass(frozen=True, slots=True)
class RunResult:
    """How a run ended.

    Attributes:
        status: `success`, `failure` or `timeout`.
        reason: Empty for success.
        steps: Steps the world made.
        time: Simulated seconds.
        trace_lines: Lines of the trace, without line ends.
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


def run_scenario(
    scenario_class: Callable[[RunSettings], Scenario],
    settings: RunSettings | None = None,
    on_progress: OnProgress | None = None,
    *,
    world: World | None = None,
    keep_trace: bool = True,
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
        keep_trace: Keep the lines of the trace even if no file is requested.
        observer: Observes the run.
        read: Reads the map; callers with many runs can cache it.

    Raises:
        ScenarioError: If the scenario cannot start, or cannot continue.
    """
    settings = settings or RunSettings()
    check_outputs(settings)

    def run(scenario: Scenario, *, is_last: bool) -> RunResult:
        made = prepared(
            *(scenario_class, scenario, world, read),
            keep_trace=keep_trace,
            observer=observer,
            is_last=is_last,
        )
        with made as (root, context, monitors):
            return _run(scenario, root, context, monitors, on_progress, observer)

    may_redraw = world is None and settings.world == "embedded"
    return _with_draws(scenario_class, settings, run, may_redraw=may_redraw)


def check_start(
    scenario_class: Callable[[RunSettings], Scenario],
    settings: RunSettings,
    read: Callable[[Path], RoadMap] = read_map,
) -> RunResult:
    """Do what a run does before its first step, in the embedded world and without outputs.

    Args:
        scenario_class: A generated class.
        settings: Of the run.
        read: Reads the map.

    Returns:
        How it ended; `timeout` if the run would go on.

    Raises:
        ScenarioError: What the run would refuse.
    """
    quiet = replace(settings, trace=None, report=None)

    def start(scenario: Scenario, *, is_last: bool) -> RunResult:
        made = prepared(scenario_class, scenario, None, read, keep_trace=False, is_last=is_last)
        with made as (root, context, monitors):
            return _result(run_tree(root, context, last_step=0), context, monitors)

    return _with_draws(scenario_class, quiet, start, may_redraw=True)


class _Play(Protocol[ResultT]):
    """Plays a scenario with the values that are drawn; `BeyondMapError` ends all but the last."""

    def __call__(self, scenario: Scenario, *, is_last: bool) -> ResultT: ...


def _with_draws(
    scenario_class: Callable[[RunSettings], Scenario],
    settings: RunSettings,
    play: _Play[ResultT],
    *,
    may_redraw: bool,
) -> ResultT:
    """Play a scenario with the first values that the map surely has room for, else the first."""
    for draw in range(REDRAWS if may_redraw and settings.draws is None else 0):
        scenario = scenario_class(replace(settings, draw=settings.draw + draw))
        try:
            return play(scenario, is_last=False)
        except BeyondMapError:
            if not scenario.has_drawn_values:
                break
    return play(scenario_class(settings), is_last=True)


@contextmanager
def prepared(
    scenario_class: Callable[[RunSettings], Scenario],
    scenario: Scenario,
    world: World | None,
    read: Callable[[Path], RoadMap],
    *,
    keep_trace: bool,
    is_last: bool,
    observer: Observer | None = None,
) -> Iterator[tuple[Behaviour, ExecutionContext, Monitors]]:
    """Place the actors, set up the tree, and check what it requires; close the world at the end.

    Raises:
        BeyondMapError: The map surely has no room for the request, unless it `is_last`.
        ScenarioError: The scenario cannot start.
    """
    root, settings = scenario.create_tree(), scenario.settings
    world = checked_world(world or make_world(scenario, read))
    try:
        context = make_context(scenario, world, keep_trace, observer)
        entering = [actor for actor in entering_actors(root) if actor not in settings.spawn]
        if entering:
            context.entries = Entries(rehearsed(scenario_class, settings, entering, world.map))
        place_actors(scenario, context)
        setup_tree(root, context)
        check_requirements(root, context)
        context.monitors = monitors = make_monitors(context)
        if not is_last:
            look_ahead(root)
        yield root, context, monitors
    finally:
        world.close()


def _run(
    scenario: Scenario,
    root: Behaviour,
    context: ExecutionContext,
    monitors: Monitors,
    on_progress: OnProgress | None,
    observer: Observer | None,
) -> RunResult:
    """Run what is prepared."""
    world = context.world
    try:
        write_header(scenario, context)
        world.begin()
        outcome = run_tree(root, context, on_progress, observer)
    finally:
        write_files(context)
    return _result(outcome, context, monitors)


def _result(outcome: Outcome, context: ExecutionContext, monitors: Monitors) -> RunResult:
    world = context.world
    return RunResult(
        outcome.status,
        outcome.reason,
        outcome.steps,
        outcome.steps * context.dt,
        tuple(context.trace.lines),
        tuple(context.collisions),
        (*map_warnings(world.map), *world.warnings(), *overloads(context)),
        outcome.place,
        tuple(monitors.violations),
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
        context = make_context(scenario, EmbeddedWorld(road_map, quiet.dt), keep_trace=False)
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
    scenario: Scenario, world: World, keep_trace: bool, observer: Observer | None = None
) -> ExecutionContext:
    """Return the context of a run."""
    settings = scenario.settings
    enabled = keep_trace or settings.trace is not None or settings.report is not None
    return ExecutionContext(
        world,
        settings,
        scenario.actors,
        events=scenario.events,
        objects=scenario.map_objects,
        trace=TraceWriter(enabled, None if observer is None else observer.sampled),
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


def write_files(context: ExecutionContext) -> None:
    """Write trace and report where the settings want them."""
    settings = context.settings
    if settings.trace is not None:
        write_output("trace", settings.trace, "".join(f"{line}\n" for line in context.trace.lines))
    if settings.report is not None:
        from osc2tx_runtime.report import render_report

        page = render_report(context.trace.lines, context.world.map)
        write_output("report", settings.report, page)


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
