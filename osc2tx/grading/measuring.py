"""The runs that one document gets, and the largest deviation in them.

A run at coarse steps confirms most documents. Otherwise the same run at fine steps distinguishes
deviations from the delay of events by a step.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import inf
from pathlib import Path

from osc2tx.backends.xosc import XmlScenario
from osc2tx.backends.xosc.facts.start_places import read_signal, read_spawn
from osc2tx.grading.comparison import EXACT, Deviation, compare
from osc2tx.grading.runs import (
    Failed,
    NoEvidence,
    WorldRun,
    cached_map,
    declared_values,
    reading_of,
    run_in_player,
    run_in_world,
    time_for,
    values_drawn,
    values_for,
)
from osc2tx.grading.values import Values, corners
from osc2tx.losses.bounds import Measured, Metres
from osc2tx.options import XmlOptions
from osc2tx.xosc import elements as xml
from osc2tx.xosc import read
from osc2tx.xosc.profiles import PROFILES
from osc2tx_runtime import RunSettings, Scenario
from osc2tx_runtime.opendrive import RoadMap
from osc2tx_shared.classes import dataclass, replace
from osc2tx_shared.map_files import map_places
from osc2tx_shared.steps import DEFAULT_STEP

COARSE, FINE, FINEST = DEFAULT_STEP, 0.02, 0.01  # s: lengths of steps
SUSPECT = 0.3  # m: at coarse steps, the delay of events may hide so much
LONGEST = 300.0  # s: as a run of the module
MOST_ACTOR_STEPS = 60_000
"""Maximum number of steps of actors in a run; the part until then counts."""
PACE = 1.0  # m/s: no approximated actor is slower; an event that waits for its position comes late


@dataclass(frozen=True)
class Finding:
    """The runs of a document.

    Attributes:
        measured: The largest deviations in them.
        deviation: The deviation in the run with the largest one.
        starts: Times (s) at which actions begin in that run, by source line.
        is_faithful: No deviation is larger than the report states.
    """

    measured: Measured
    deviation: Deviation
    starts: Mapping[str, float]
    is_faithful: bool


class Measuring:
    """The measurement of one document."""

    def __init__(
        self,
        found: XmlScenario,
        scenario: type[Scenario],
        options: XmlOptions,
        folder: Path,
    ) -> None:
        """Store the inputs of the runs.

        Args:
            found: The document with its report; there is one.
            scenario: The class of the scenario.
            options: Those of the document.
            folder: The folder of the source, with maps.
        """
        assert found.xml is not None, "there is something to play"
        self._found = found
        self._scenario = scenario
        self._folders = (folder, *map(Path, options.map_path))
        self._tool = PROFILES[options.profile]
        self._root = read(found.xml)
        self._actors = max(1, sum(1 for _ in self._root.below(xml.ScenarioObject)))
        spawn = dict(map(read_spawn, options.spawns))
        self._settings = RunSettings(
            map_path=self._folders,
            signal=dict(map(read_signal, options.signals)),
            spawn={actor: (at.road, at.lane, at.s) for actor, at in spawn.items()},
        )
        bounds = [each.bound for each in found.report.approximations]
        self._chooses = False
        self._is_doubted = any(each.is_open for each in found.report.entries)
        self._is_bounded = all(isinstance(bound, Metres) for bound in bounds)
        self._stated = sum(bound.rounded for bound in bounds if isinstance(bound, Metres))

    def run(self) -> Finding:
        """Return the deviations in the runs with nominal values and at the corners of ranges.

        Raises:
            NoEvidence: The run with nominal values gives no evidence.
        """
        self._map()  # without it there is no run at all
        results = [self._judged({})]
        kept = None if self._found.parameters is None else read(self._found.parameters)
        omitted: dict[str, None] = {}  # reasons; constraints may leave no room for a corner
        for values in corners(kept):
            try:
                results.append(self._judged(values))
            except NoEvidence as error:
                omitted[str(error)] = None
        if not self._chooses:  # the world draws, and what it has drawn is one of the rows
            results = [min(results, key=lambda each: each.deviation.place)]
        worst = max(results, key=lambda each: (not each.is_faithful, each.deviation.place))
        measured = Measured(
            place=max(each.deviation.place for each in results),
            speed=max(each.deviation.speed for each in results),
            time=max(each.deviation.time for each in results),
            events=max(len(each.deviation.problems) for each in results),
            runs=len(results),
            omitted=tuple(omitted),
        )
        return replace(worst, measured=measured)

    def _judged(self, values: Values) -> Finding:
        """Run scenario and document with values of open parameters, at fine steps if necessary."""
        coarse = self._at(COARSE, values)
        suspect = EXACT if self._is_doubted else SUSPECT
        if not self._is_bounded or (coarse.is_faithful and coarse.deviation.place < suspect):
            return coarse
        fine = self._at(FINE, values)
        if fine.is_faithful and (not self._is_doubted or fine.deviation.place < EXACT):
            return fine
        shrinking = (coarse.deviation.place - fine.deviation.place) / (COARSE - FINE)
        allowed = EXACT + self._stated
        if fine.deviation.place - shrinking * FINE >= allowed:
            return replace(fine, is_faithful=fine.is_faithful and not self._is_doubted)
        finest = self._at(FINEST, values)
        left = 2.0 * finest.deviation.place - fine.deviation.place
        is_step = left < allowed and not finest.deviation.problems
        is_step = is_step and not finest.deviation.is_at_fork
        return replace(finest, is_faithful=finest.is_faithful or is_step)

    def _at(self, dt: float, values: Values) -> Finding:
        longest = min(LONGEST, MOST_ACTOR_STEPS * dt / self._actors)
        settings = replace(self._settings, dt=dt, max_time=longest)
        declared = declared_values(self._root, values)
        chosen = values_for(self._scenario, settings, declared)
        failure: Failed | None = None
        try:
            world = run_in_world(self._scenario, replace(settings, set=chosen))
        except Failed as error:
            failure, world = error, WorldRun(error.recording, is_whole=True)
        drawn = values_drawn(self._scenario, settings, world.recording, self._found.choices)
        self._chooses = bool(chosen or drawn)
        found = run_in_player(
            self._root,
            self._map(),
            dt,
            reading=reading_of(self._tool),
            given={**values, **drawn},
            most=time_for(world, longest),
        )
        if failure is not None and not found.fails:
            raise failure
        patience = self._stated / PACE if self._is_bounded else inf
        deviation = compare(self._root, self._found.origins, world.recording, found, dt, patience)
        allowed = EXACT + self._stated
        is_near = not deviation.beyond(allowed)
        measured = Measured(deviation.place, deviation.speed, deviation.time)
        is_faithful = is_near and not deviation.problems and not found.forks
        return Finding(measured, deviation, world.recording.starts, is_faithful)

    def _map(self) -> RoadMap:
        name = self._root.one(xml.RoadNetwork).one(xml.LogicFile).filepath
        for place in map_places(name, self._folders):
            if place.is_file():
                return cached_map(place)
        raise NoEvidence(f"there is no map {name}")
