"""Runs a scenario, from the settings to the verdict and its files; the loop itself is in `loop`."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, field
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

from osc2tx_runtime.errors import BeyondMapError
from osc2tx_runtime.language.context import ExecutionContext
from osc2tx_runtime.language.settings import RunSettings
from osc2tx_runtime.language.trace import OnStates, TraceWriter
from osc2tx_runtime.opendrive import RoadMap, read_map
from osc2tx_runtime.running.loop import Observer, OnProgress, Outcome, overloads, run_tree
from osc2tx_runtime.running.output_files import check_outputs
from osc2tx_runtime.running.preparation import prepared
from osc2tx_runtime.running.run_outputs import RunOutputs
from osc2tx_shared.classes import dataclass, replace

if TYPE_CHECKING:
    from osc2tx_runtime.domain.monitoring.phase import Violation
    from osc2tx_runtime.domain.monitoring.run import Monitors
    from osc2tx_runtime.domain.scenario import Scenario
    from osc2tx_runtime.world.protocol import World

ResultT = TypeVar("ResultT", covariant=True)

REDRAWS = 100  # draws of one seed, if the map has no room for the drawn values


@dataclass(frozen=True, slots=True)
class RunResult:
    """How a run ended.

    Attributes:
        status: `success`, `failure` or `timeout`.
        reason: Empty for success.
        steps: Steps the world made.
        time: Simulated seconds.
        trace_lines: Lines of the trace, without line ends, if they are kept.
        digest: SHA-256 of the trace, if requested.
        collisions: Time in seconds and the two actors of each new contact.
        warnings: Warnings, which do not end the run.
        place: Source position of the failed element; empty without one.
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
    on_states: OnStates | None = None,
    read: Callable[[Path], RoadMap] = read_map,
) -> RunResult:
    """Run a scenario from its placement to its verdict.

    Args:
        scenario_class: A generated class.
        settings: Of the run.
        on_progress: Called about once per simulated second with time and `max_time`, in seconds.
        world: The world; default: that of the settings, on the scenario's map. It is closed at the
            end.
        keep_trace: Keep the lines of the trace; memory then grows with the length of the run.
        digest: Compute the digest of the trace.
        observer: Observes the run.
        on_states: Receives the states of each instant, which the trace then omits. If a map has no
            room for drawn values, they are drawn again, and the run restarts at 0 s.
        read: Reads the map; callers with many runs can cache it.

    Raises:
        ScenarioError: The scenario cannot start, or cannot continue.
    """
    settings = settings or RunSettings()
    check_outputs(settings)
    read = cache(read)  # further draws use the same map

    def run(scenario: Scenario, *, is_last: bool) -> RunResult:
        root = scenario.create_tree()
        outputs = RunOutputs(scenario.settings, keep_lines=keep_trace, digest=digest)
        on_sample = None if observer is None else observer.sampled
        trace = TraceWriter(*outputs.takers, on_sample=on_sample, on_states=on_states)
        made = prepared(scenario_class, scenario, root, world, read, trace, is_last=is_last)
        with made as (context, monitors):
            try:
                write_header(scenario, context)
                context.world.begin()
                outcome = run_tree(root, context, on_progress, observer)
            finally:
                outputs.close(context.world.map)
        return replace(
            _result(outcome, context, monitors),
            trace_lines=tuple(outputs.lines),
            digest=None if outputs.digest is None else str(outputs.digest),
        )

    may_redraw = world is None and settings.world == "embedded"
    return _with_draws(scenario_class, settings, run, may_redraw=may_redraw)


def check_start(
    scenario_class: Callable[[RunSettings], Scenario],
    settings: RunSettings,
    read: Callable[[Path], RoadMap] = read_map,
) -> RunResult:
    """Prepare a run up to its first step, in the embedded world and without outputs.

    Args:
        scenario_class: A generated class.
        settings: Of the run.
        read: Reads the map.

    Returns:
        The result; `timeout` if the run would continue.

    Raises:
        ScenarioError: The run would be rejected.
    """
    quiet = replace(settings, trace=None, report=None)
    read = cache(read)

    def start(scenario: Scenario, *, is_last: bool) -> RunResult:
        root = scenario.create_tree()
        made = prepared(scenario_class, scenario, root, None, read, is_last=is_last)
        with made as (context, monitors):
            outcome = run_tree(root, context, last_step=0)
        return _result(outcome, context, monitors)

    return _with_draws(scenario_class, quiet, start, may_redraw=True)


class _Play(Protocol[ResultT]):
    """Runs a scenario with drawn values; `BeyondMapError` ends all draws but the last."""

    def __call__(self, scenario: Scenario, *, is_last: bool) -> ResultT: ...


def _with_draws(
    scenario_class: Callable[[RunSettings], Scenario],
    settings: RunSettings,
    play: _Play[ResultT],
    *,
    may_redraw: bool,
) -> ResultT:
    """Run a scenario with the first draw that certainly fits the map, else the first."""
    for draw in range(REDRAWS if may_redraw and settings.draws is None else 0):
        scenario = scenario_class(replace(settings, draw=settings.draw + draw))
        try:
            return play(scenario, is_last=False)
        except BeyondMapError:
            if not scenario.has_drawn_values:
                break
    return play(scenario_class(settings), is_last=True)


def _result(outcome: Outcome, context: ExecutionContext, monitors: Monitors) -> RunResult:
    world = context.world
    return RunResult(
        outcome.status,
        outcome.reason,
        outcome.steps,
        outcome.steps * context.dt,
        collisions=tuple(context.collisions),
        warnings=(
            *map_warnings(world.map),
            *world.warnings(),
            *overloads(context),
            *context.illegal.values(),
        ),
        place=outcome.place,
        violations=tuple(monitors.violations),
    )


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
    """Sort key of a parameter: own ones first, those of invocations by path."""
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
