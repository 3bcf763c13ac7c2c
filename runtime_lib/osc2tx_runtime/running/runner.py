"""Runs a scenario, from the settings to the verdict and its files; the loop itself is in `loop`."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from osc2tx_runtime.domain.routes.map_search import find_map
from osc2tx_runtime.errors import InputError
from osc2tx_runtime.language.context import ExecutionContext
from osc2tx_runtime.language.settings import RunSettings
from osc2tx_runtime.language.trace import TraceWriter
from osc2tx_runtime.running.loop import OnProgress, run_tree

if TYPE_CHECKING:
    from osc2tx_runtime.domain.scenario import Scenario
    from osc2tx_runtime.language.tree.base import Behaviour
    from osc2tx_runtime.world.protocol import World

__all__ = ["RunResult", "run_scenario", "setup_tree"]


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
    """

    status: str
    reason: str
    steps: int
    time: float
    trace_lines: tuple[str, ...] = ()
    collisions: tuple[tuple[float, str, str], ...] = field(default=())


def run_scenario(
    scenario_class: type[Scenario],
    settings: RunSettings | None = None,
    on_progress: OnProgress | None = None,
    *,
    world: World | None = None,
    keep_trace: bool = True,
) -> RunResult:
    """Run a scenario from its placement to its verdict.

    Args:
        scenario_class: A generated class.
        settings: Of the run.
        on_progress: Called about once per simulated second with time and `max_time`, in seconds.
        world: The world to run in; by default the embedded one on the scenario's map.
        keep_trace: Keep the lines of the trace even if no file is asked for.

    Raises:
        ScenarioError: If the scenario cannot start, or cannot go on.
    """
    settings = settings or RunSettings()
    scenario = scenario_class(settings)
    root = scenario.create_tree()
    context = make_context(scenario, world or embedded_world(scenario), keep_trace)
    place_actors(scenario, context)
    setup_tree(root, context)
    write_header(scenario, context)
    try:
        outcome = run_tree(root, context, on_progress)
    finally:
        write_files(context)
    return RunResult(
        outcome.status,
        outcome.reason,
        outcome.steps,
        outcome.steps * context.dt,
        tuple(context.trace.lines),
        tuple(context.collisions),
    )


def embedded_world(scenario: Scenario) -> World:
    """Make the embedded world on the scenario's map."""
    from osc2tx_runtime.opendrive import MapError, read_map
    from osc2tx_runtime.world.embedded import EmbeddedWorld

    path = find_map(scenario.map_file(), scenario.settings.map_path)
    try:
        road_map = read_map(path)
    except (MapError, OSError) as error:
        raise InputError(f"the map cannot be read: {error}") from error
    return EmbeddedWorld(road_map, scenario.settings.dt)


def make_context(scenario: Scenario, world: World, keep_trace: bool) -> ExecutionContext:
    """Return the context of a run."""
    settings = scenario.settings
    enabled = keep_trace or settings.trace is not None or settings.report is not None
    return ExecutionContext(
        world,
        settings,
        scenario.actors,
        events=scenario.events,
        objects=scenario.map_objects,
        trace=TraceWriter(enabled),
        label_events=scenario.label_events,
        one_of=scenario.one_of,
    )


def place_actors(scenario: Scenario, context: ExecutionContext) -> None:
    """Put the actors where the scenario wants them."""
    from osc2tx_runtime.domain.placing.initializer import ScenarioInitializer
    from osc2tx_runtime.domain.routes.geodetic_points import check_globe
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
    context.trace.header(
        {
            "scenario": scenario.name,
            "source": scenario.source,
            "map": context.world.map.name,
            "dt": context.dt,
            "seed": context.settings.seed,
            "parameters": dict(sorted(scenario.parameters.items(), key=_path)),
            "actors": actors,
            "one_of": scenario.one_of,
        }
    )


def _path(parameter: tuple[str, Any]) -> str:
    """Where a parameter belongs: own ones first, those of invocations by path."""
    return parameter[0].rpartition(".")[0]


def write_files(context: ExecutionContext) -> None:
    """Write trace and report where the settings want them."""
    settings = context.settings
    if settings.trace is not None:
        write_text(settings.trace, "".join(f"{line}\n" for line in context.trace.lines))
    if settings.report is not None:
        from osc2tx_runtime.report import write_report

        try:
            settings.report.parent.mkdir(parents=True, exist_ok=True)
            write_report(settings.report, context.trace.lines, context.world.map)
        except OSError as error:
            raise InputError(f"the report cannot be written: {error}") from error


def write_text(path: Path, text: str) -> None:
    """Write a file and the folders above it."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8", newline="\n")
    except OSError as error:
        raise InputError(f"the trace cannot be written: {error}") from error
