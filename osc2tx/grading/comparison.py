"""The deviation of a played document from the run of its scenario.

Events may come later by a step for each event before them: a tool may see a completion one step
late. Positions may differ by the distance that this makes at the speeds in question.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import field
from itertools import combinations

from osc2tx.diagnostics import Span
from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Element
from osc2tx_shared.classes import dataclass

Row = tuple[float, float, float, float]
"""Time (s), x, y (m), speed (m/s)."""

EXACT = 0.1  # m: the largest deviation of an exact document, besides that of late events
JUMP = 1.0  # m: an actor that is teleported when the run begins is farther away than this
ROUNDING = 1e-6


@dataclass(frozen=True)
class Recording:
    """A run.

    Attributes:
        end: When it ended (s).
        starts: When actions began (s): in the world by source line, in a player by event.
        track: Motion of each actor.
        choices: The chosen members, by the names of the choices.
        ends: When actors came to the end of their roads in a player (s).
        forks: When the tool of the player may have taken another road with an actor (s).
        fails: The scenario has failed; of a document, a monitor is false.
    """

    end: float
    starts: Mapping[str, float]
    track: Mapping[str, Sequence[Row]]
    choices: Mapping[str, str] = field(default_factory=dict)
    ends: Mapping[str, float] = field(default_factory=dict)
    forks: Mapping[str, float] = field(default_factory=dict)
    fails: bool = False


@dataclass(frozen=True)
class ActorDeviation:
    """The deviation of an actor.

    Attributes:
        place: Longest distance (m).
        at: Time of the longest distance (s).
        speed: Largest difference of speeds (m/s), late events apart.
        spread: Range of its speeds (m/s); times the delay of events it is the distance that late
            events explain.
        since: First time (s) at which the distance is more than late events explain, or at which
            the tool may take another road.
    """

    place: float
    at: float
    speed: float
    spread: float
    since: float


@dataclass(frozen=True)
class Deviation:
    """The deviation of a document.

    Attributes:
        late: Longest delay of an event (s).
        end: Difference of the ends (s).
        actors: Deviation of each actor.
        problems: Events that are missing, too late or in another order; a sentence each.
        is_off_road: Only actors beyond the end of their roads deviate.
        is_at_fork: Only actors for which the tool may take another road deviate.
    """

    late: float
    end: float
    actors: Mapping[str, ActorDeviation]
    problems: tuple[str, ...]
    is_off_road: bool = False
    is_at_fork: bool = False

    @property
    def place(self) -> float:
        """Longest distance between an actor here and there (m)."""
        return max((each.place for each in self.actors.values()), default=0.0)

    @property
    def speed(self) -> float:
        """Largest difference of speeds (m/s)."""
        return max((each.speed for each in self.actors.values()), default=0.0)

    @property
    def time(self) -> float:
        """Longest delay of an event or of the end (s)."""
        return max(self.late, self.end)

    def beyond(self, allowed: float) -> list[str]:
        """Return the actors that are farther off (m) than late events explain."""
        return [
            actor
            for actor, each in self.actors.items()
            if each.place - self.late * each.spread >= allowed
        ]


def compare(
    document: Element,
    origins: Mapping[str, Span],
    expected: Recording,
    found: Recording,
    dt: float,
    patience: float = 0.0,
) -> Deviation:
    """Compare a run of a document with the run of its scenario.

    Args:
        document: The document.
        origins: The members of its events.
        expected: The run in the world; an infinite end if it was left before.
        found: The run of the document.
        dt: Length of a step of both (s).
        patience: Allowed delay of events (s) besides a step for each event before.
    """
    depth = hops(document)
    chain = (1 + max(depth.values(), default=0)) * dt
    problems, times = [], []
    last = max((rows[-1][0] for rows in found.track.values() if rows), default=0.0)
    ended = found.end if math.isfinite(found.end) else last  # or later
    end = 0.0 if math.isinf(expected.end) else abs(ended - expected.end)
    if end > patience + chain + ROUNDING:
        problems.append(f"it ends at {found.end:g} s instead of {expected.end:g} s")
    if found.fails and not expected.fails:
        problems.append(f"it fails at {found.end:g} s, which the scenario does not")
    for source, names in events_by_source(document, origins).items():
        if source not in expected.starts:
            continue
        should = expected.starts[source]
        begun = [(found.starts[name], name) for name in names if name in found.starts]
        if not begun:
            problems.append(f"no action of {source} starts")
            continue
        at, name = min(begun)
        allowed = patience + depth[name] * dt + ROUNDING
        if abs(at - should) > allowed:
            problems.append(f"{source} starts at {at:g} s instead of {should:g} s")
        times.append((should, at, allowed, source))
    for (should, at, late, one), (should_then, then, later, other) in combinations(times, 2):
        if should + late + later < should_then and at >= then:
            problems.append(f"{other} starts before {one}")
    late = max((abs(at - should) for should, at, *_ in times), default=0.0)
    teleported = set(_teleported(document))
    actors = {
        actor: _deviation(
            rows,
            found.track.get(actor, ()),
            late,
            late + chain,
            dt,
            is_put=actor in teleported,
            fork=found.forks.get(actor, math.inf),
        )
        for actor, rows in expected.track.items()
    }
    deviating = {actor: each.since for actor, each in actors.items() if each.since < math.inf}
    is_off_road, is_at_fork = (
        bool(deviating)
        and not problems
        and all(when.get(actor, math.inf) <= since + chain for actor, since in deviating.items())
        for when in (found.ends, found.forks)
    )
    return Deviation(late, end, actors, tuple(problems), is_off_road, is_at_fork)


# --- Events ---------------------------------------------------------------------------------------


def events_by_source(document: Element, origins: Mapping[str, Span]) -> dict[str, list[str]]:
    """Return the events with actions of actors, by the lines of the members in the source."""
    found: dict[str, list[str]] = {}
    for event in document.below(xml.Event):
        acts = any(action.find(xml.PrivateAction) for action in event.all(xml.Action))
        if acts and not event.name.startswith("hold_"):
            found.setdefault(str(origins[event.name]), []).append(event.name)
    return found


def first_unlike(
    document: Element,
    origins: Mapping[str, Span],
    starts: Mapping[str, float],
    deviation: Deviation,
) -> str | None:
    """Return the line of the member during which an actor deviates first; None if none has begun.

    Args:
        document: The document.
        origins: The members of its events.
        starts: When actions begin in the world (s), by source line.
        deviation: The deviation of the document.
    """
    actor, since = min(
        ((actor, each.since) for actor, each in deviation.actors.items()),
        key=lambda found: found[1],
        default=("", math.inf),
    )
    of_actor = {
        str(origins[event.name])
        for group in document.below(xml.ManeuverGroup)
        if any(ref.entityRef == actor for ref in group.one(xml.Actors).all(xml.EntityRef))
        for event in group.below(xml.Event)
    }
    begun = [(at, source) for source, at in starts.items() if at <= since and source in of_actor]
    return max(begun)[1] if begun else None


Moment = tuple[str, bool]
"""An event, act or variable; whether its end is meant."""


def hops(document: Element) -> dict[str, int]:
    """Return the number of events and acts that precede each one in a chain, itself included."""
    before: dict[Moment, set[Moment]] = {}
    for act in document.below(xml.Act):
        before[act.name, False] = _awaited(act.find(xml.StartTrigger))
        ends = before.setdefault((act.name, True), set())
        ends |= _awaited(act.find(xml.StopTrigger))
        for event in act.below(xml.Event):
            awaited = _awaited(event.find(xml.StartTrigger))
            before[event.name, False] = {(act.name, False), *awaited}
            before[event.name, True] = {(event.name, False)}
            ends.add((event.name, False))
            for variable in _variables_set(event):
                before.setdefault((variable, True), set()).add((event.name, False))
    most = sum(not is_end for _, is_end in before)
    depth = dict.fromkeys(before, 0)
    for _ in range(most):  # in a circle all get the most
        changed = False
        for moment, others in before.items():
            longest = max((depth.get(other, 0) for other in others), default=0)
            new = min(longest + (not moment[1]), most)
            changed, depth[moment] = changed or new != depth[moment], new
        if not changed:
            break
    return {name: count for (name, is_end), count in depth.items() if not is_end}


def _awaited(trigger: Element | None) -> set[Moment]:
    """Return the elements that a trigger waits for."""
    found: set[Moment] = set()
    for node in () if trigger is None else trigger.walk():
        if isinstance(node, xml.StoryboardElementStateCondition):
            found.add((node.storyboardElementRef, node.state != "runningState"))
        elif node.tag in ("VariableCondition", "ParameterCondition"):
            found.add((node.get("variableRef") or node.said("parameterRef"), True))
    return found


def _variables_set(event: xml.Event) -> Iterator[str]:
    for action in event.walk():
        if action.tag in ("VariableAction", "ParameterAction"):
            yield action.get("variableRef") or action.said("parameterRef")


def _teleported(document: Element) -> Iterator[str]:
    """Yield the actors that the storyboard teleports, or moves along a line of their own."""
    for group in document.below(xml.ManeuverGroup):
        tags = {node.tag for event in group.below(xml.Event) for node in event.walk()}
        if tags & {"TeleportAction", "FollowTrajectoryAction"}:
            yield from (ref.entityRef for ref in group.one(xml.Actors).all(xml.EntityRef))


# --- Motion ---------------------------------------------------------------------------------------


def _deviation(
    expected: Sequence[Row],
    found: Sequence[Row],
    late: float,
    longest: float,
    dt: float,
    *,
    is_put: bool,
    fork: float,
) -> ActorDeviation:
    """Return the deviation of an actor.

    Args:
        expected: Its motion in the world.
        found: Its motion in the player; rows without a counterpart do not count.
        late: Longest delay of an event (s).
        longest: Longest delay of a jump (s).
        dt: Length of a step (s).
        is_put: It is teleported; it stood before.
        fork: When the tool may have taken another road (s); infinite if it takes this one.
    """
    there = {round(row[0] / dt): row for row in found}
    speeds = [v for *_, v in expected]
    spread = max(map(abs, speeds)) if is_put else max(speeds) - min(speeds)
    explained = EXACT + late * spread
    before = expected[0]
    first = there.get(round(before[0] / dt), before)
    begins_elsewhere = math.dist(before[1:3], first[1:3]) > JUMP
    jumped = 0.0 if begins_elsewhere else -longest
    worst, at, speed, since = 0.0, 0.0, 0.0, fork
    reach = math.ceil(late / dt - ROUNDING) + 1
    for row in expected[1:]:
        t, x, y, v = row
        if math.dist(before[1:3], (x, y)) > 2.0 * max(v, before[3], 1.0) * (t - before[0]):
            jumped = t
        before, step = row, round(t / dt)
        other = there.get(step)
        if other is None or t <= jumped + longest:
            continue
        apart = math.dist((x, y), other[1:3])
        if apart > worst:
            worst, at = apart, t
        if apart > explained:
            since = min(since, t)
        if abs(v - other[3]) > speed:
            speed = max(speed, _speed_apart(v, there, step, reach))
    return ActorDeviation(worst, at, speed, spread, since)


def _speed_apart(v: float, there: Mapping[int, Row], step: int, reach: int) -> float:
    """Return the least difference of a speed (m/s) from those within some steps."""
    near = (there[each] for each in range(step - reach, step + reach + 1) if each in there)
    return min(abs(v - row[3]) for row in near)
