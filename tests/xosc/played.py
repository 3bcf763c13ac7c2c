"""What a player made of a document, against what the embedded world made of the scenario.

Events may come as much later as the chain of events before them is long, a step for each: a tool
may see a completion one step late. Places may differ by what that makes at the speeds in question.
"""

import json
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, lru_cache
from itertools import combinations
from pathlib import Path
from types import MappingProxyType

import pytest
from lxml import etree

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx.backends.xosc import XmlScenario
from osc2tx.building.module_loading import scenarios_of_module
from osc2tx.options import CompileOptions
from osc2tx_runtime import RunSettings, run_scenario
from tests.unit.backends.xosc.documents import compiled, module_of

Row = tuple[float, float, float, float]  # t, x, y, v
KEPT = 16
"""How many plays are kept: those of one source, whose documents often are the same in versions."""
JUMP = 1.0  # m: what is put elsewhere at once when the run begins is that far away


@dataclass(frozen=True)
class Played:
    """What happened.

    Attributes:
        end: When it was over (s).
        starts: Times at which actions began: in the world by source line, in a tool by event.
        track: Motion by actor.
        choices: Which members were chosen, by the names of the choices.
    """

    end: float
    starts: Mapping[str, float]
    track: Mapping[str, Sequence[Row]]
    choices: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Difference:
    """How far a tool is off.

    Attributes:
        late: Longest delay of an event (s), against what is allowed for it.
        apart: Longest distance (m) by actor, with its time.
        spread: Between which speeds (m/s) an actor changes.
    """

    late: float
    apart: Mapping[str, tuple[float, float]]
    spread: Mapping[str, float]

    @property
    def farthest(self) -> float:
        """Metres between an actor here and there, at most."""
        return max((metres for metres, _ in self.apart.values()), default=0.0)


@cache
def module(path: Path, options: CompileOptions) -> GeneratedModule:
    """Return the module of a file."""
    return emit(module_of(compiled(path, options)))


@dataclass(frozen=True)
class Run:
    """A scenario of a file with what it is given, two of which are equal if they say the same."""

    path: Path
    name: str
    options: CompileOptions
    said: str
    settings: RunSettings = field(compare=False)


@lru_cache(maxsize=KEPT)
def _outcome(run: Run) -> tuple[tuple[str, ...], Played]:
    """Return the parameters of a scenario, and what the embedded world does with it."""
    with scenarios_of_module(module(run.path, run.options)) as scenarios:
        result = run_scenario(scenarios[run.name], run.settings)
    assert result.status == "success", result.reason
    starts: dict[str, float] = {}
    track: dict[str, list[Row]] = {}
    choices: dict[str, str] = {}
    header, *lines = map(json.loads, result.trace_lines)
    for line in lines:
        if line["kind"] == "choice":
            choices[line["name"]] = line["chosen"]
        if line["kind"] == "state":
            row = (line["t"], line["x"], line["y"], line["v"])
            track.setdefault(line["actor"], []).append(row)
        elif line["kind"] == "action" and line["status"] == "start":
            starts.setdefault(line["source"], line["t"])
    return tuple(header["parameters"]), Played(result.time, starts, track, choices)


def world(
    path: Path,
    name: str,
    settings: RunSettings,
    options: CompileOptions,
    declared: Mapping[str, float | str] = MappingProxyType({}),
) -> Played:
    """Return what the embedded world does with the values that a document declares."""
    parameters, outcome = _outcome(Run(path, name, options, repr(settings), settings))
    # Others of the document hold what an event carries, or follow from parameters.
    documented = {each: re.sub(r"\W", "_", each) for each in parameters}
    values = {each: declared[said] for each, said in documented.items() if said in declared}
    if values:
        settings = replace(settings, set={**values, **settings.set})
        _, outcome = _outcome(Run(path, name, options, repr(settings), settings))
    return outcome


def values_of(document: XmlScenario) -> dict[str, float | str]:
    """Return what a document declares as parameters."""
    assert document.xml is not None
    declared = etree.fromstring(document.xml.encode()).iterfind("ParameterDeclarations/*")
    return {node.get("name"): _value(node) for node in declared}


def _value(node: etree._Element) -> float | str:
    is_number = node.get("parameterType") in ("double", "int", "integer")
    return float(node.get("value")) if is_number else node.get("value")


def events_by_source(document: XmlScenario, root: etree._Element) -> dict[str, list[str]]:
    """Return the events that stand for invocations, by the lines of these."""
    found: dict[str, list[str]] = {}
    for event in root.iter("Event"):
        name = event.get("name")
        acts = next(event.iter("PrivateAction"), None) is not None
        if acts and not name.startswith("hold_"):
            found.setdefault(str(document.origins[name]), []).append(name)
    return found


Moment = tuple[str, bool]  # an event, act or variable, and whether it is its end


