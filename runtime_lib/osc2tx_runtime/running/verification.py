"""Checks a finished trace: the conditions of its scenario, on its states alone."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from osc2tx_runtime.domain.map.search import find_map
from osc2tx_runtime.errors import InputError
from osc2tx_runtime.language.actions.action import Action
from osc2tx_runtime.language.outline import outline
from osc2tx_runtime.language.settings import RunSettings
from osc2tx_runtime.opendrive import MapError, read_map
from osc2tx_runtime.running.runner import make_context, place_actors, setup_tree
from osc2tx_runtime.world.recorded import RecordedWorld
from osc2tx_shared.classes import dataclass

if TYPE_CHECKING:
    from osc2tx_runtime.domain.monitoring.phase import Violation
    from osc2tx_runtime.domain.scenario import Scenario
    from osc2tx_runtime.language.tree.base import Behaviour

Line: TypeAlias = Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class RecordedRun:
    """A trace, read.

    Attributes:
        header: The first line.
        states: `state` lines of each step, by actor.
        nodes: Nodes of the tree, with their runs.
        failed: Time and name of actions that failed because a condition did not hold.
        overridden: Time and name of nodes that another one has ended.
    """

    header: Line
    states: list[dict[str, Line]]
    nodes: list[Line]
    failed: frozenset[tuple[float, str]]
    overridden: frozenset[tuple[float, str]]


@dataclass(frozen=True, slots=True)
class Verification:
    """What was found in a trace.

    Attributes:
        phases: Number of phases that were checked.
        violations: Conditions that do not hold in their phases.
    """

    phases: int
    violations: tuple[Violation, ...]

    @property
    def fails(self) -> bool:
        """Whether a phase fails."""
        return any(each.severity == "failure" for each in self.violations)


def read_trace(path: Path) -> RecordedRun:
    """Read a trace.

    Raises:
        InputError: It is none, or not a whole one.
    """
    try:
        lines = [json.loads(text) for text in path.read_text(encoding="utf-8").splitlines()]
        return recorded_run(lines)
    except (OSError, ValueError, KeyError, TypeError, RecursionError) as error:
        raise InputError(f"trace {path} cannot be read: {error}") from error


def recorded_run(lines: Sequence[Line]) -> RecordedRun:
    """Return a run from the lines of its trace.

    Raises:
        KeyError, TypeError, ValueError: They are none, or not all of them.
    """
    if not lines or lines[0]["kind"] != "header":
        raise ValueError("the first line is no header")
    header, *rest = lines
    dt, states = float(header["dt"]), list[dict[str, Line]]()
    for line in rest:
        if line["kind"] == "state":
            step = round(float(line["t"]) / dt)
            if not 0 <= step <= len(states):
                raise ValueError(f"there are no states before {line['t']:g} s")
            if step == len(states):
                states.append({})
            states[step][str(line["actor"])] = line
    nodes = [node for line in rest if line["kind"] == "tree" for node in line["nodes"]]
    failed = frozenset((line["t"], line["name"]) for line in rest if _is_failure(line))
    overridden = frozenset(
        (line["t"], line["name"])
        for line in rest
        if line["kind"] == "override" and line["what"] == "ended"
    )
    if not nodes:
        raise ValueError("it is not whole: it has no tree")
    return RecordedRun(header, states, nodes, failed, overridden)


def _is_failure(line: Line) -> bool:
    return bool(line["kind"] == "violation" and line["severity"] == "failure")


def verify(
    run: RecordedRun,
    scenario_class: Callable[[RunSettings], Scenario],
    map_path: Iterable[Path] = (),
) -> Verification:
    """Check the conditions of a scenario on the states of a trace.

    Args:
        run: The trace.
        scenario_class: The scenario that it is a run of.
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
    context = make_context(scenario, world, keep_trace=False)
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
            is_judged = _is_judged(run, round(time, 6), action, outcome)
            (monitors.ends if is_judged else monitors.leaves)(action)
        if jumps:
            _show(world, states, time)
        for action in begins.get(step, ()):
            monitors.begins(action)
        monitors.observe()
    return Verification(phases, tuple(monitors.violations))


def _is_judged(run: RecordedRun, time: float, action: Action, outcome: str) -> bool:
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
    """Return the settings of a run: the same values, whatever they were drawn from."""
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
    """Return the actions that begin and end at each step, with how they end.

    Raises:
        InputError: The tree is another one.
    """
    nodes = list(outline(root))
    same = len(nodes) == len(run.nodes) and all(
        node.kind == line["kind"] and node.text == line["text"]
        for node, line in zip(nodes, run.nodes, strict=False)
    )
    if not same:
        raise InputError("the trace is not one of this scenario: its tree is another one")
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
