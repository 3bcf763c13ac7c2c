"""Runs a scenario: the loop of instants and steps, from the settings to the verdict."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from osc2tx_runtime.behaviour.base import (
    FAILURE,
    INVALID,
    RUNNING,
    SUCCESS,
    Behaviour,
    Status,
    pulse_of,
)
from osc2tx_runtime.behaviour.events import Event
from osc2tx_runtime.behaviour.reasons import failure_reason, timeout_reason
from osc2tx_runtime.context import ExecutionContext
from osc2tx_runtime.errors import InputError, ScenarioError, SettingsError
from osc2tx_runtime.map_search import find_map
from osc2tx_runtime.settings import RunSettings
from osc2tx_runtime.trace import TraceWriter

if TYPE_CHECKING:
    from osc2tx_runtime.scenario import Scenario
    from osc2tx_runtime.world.protocol import World
    from osc2tx_runtime.world.state import ActorState

__all__ = ["Outcome", "RunResult", "run_scenario", "run_tree"]

OnProgress = Callable[[float, float], None]


@dataclass(frozen=True, slots=True)
class Outcome:
    """How a tree ended: `success`, `failure` or `timeout`, why, and after how many steps."""

    status: str
    reason: str
    steps: int


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
        trace=TraceWriter(enabled),
        label_events=scenario.label_events,
        one_of=scenario.one_of,
    )


def place_actors(scenario: Scenario, context: ExecutionContext) -> None:
    """Put the actors where the scenario wants them."""
    from osc2tx_runtime.initializer import ScenarioInitializer

    for actor in scenario.actors.values():
        actor.bind(context)
    for each in scenario.map_objects:
        each.bind(context)
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


def run_tree(
    root: Behaviour, context: ExecutionContext, on_progress: OnProgress | None = None
) -> Outcome:
    """Run a tree that is set up until it ends or the time is over.

    However it ends, no node is RUNNING and no slot is owned afterwards, and the trace is closed.

    Raises:
        ScenarioError: If the scenario cannot go on.
    """
    outcome = Outcome("error", "", 0)
    try:
        outcome = loop(root, context, on_progress)
    except BaseException as error:
        text = str(error) if isinstance(error, ScenarioError) else repr(error)
        if isinstance(error, KeyboardInterrupt):
            text = f"interrupted at {context.time:g} s"
        outcome = Outcome("error", text, context.step)
        raise
    finally:
        close(root, context, outcome)
    return outcome


def close(root: Behaviour, context: ExecutionContext, outcome: Outcome) -> None:
    """Leave the tree, free the slots, and write the end of the trace."""
    try:
        if root.status is RUNNING:
            root.stop(INVALID)
    finally:
        for node in root.iterate():  # what a broken `on_stop` kept from being left
            if node.status is RUNNING:
                node.status = INVALID
        context.clear()
        context.trace.end_instant(context.time, states(context))
        context.trace.result(outcome.status, outcome.reason, outcome.steps)


def loop(root: Behaviour, context: ExecutionContext, on_progress: OnProgress | None) -> Outcome:
    """Settle one instant after the other until the tree ends or the time is over."""
    pulse = pulse_of(root)
    world, settings = context.world, context.settings
    last_step = context.steps(settings.max_time)
    progress_steps = max(1, context.steps(1.0))
    signals = signals_by_step(context)
    step = 0
    while True:
        context.begin_step(step)
        status = settle(pulse, context, signals.get(step, ()))
        context.check_conflicts()
        context.commit()
        if status is SUCCESS:
            return Outcome("success", "", step)
        if status is FAILURE:
            return Outcome("failure", failure_reason(root, context), step)
        if step >= last_step:
            return Outcome("timeout", timeout_reason(root, context), step)
        context.trace.end_instant(context.time, states(context))
        if on_progress is not None and step % progress_steps == 0:
            on_progress(context.time, settings.max_time)
        world.step()
        step += 1
        for one, other in world.collisions():
            context.note_collision(step, one, other)


def settle(
    pulse: Callable[[], Status], context: ExecutionContext, signals: tuple[Event, ...]
) -> Status:
    """Pulse the tree until nothing more happens at this instant.

    Signals are visible from the first pass on, so a wait that starts just now does not see them.
    Those at the very start become visible one pass later: the first waits do see them.
    """
    if context.step > 0:
        post_all(context, signals)
    context.begin_pass()
    if context.step == 0:
        post_all(context, signals)
    status = pulse()
    while status is RUNNING and context.next_pass():
        context.begin_pass()
        status = pulse()
    return status


def post_all(context: ExecutionContext, signals: tuple[Event, ...]) -> None:
    """Post events from outside; their parameters have their defaults."""
    for event in signals:
        context.post(event, event.complete({}))


def signals_by_step(context: ExecutionContext) -> dict[int, tuple[Event, ...]]:
    """Return the signals of the settings by the first step at or after their time."""
    found: dict[int, tuple[Event, ...]] = {}
    for name, seconds in context.settings.signal.items():
        step = context.first_step_at(seconds)
        event = context.events[name]
        problem = event.problem(())
        if problem:
            raise SettingsError(f"--signal {name}: {problem}")
        found[step] = (*found.get(step, ()), event)
    return found


def states(context: ExecutionContext) -> Iterator[tuple[str, ActorState]]:
    """Yield the states of the placed actors, in the order of the cast."""
    state = context.world.state
    return ((actor_id, state(actor_id)) for actor_id in context.cast())


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