def hops(root: etree._Element) -> dict[str, int]:
    """Return how many things have to happen, one after the other, for each event to start."""
    before: dict[Moment, set[Moment]] = {}
    for event in root.iter("Event"):
        name, act = event.get("name"), next(event.iterancestors("Act")).get("name")
        before[name, False] = {(act, False), *_asked_for(event.find("StartTrigger"))}
        before[name, True] = {(name, False)}
        before.setdefault((act, True), set()).add((name, False))
        for action in (*event.iter("VariableAction"), *event.iter("ParameterAction")):
            variable = action.get("variableRef") or action.get("parameterRef")
            before.setdefault((variable, True), set()).add((name, False))
    for act in root.iter("Act"):
        before[act.get("name"), False] = _asked_for(act.find("StartTrigger"))
        before.setdefault((act.get("name"), True), set()).update(
            _asked_for(act.find("StopTrigger"))
        )
    most = sum(1 for _ in root.iter("Event", "Act"))
    depth = dict.fromkeys(before, 0)
    for _ in range(most):  # who waits for itself gets the most
        for moment, others in before.items():
            longest = max((depth.get(other, 0) for other in others), default=0)
            depth[moment] = min(longest + (not moment[1]), most)
    return {name: count for (name, is_end), count in depth.items() if not is_end}


def _asked_for(trigger: etree._Element | None) -> set[Moment]:
    found: set[Moment] = set()
    for node in () if trigger is None else trigger.iter():
        if node.tag == "StoryboardElementStateCondition":
            found.add((node.get("storyboardElementRef"), node.get("state") != "runningState"))
        elif node.tag in ("VariableCondition", "ParameterCondition"):
            found.add((node.get("variableRef") or node.get("parameterRef"), True))
    return found


def compare(
    document: XmlScenario, expected: Played, found: Played, dt: float, patience: float = 0.0
) -> Difference:
    """Compare what a tool has done with what the embedded world does.

    Args:
        document: What was played.
        expected: What the embedded world does.
        found: What the tool has done.
        dt: Length of a step (s), of both.
        patience: Seconds that events may be off, besides those for the ones before.

    Raises:
        AssertionError: Something has not happened, came too late, or in another order.
    """
    assert document.xml is not None
    root = etree.fromstring(document.xml.encode())
    depth = hops(root)
    longest = patience + (1 + max(depth.values())) * dt
    assert found.end == pytest.approx(expected.end, abs=longest + 1e-6)
    times = []
    for source, names in events_by_source(document, root).items():
        if source in expected.starts:
            begun = [(found.starts[name], name) for name in names if name in found.starts]
            assert begun, f"nothing of {source} ever started"
            at, name = min(begun)
            late = patience + depth[name] * dt + 1e-6
            assert at == pytest.approx(expected.starts[source], abs=late), source
            times.append((expected.starts[source], at, late, source))
    for (should, at, late, one), (should_then, then, later, other) in combinations(times, 2):
        if should + late + later < should_then:  # what is clearly apart keeps its order
            assert at < then, (one, other)
    apart = {a: _apart(rows, found.track[a], longest) for a, rows in expected.track.items()}
    late = max((abs(at - should) for should, at, *_ in times), default=0.0)
    put = {actor for actor in apart if _is_put(root, actor)}
    return Difference(
        late, apart, {actor: spread(expected, actor, put=actor in put) for actor in apart}
    )


def _is_put(root: etree._Element, actor: str) -> bool:
    """Whether the storyboard puts an actor somewhere, or on a line of its own."""
    return any(
        event.find(f".//{tag}") is not None
        for group in root.iter("ManeuverGroup")
        if any(ref.get("entityRef") == actor for ref in group.iterfind("Actors/EntityRef"))
        for event in group.iter("Event")
        for tag in ("TeleportAction", "FollowTrajectoryAction")
    )


def _apart(expected: Sequence[Row], found: Sequence[Row], late: float) -> tuple[float, float]:
    """Return the longest distance (m), and its time; jumps may come late."""
    is_put = math.dist(expected[0][1:3], found[0][1:3]) > JUMP
    worst, jumped = (0.0, 0.0), 0.0 if is_put else -late
    for before, row, there in zip(expected, expected[1:], found[1:], strict=False):
        t, x, y, v = row
        assert abs(there[0] - t) <= 1e-6
        if math.dist(before[1:3], (x, y)) > 2.0 * max(v, before[3], 1.0) * (t - before[0]):
            jumped = t
        if t > jumped + late:
            worst = max(worst, (math.dist((x, y), there[1:3]), t))
    return worst


def spread(played: Played, actor: str, *, put: bool) -> float:
    """Return between which speeds (m/s) an actor changes; who is put elsewhere stood there."""
    speeds = [v for *_, v in played.track[actor]]
    return max(map(abs, speeds)) if put else max(speeds) - min(speeds)
