"""One run of a scenario in the embedded world, and one of its document in the player."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache
from pathlib import Path

from osc2tx.backends.xosc import Choice
from osc2tx.grading.comparison import Recording, Row
from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Element, Unresolved
from osc2tx.xosc.player import Evaluator, Reading, Unplayable
from osc2tx.xosc.profiles import ToolProfile
from osc2tx_runtime import RunSettings, Scenario, ScenarioError, run_scenario
from osc2tx_runtime.domain.placing.entries import ENTER
from osc2tx_runtime.language.trace import DECIMALS
from osc2tx_runtime.language.tree import OneOf
from osc2tx_runtime.opendrive import RoadMap, read_map
from osc2tx_runtime.world.state import ActorState
from osc2tx_shared.classes import dataclass, replace

MAPS_KEPT = 8
OVER = 1.0  # s: a player gets so much more time than the run in the world took, and twice of it
SETTLED = 1.0  # s: so much counts behind the last action of a run that never ends

_LINES = re.compile(r"\S+\.osc:\d+: | \(\S+\.osc:\d+\)")


class NoEvidence(Exception):
    """A run that shows nothing about a document: it fails, or nothing here can carry it out.

    Reports are reviewed with the documents, so reasons name no lines of the source.
    """

    def __init__(self, reason: str) -> None:
        """Take the reason."""
        super().__init__(_LINES.sub("", reason))


class Failed(NoEvidence):
    """A run in the world that fails.

    Attributes:
        recording: The run up to the failure.
    """

    def __init__(self, reason: str, recording: Recording) -> None:
        """Store the reason and the recording."""
        super().__init__(reason)
        self.recording = recording


@dataclass(frozen=True)
class WorldRun:
    """A run in the embedded world.

    Attributes:
        recording: The states and events.
        is_whole: The scenario ended within the time of the run.
    """

    recording: Recording
    is_whole: bool


def cached_map(path: Path) -> RoadMap:
    """Return a map; the last ones are kept until their files change."""
    status = path.stat()
    return _map(path, status.st_mtime_ns, status.st_size)


@lru_cache(maxsize=MAPS_KEPT)
def _map(path: Path, _changed: int, _size: int) -> RoadMap:
    return read_map(path)


def run_in_world(scenario: type[Scenario], settings: RunSettings) -> WorldRun:
    """Run a scenario in the embedded world.

    Raises:
        Failed: The run fails.
        NoEvidence: It cannot be carried out.
    """
    track: dict[str, list[Row]] = {}

    def keep(time: float, states: Iterable[tuple[str, ActorState]]) -> None:
        if time == 0.0:
            track.clear()
        t = round(time, DECIMALS)
        for actor, state in states:
            x, y, v = round(state.x, DECIMALS), round(state.y, DECIMALS), round(state.v, DECIMALS)
            track.setdefault(actor, []).append((t, x, y, v))

    try:
        result = run_scenario(scenario, settings, on_states=keep, read=cached_map)
    except (ScenarioError, ArithmeticError) as error:
        raise NoEvidence(f"the run in the world fails: {error}") from error
    starts: dict[str, float] = {}
    choices: dict[str, str] = {}
    acted = 0.0
    for line in map(json.loads, result.trace_lines):
        match line["kind"]:
            case "action":
                acted = line["t"]
                enters = (
                    line["name"] == f"{line['actor']} {ENTER}"
                )  # at the line of its first action
                if line["status"] == "start" and not enters:
                    starts.setdefault(line["source"], line["t"])
            case "choice":
                choices[line["name"]] = line["chosen"]
    if result.status == "failure":
        recording = Recording(result.time, starts, track, choices, fails=True)
        raise Failed(f"the run in the world fails: {result.reason}", recording)
    is_whole = result.status == "success"
    end = result.time if is_whole else math.inf
    if not is_whole:  # the awaited event never occurs, and its actors stop where their road ends
        track = {
            who: [row for row in rows if row[0] <= acted + SETTLED] for who, rows in track.items()
        }
    return WorldRun(Recording(end, starts, track, choices), is_whole)


def declared_values(document: Element, given: Mapping[str, str]) -> dict[str, float | str]:
    """Return the values of the parameters of a document.

    Args:
        document: The document.
        given: Texts that count instead of those of the declarations.
    """
    declarations = document.find(xml.ParameterDeclarations)
    declared = () if declarations is None else declarations.all(xml.ParameterDeclaration)
    texts = {node.name: given.get(node.name, node.value) for node in declared}
    kinds = {node.name: node.parameterType for node in document.below(xml.ParameterDeclaration)}
    return {name: float(text) if kinds[name] in _NUMBERS else text for name, text in texts.items()}


_NUMBERS = ("double", "int", "integer", "unsignedInt", "unsignedShort")


def values_for(
    scenario: type[Scenario], settings: RunSettings, declared: Mapping[str, float | str]
) -> dict[str, float | str]:
    """Return the values of parameters of a scenario that its document declares.

    The others of the document hold arguments of events, or follow from parameters.

    Raises:
        NoEvidence: The scenario cannot be set up.
    """
    if not declared:
        return {}
    try:
        made = _made(scenario, replace(settings, set=declared))  # nothing is left to be drawn
    except (ScenarioError, ArithmeticError):  # a name in the scenario may be another one
        try:
            made = _made(scenario, settings)
        except (ScenarioError, ArithmeticError) as error:
            raise NoEvidence(f"the run in the world fails: {error}") from error
    documented = {each: re.sub(r"\W", "_", each) for each in made.parameters}
    return {each: declared[name] for each, name in documented.items() if name in declared}


def _made(scenario: type[Scenario], settings: RunSettings) -> Scenario:
    made = scenario(settings)
    made.create_tree()
    return made


def values_drawn(
    scenario: type[Scenario], settings: RunSettings, run: Recording, choices: Sequence[Choice]
) -> dict[str, str]:
    """Return the values of parameters that choose the members which a run has drawn.

    Args:
        scenario: The scenario.
        settings: Those of the run.
        run: The run.
        choices: The parameters of the document.
    """
    if not choices or not run.choices:
        return {}
    found: dict[str, str] = {}
    left = list(choices)
    for node in scenario(settings).create_tree().iterate():
        if not isinstance(node, OneOf):
            continue
        choice = next((each for each in left if each.source == node.source), None)
        if choice is None:
            continue
        left.remove(choice)
        names = [member.name for member in node.children]
        if run.choices.get(node.name) in names:
            found[choice.name] = choice.values[names.index(run.choices[node.name])]
    return found


def reading_of(tool: ToolProfile, *, is_lazy: bool = False) -> Reading:
    """Return how a tool reads its documents.

    Args:
        tool: Its profile.
        is_lazy: It evaluates no condition of a group behind a false one.
    """
    return Reading(
        is_lazy=is_lazy or tool.is_lazy,
        latches=tool.latches_conditions,
        counts_from_looking=not tool.has_delays,
        carries_acceleration=tool.carries_acceleration,
        counts_along_roads=tool.counts_along_roads,
        commands_speeds=tool.commands_speeds,
        fits_gaps=tool.fits_gaps,
        sends_along_lanes=tool.sends_along_lanes,
        guesses_at_forks=tool.guesses_at_forks,
    )


def run_in_player(
    document: Element,
    road_map: RoadMap,
    dt: float,
    *,
    reading: Reading,
    given: Mapping[str, str],
    most: float,
) -> Recording:
    """Play a document.

    Args:
        document: The document.
        road_map: Its map.
        dt: Length of a step (s).
        reading: How its tool reads it.
        given: Values of parameters, instead of those of the declarations.
        most: Time after which it is left (s).

    Raises:
        NoEvidence: The player cannot carry it out.
    """
    try:
        evaluator = Evaluator(document, road_map, dt, reading=reading, given=given)
        end = evaluator.play(most)
    except (Unplayable, Unresolved, ArithmeticError) as error:
        raise NoEvidence(f"it cannot be played here: {error}") from error
    starts, track = evaluator.starts, evaluator.track
    fails = not all(evaluator.globals.monitors.values())
    return Recording(end, starts, track, {}, evaluator.ends, evaluator.forks, fails)


def time_for(world: WorldRun, longest: float) -> float:
    """Return the time (s) that a player gets for the document of a run.

    Args:
        world: The run.
        longest: The time that the run had (s).
    """
    return 2.0 * world.recording.end + OVER if world.is_whole else longest
