"""Checks an existing trace: the conditions of its scenario, on its states alone."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from osc2tx_runtime.domain.map.search import find_map
from osc2tx_runtime.errors import InputError
from osc2tx_runtime.language.actions.action import Action
from osc2tx_runtime.language.outline import outline
from osc2tx_runtime.language.settings import RunSettings
from osc2tx_runtime.opendrive import MapError, read_map
from osc2tx_runtime.running.preparation import make_context, place_actors, setup_tree
from osc2tx_runtime.world.recorded import RecordedWorld
from osc2tx_shared.classes import dataclass

if TYPE_CHECKING:
    from osc2tx_runtime.domain.monitoring.phase import Violation
    from osc2tx_runtime.domain.scenario import Scenario
    from osc2tx_runtime.language.tree.base import Behaviour

Line: TypeAlias = Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class RecordedRun:
    """A trace without its states.

    Attributes:
        header: The first line.
        states: `state` lines of each step, by actor; those of a file are read on demand, as there
            are many.
        nodes: Nodes of the tree, with their runs.
        failed: Time and name of actions that failed because a condition did not hold.
        overridden: Time and name of overridden nodes.
    """

    header: Line
    states: Iterable[Mapping[str, Line]]
    nodes: list[Line]
    failed: frozenset[tuple[float, str]]
    overridden: frozenset[tuple[float, str]]


@dataclass(frozen=True, slots=True)
class _File:
    """The lines of a trace, read on each iteration.

    Raises:
        InputError: On iteration, if the file is not a trace.
    """

    path: Path

    def __iter__(self) -> Iterator[Line]:
        try:
            with self.path.open(encoding="utf-8") as lines:
                yield from map(json.loads, lines)
        except (OSError, ValueError, RecursionError) as error:
            raise _unreadable(self.path, error) from error


@dataclass(frozen=True, slots=True)
class _States:
    """The states of a trace, step by step."""

    lines: Iterable[Line]
    dt: float

    def __iter__(self) -> Iterator[Mapping[str, Line]]:
        step, states = -1, dict[str, Line]()
        for line in self.lines:
            if line["kind"] == "state":
                before, step = step, _step_of(line, self.dt, step)
                if step != before and states:
                    yield states
                    states = {}
                states[str(line["actor"])] = line
        if states:
            yield states


def _step_of(state: Line, dt: float, before: int) -> int:
    """Return the step of a state: that of the state before it, or the next one."""
    step = round(float(state["t"]) / dt)
    if step < 0 or step not in (before, before + 1):
        raise ValueError(f"there are no states before {state['t']:g} s")
    return step


def _unreadable(path: Path, error: Exception) -> InputError:
    """Return the error for an invalid trace."""
    if isinstance(error, json.JSONDecodeError):
        return InputError(f"trace {path} cannot be read: no JSON Lines, as `run --trace` writes it")
    return InputError(f"trace {path} cannot be read: {error}")


@dataclass(frozen=True, slots=True)
class Verification:
    """The findings of a trace.

    Attributes:
        phases: Number of checked phases.
        violations: Conditions that do not hold in their phases.
    """

    phases: int
    violations: tuple[Violation, ...]

    @property
    def fails(self) -> bool:
        """Whether a phase fails."""
        return any(each.severity == "failure" for each in self.violations)


def read_trace(path: Path) -> RecordedRun:
    """Read a trace; its states are read by `verify`.

    Raises:
        InputError: It is not a trace, or incomplete.
    """
    try:
        return recorded_run(_File(path))
    except (KeyError, OverflowError, TypeError, ValueError, ZeroDivisionError) as error:
        raise _unreadable(path, error) from error


def recorded_run(lines: Iterable[Line]) -> RecordedRun:
    """Return a run from the lines of its trace, which are iterated more than once.

    Raises:
        KeyError, TypeError, ValueError: They are not a trace, or incomplete.
    """
    header: Line | None = None
    dt, step = 0.0, -1
    nodes: list[Line] = []
    failed, overridden = set[tuple[float, str]](), set[tuple[float, str]]()
    for line in lines:
        kind = line["kind"]
        if header is None:
            if kind != "header":
                break
            header, dt = line, float(line["dt"])
        elif kind == "state":
            step = _step_of(line, dt, step)
        elif kind == "tree":
            nodes += line["nodes"]
        elif kind == "violation" and line["severity"] == "failure":
            failed.add((line["t"], line["name"]))
        elif kind == "override" and line["what"] == "ended":
            overridden.add((line["t"], line["name"]))
    if header is None:
        raise ValueError("the first line is not a header")
    if not nodes:
        raise ValueError("it is incomplete: it has no tree")
    return RecordedRun(header, _States(lines, dt), nodes, frozenset(failed), frozenset(overridden))


def verify(
    run: RecordedRun,
    scenario_class: Callable[[RunSettings], Scenario],
    map_path: Iterable[Path] = (),
) -> Verification:
    """Check the conditions of a scenario on the states of a trace.

    Args:
        run: The trace.
        scenario_class: The scenario of the run.
        map_path: Folders with maps, or the map itself.

    Raises:
        InputError: The trace is not one of the scenario.
        ScenarioError: The scenario cannot be set up.
    """
    from osc2tx_runtime.domain.monitoring.run import Monitors

    scenario = scenario_class(_settings(run.header, tuple(map_path)))
    root = scenario.create_tree()
    road_map = read_map(find_map(scenario.map_file() or run.header.get("map"), tuple(map_path)))
    world = RecordedWorld(road_map, float(run.header["dt"]), run.header.get("control", {}))
    context = make_context(scenario, world)
    place_actors(scenario, context)
    setup_tree(root, context)
    monitors = Monitors(context)
    begins, ends = _runs(run, root)
    phases = 0
    for step, states in enumerate(run.states):
        time = step * context.dt
        # An assignment at this instant may follow the end of a phase: the states show it.
        jumps = any(action.registered.is_momentary for action in begins.get(step, ()))
        if not jumps:
            _show(world, states, time)
        context.begin_step(step)
        for action, outcome in ends.get(step, ()):
            phases += 1
            is_judged = _is_verified(run, round(time, 6), action, outcome)
            (monitors.ends if is_judged else monitors.leaves)(action)
        if jumps:
            _show(world, states, time)
        for action in begins.get(step, ()):
            monitors.begins(action)
        monitors.observe()
    return Verification(phases, tuple(monitors.violations))


def _is_verified(run: RecordedRun, time: float, action: Action, outcome: str) -> bool:
    """Whether the phase of an action counts: it ended, and was not interrupted."""
    if (time, action.name) in run.overridden:
        return False
    return outcome == "success" or (time, action.action_name) in run.failed


def _show(world: RecordedWorld, states: Mapping[str, Line], time: float) -> None:
    try:
        world.show(states)
    except (KeyError, TypeError, ValueError, MapError) as error:
        raise InputError(f"the states at {time:.2f} s cannot be read: {error}") from error


def _settings(header: Line, map_path: tuple[Path, ...]) -> RunSettings:
    """Return the settings of a run, with its values."""
    values = {
        name: value
        for name, value in header.get("parameters", {}).items()
        if isinstance(value, int | float | str) and not isinstance(value, bool)
    }
    return RunSettings(
        map_path=map_path,
        seed=int(header.get("seed", 0)),
        dt=float(header["dt"]),
        set=values,
        conduct=str(header.get("conduct", "as_told")),
    )


def _runs(
    run: RecordedRun, root: Behaviour
) -> tuple[dict[int, list[Action]], dict[int, list[tuple[Action, str]]]]:
    """Return the actions that begin and end at each step, with their results.

    Raises:
        InputError: The tree differs.
    """
    nodes = list(outline(root))
    same = len(nodes) == len(run.nodes) and all(
        node.kind == line["kind"] and node.text == line["text"]
        for node, line in zip(nodes, run.nodes, strict=False)
    )
    if not same:
        raise InputError("the trace does not belong to this scenario: its tree differs")
    begins: dict[int, list[Action]] = {}
    ends: dict[int, list[tuple[Action, str]]] = {}
    dt = float(run.header["dt"])
    for action, start, end, outcome in _spans(nodes, run.nodes):
        begins.setdefault(round(start / dt), []).append(action)
        if end is not None:
            ends.setdefault(round(end / dt), []).append((action, outcome))
    return begins, ends


def _spans(
    nodes: list[Any], lines: list[Line]
) -> Iterator[tuple[Action, float, float | None, str]]:
    for node, line in zip(nodes, lines, strict=True):
        if isinstance(node.node, Action):
            for start, end, outcome in line["runs"]:
                if end is None or end > start or node.node.registered.is_momentary:
                    yield node.node, start, end, outcome
