"""The deviation of an imported scenario, run in the embedded world, from its document, played.

Both are compared by states alone: positions, the end and the verdict. An event that a tool sees one
step late is a delay, not a deviation: a position is compared with those of the surrounding steps.
Where what follows multiplies the delay, a deviation that vanishes with the length of the steps is
none.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from osc2tx.grading.comparison import EXACT, JUMP, ROUNDING, Recording, Row, hops
from osc2tx.grading.plain import plain
from osc2tx.grading.runs import Failed, NoEvidence, cached_map, run_in_player, run_in_world
from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Element
from osc2tx.xosc.player import BY_THE_STANDARD
from osc2tx_runtime import RunSettings, Scenario
from osc2tx_runtime.domain.map.search import find_map
from osc2tx_runtime.opendrive import MapError
from osc2tx_shared.classes import dataclass, replace
from osc2tx_shared.steps import DEFAULT_STEP

COARSE, FINE, FINEST = DEFAULT_STEP, 0.02, 0.0025  # s: lengths of steps
NEAR = 1.0  # m: a smaller deviation may come from a late event at speed, which a shorter step shows
SHRINKS = 1.15
"""A deviation is proportional to the step with at most so much more of it."""
LONGEST = 90.0  # s: the time until then counts
MOST_ACTOR_STEPS = 8_000
"""Maximum number of steps of actors, of the coarse length, in a run."""
MOST_EVENTS = 400
"""Of documents with more there is no run."""

_END_OF_ROAD = re.compile(r"(\w*) has reached the end of lane |(\w*) is not on a road, so ")


@dataclass(frozen=True)
class ImportDeviation:
    """The deviation of an imported scenario from its document.

    Attributes:
        place: Longest distance (m) between an actor here and there, except for late events.
        actor: The actor with that distance.
        at: Time (s) of that distance.
        since: First time (s) at which an actor is off; infinite if none is.
        time: Difference of the ends (s); zero if both continue.
        late: Time (s) by which events may come later.
        off_road: The actor with which the comparison ends, at the end of its road.
    """

    place: float
    actor: str
    at: float
    since: float
    time: float
    late: float
    off_road: str = ""

    @property
    def is_exact(self) -> bool:
        """Whether places and ends are the same, late events apart."""
        return self.place < EXACT and self.time <= self.late + ROUNDING


def import_deviation(
    document: Element,
    map_file: Path | None,
    scenario: type[Scenario],
    names: Mapping[str, str],
    values: Mapping[str, float | str],
    starts: Mapping[str, tuple[str, int, float]],
    *,
    is_endless: bool = False,
) -> ImportDeviation:
    """Run an imported scenario in the embedded world and compare it with its document.

    Args:
        document: The document, with catalogs in it and its parameters at the values of the run.
        map_file: Its map; `None`: it names none.
        scenario: The scenario.
        names: Names of the actors in the scenario, by those in the document.
        values: Values of open parameters of the scenario, in SI units.
        starts: Start positions of actors in the scenario, so that no free positions are searched.
        is_endless: Nothing ends the document, so the end of the scenario does not count.

    Raises:
        NoEvidence: The scenario cannot be run, or the document not be played.
    """
    played = plain(document)
    if sum(1 for _ in played.below(xml.Event)) > MOST_EVENTS:
        raise NoEvidence(f"it has more than {MOST_EVENTS} events")
    case = _Case(
        played, map_file or find_map(None, ()), scenario, names, values, starts, is_endless
    )
    found = coarse = case.at(COARSE)
    if not found.is_exact:
        found = case.at(FINE)
    if found.is_exact:
        return found
    is_near = found.place < NEAR and found.time <= found.late + ROUNDING
    if is_near or _shrinks(coarse, COARSE, found, FINE):
        finest = case.at(FINEST)
        if finest.is_exact or not _shrinks(found, FINE, finest, FINEST):
            return finest
        return replace(finest, place=0.0, time=0.0)  # what remains is the lateness of a step
    return found


def _shrinks(found: ImportDeviation, dt: float, finer: ImportDeviation, shorter: float) -> bool:
    """Whether a deviation becomes shorter as steps do, so that none is left without steps."""
    most = SHRINKS * shorter / dt
    return finer.place <= most * found.place and finer.time <= most * found.time + ROUNDING


@dataclass(frozen=True)
class _Case:
    """The compared pair.

    Attributes:
        document: The document in the form of the player.
        map_file: The map.
        scenario: The scenario.
        names: Names of the actors in the scenario, by those in the document.
        values: Values of open parameters.
        starts: Start positions of actors in the scenario.
        is_endless: Nothing ends the document.
    """

    document: Element
    map_file: Path
    scenario: type[Scenario]
    names: Mapping[str, str]
    values: Mapping[str, float | str]
    starts: Mapping[str, tuple[str, int, float]]
    is_endless: bool

    def at(self, dt: float) -> ImportDeviation:
        """Return the deviation at a length of steps (s)."""
        longest = min(LONGEST, MOST_ACTOR_STEPS * COARSE / max(1, len(self.names)))
        played = self._played(dt, longest)
        settings = RunSettings(
            map_path=(self.map_file,),
            dt=dt,
            max_time=longest,
            set=dict(self.values),
            spawn=self.starts,
        )
        late = (1 + max(hops(self.document).values(), default=0)) * dt
        off_road = ""
        try:
            run = run_in_world(self.scenario, settings).recording
        except Failed as failure:
            run = failure.recording
            off_road = at_end_of_road(failure, played, self.names, late + dt)
            if not off_road:
                raise
        worst, worst_actor, at, since = 0.0, "", 0.0, math.inf
        for said, rows in played.track.items():
            actor = self.names.get(said, "")
            # The standard does not define the motion beyond the end of a road.
            rows = [row for row in rows if row[0] < played.ends.get(said, math.inf)]
            place, when, first = _apart(run.track.get(actor, ()), rows, dt, round(late / dt))
            since = min(since, first)
            if place > worst:
                worst, worst_actor, at = place, actor, when
        time = abs(min(run.end, longest) - min(played.end, longest))
        time = 0.0 if self.is_endless or off_road else time
        return ImportDeviation(worst, worst_actor, at, since, time, late, off_road)

    def _played(self, dt: float, longest: float) -> Recording:
        road_map = cached_map(self.map_file)
        reading = BY_THE_STANDARD
        try:
            return run_in_player(
                self.document, road_map, dt, reading=reading, given={}, most=longest
            )
        except (LookupError, ValueError, MapError) as error:
            # third-party documents name missing parts
            what = error if isinstance(error, MapError) else f"something is missing in it: {error}"
            reason = f"it cannot be played here: {what}"
            raise NoEvidence(reason) from error


def at_end_of_road(
    failure: Failed, played: Recording, names: Mapping[str, str], late: float
) -> str:
    """Return the first actor whose road ends when a run fails, if all that it names are there.

    The standard does not define ends of roads: the player stops an entity there. A scenario fails
    and names the actor: at once, or when it next looks for its lane. Both are at the same position
    when the player comes to the end.

    Args:
        failure: The failure of the run.
        played: The run of the document.
        names: Names of the actors in the scenario, by those in the document.
        late: Time (s) by which one may be later than the other.
    """
    run, said_of = failure.recording, {name: said for said, name in names.items()}
    found = _END_OF_ROAD.findall(str(failure))
    for at_once, afterwards in found:
        actor = at_once or afterwards
        said = said_of.get(actor, "")
        end = played.ends.get(said, math.inf)
        if end - run.end > late or (at_once and run.end - end > late):
            return ""
        here, there = _row_at(run.track[actor], end), _row_at(played.track[said], end)
        if math.dist(here[1:3], there[1:3]) > EXACT + late * abs(here[3]):
            return ""
    return "".join(found[0]) if found else ""


def _row_at(rows: Sequence[Row], time: float) -> Row:
    """Return the last row up to a time (s)."""
    return next(row for row in reversed(rows) if row[0] <= time + ROUNDING)


def _apart(
    run: Sequence[Row], played: Sequence[Row], dt: float, reach: int
) -> tuple[float, float, float]:
    """Return the longest distance (m) of an actor from its steps around, when, and since when."""
    there: dict[int, list[tuple[float, float]]] = {}
    for row in played:
        there.setdefault(round(row[0] / dt), []).append((row[1], row[2]))
    for step, place in _arrivals(played, dt):
        there.setdefault(step, []).append(place)
    worst, at, since = 0.0, 0.0, math.inf
    for row in run:
        step = round(row[0] / dt)
        if step not in there:
            continue
        apart = min(
            math.dist(row[1:3], place)
            for near in range(step - reach, step + reach + 1)
            for place in there.get(near, ())
        )
        if apart > worst:
            worst, at = apart, row[0]
        if apart >= EXACT:
            since = min(since, row[0])
    return worst, at, since


def _arrivals(played: Sequence[Row], dt: float) -> Iterator[tuple[int, tuple[float, float]]]:
    """Yield the steps at which an actor is teleported, and where it arrives.

    The player shows it there one step later, when it has moved on.
    """
    for before, after, later in zip(played, played[1:], played[2:], strict=False):
        if math.dist(before[1:3], after[1:3]) > JUMP + max(abs(before[3]), abs(after[3])) * dt:
            yield round(before[0] / dt), (2.0 * after[1] - later[1], 2.0 * after[2] - later[2])
