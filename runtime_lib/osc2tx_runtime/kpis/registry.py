"""Measures by name: of this package, and of installed packages."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from osc2tx_runtime.errors import OwnCode, ScenarioError, SettingsError
from osc2tx_runtime.world.state import ActorState

from .measure import Measure, Scene
from .pairs import MinGap, MinTimeGap, MinTimeToCollision
from .rules import Collisions, OffRoad, RedLights


class _Greatest:
    """The greatest value of all actors and steps, and of each actor."""

    name = ""
    worst = "max"

    def __init__(self) -> None:
        self._before: dict[str, ActorState] = {}
        self._greatest: dict[str, float] = {}

    def results(self) -> Mapping[str, float | None]:
        """Return the greatest of all, then that of each actor: `max_jerk(ego)`."""
        found: dict[str, float | None] = {self.name: max(self._greatest.values(), default=None)}
        for actor, value in sorted(self._greatest.items()):
            found[f"{self.name}({actor})"] = value
        return found

    def _note(self, actor: str, value: float) -> None:
        self._greatest[actor] = max(value, self._greatest.get(actor, 0.0))

    def _steps(self, scene: Scene) -> Iterator[tuple[str, ActorState, ActorState]]:
        """Yield each actor with its state before the step and after it."""
        for actor in scene.actors:
            before = self._before.get(actor.id)
            self._before[actor.id] = actor.state
            if before is not None:
                yield actor.id, before, actor.state


class MaxDeceleration(_Greatest):
    """Strongest braking (m/s^2): how fast the amount of the speed falls, over a step."""

    name = "max_deceleration"

    def observe(self, scene: Scene) -> None:
        """Look at the last step."""
        for actor, before, after in self._steps(scene):
            self._note(actor, (abs(before.v) - abs(after.v)) / scene.dt)


class MaxJerk(_Greatest):
    """Greatest jerk along the way (m/s^3): change of the acceleration from step to step."""

    name = "max_jerk"

    def observe(self, scene: Scene) -> None:
        """Look at the last step."""
        for actor, before, after in self._steps(scene):
            if scene.step > 1:  # at the start there was no step to have an acceleration from
                self._note(actor, abs(after.a - before.a) / scene.dt)


class MaxLateralAcceleration(_Greatest):
    """Greatest acceleration to the side (m/s^2): speed times turn of the heading, over a step."""

    name = "max_lateral_acceleration"

    def observe(self, scene: Scene) -> None:
        """Look at the last step."""
        for actor, before, after in self._steps(scene):
            turn = math.remainder(after.h - before.h, math.tau) / scene.dt
            self._note(actor, abs(0.5 * (before.v + after.v) * turn))


Rows = NDArray[np.float64]

_TIME, _X, _Y, _COS, _SIN, _LENGTH, _WIDTH = range(7)


class MinEncroachment:
    """Least post-encroachment time (s): between two actors at one place, one after the other.

    To a step: boxes at one step count as there until the next one. 0 if two touch; no value for a
    pair whose ways have no common place.
    """

    name = "min_pet"
    worst = "min"

    def __init__(self) -> None:
        self._ways: dict[str, list[tuple[float, ...]]] = {}

    def observe(self, scene: Scene) -> None:
        """Note the positions of all actors; an actor at standstill is there once, for as long."""
        for actor in scene.actors:
            box = actor.box
            half = box.half_length, box.half_width
            place = (scene.time, box.x, box.y, box.cos, box.sin, *half)
            self._ways.setdefault(actor.id, []).append(place)

    def results(self) -> Mapping[str, float | None]:
        """Return the least of all, then that of each pair."""
        ways = {name: np.array(way) for name, way in self._ways.items()}
        least = {
            f"{self.name}({one},{other})": _least(ways[one], ways[other])
            for one, other in combinations(ways, 2)
        }
        known = [value for value in least.values() if value is not None]
        pairs = {name: value for name, value in sorted(least.items()) if value is not None}
        return {self.name: min(known, default=None), **pairs}


def _least(one: Rows, other: Rows) -> float | None:
    """Return the least time between two boxes at one place."""
    reach = np.hypot(one[0, _LENGTH], one[0, _WIDTH]) + np.hypot(
        other[0, _LENGTH], other[0, _WIDTH]
    )
    if not _near(one, other, reach):
        return None
    apart = (one[:, None, _X] - other[None, :, _X]) ** 2
    apart += (one[:, None, _Y] - other[None, :, _Y]) ** 2
    first, second = np.nonzero(apart <= reach * reach)
    if not len(first):
        return None
    times = np.abs(one[first, _TIME] - other[second, _TIME])
    overlap = _overlap(one[first], other[second])
    return float(times[overlap].min()) if overlap.any() else None


def _near(one: Rows, other: Rows, reach: float) -> bool:
    """Whether the rectangles around two ways come as near as that."""
    places = [_X, _Y]
    low, high = one[:, places].min(axis=0), one[:, places].max(axis=0)
    return bool(
        np.all(other[:, places].min(axis=0) <= high + reach)
        and np.all(other[:, places].max(axis=0) >= low - reach)
    )


def _overlap(one: Rows, other: Rows) -> NDArray[np.bool_]:
    """Whether boxes of two lists have a common point, by the four separating axes."""
    x, y = other[:, _X] - one[:, _X], other[:, _Y] - one[:, _Y]
    along = np.abs(one[:, _COS] * other[:, _COS] + one[:, _SIN] * other[:, _SIN])
    cross = np.abs(one[:, _COS] * other[:, _SIN] - one[:, _SIN] * other[:, _COS])
    found: NDArray[np.bool_] = np.ones(len(x), dtype=np.bool_)
    for me, you in ((one, other), (other, one)):
        forward = np.abs(x * me[:, _COS] + y * me[:, _SIN])
        sideways = np.abs(y * me[:, _COS] - x * me[:, _SIN])
        found &= forward <= me[:, _LENGTH] + you[:, _LENGTH] * along + you[:, _WIDTH] * cross
        found &= sideways <= me[:, _WIDTH] + you[:, _LENGTH] * cross + you[:, _WIDTH] * along
    return found


ENTRY_POINTS = "osc2tx.kpis"
"""Group of entry points; each names a class of measures, by the name that `--kpi` takes."""

MEASURES: Mapping[str, Callable[[], Measure]] = {
    each.name: each
    for each in (
        MinTimeToCollision,
        MinGap,
        MinTimeGap,
        MinEncroachment,
        MaxDeceleration,
        MaxJerk,
        MaxLateralAcceleration,
        Collisions,
        OffRoad,
        RedLights,
    )
}
"""The measures of this package; a campaign takes all of them where it names none."""


def measures_by_name(names: Sequence[str]) -> dict[str, Callable[[], Measure]]:
    """Return classes of measures.

    Raises:
        SettingsError: There is none of a name, or it cannot be loaded.
    """
    return {name: MEASURES[name] if name in MEASURES else _installed(name) for name in names}


def _installed(name: str) -> Callable[[], Measure]:
    from importlib.metadata import entry_points

    entries = {entry.name: entry for entry in entry_points(group=ENTRY_POINTS)}
    if name not in entries:
        known = ", ".join([*MEASURES, *sorted(entries)])
        raise SettingsError(f"--kpi {name}: there is no such measure; there is: {known}")
    try:
        with OwnCode(f"--kpi {name}: {entries[name].value}:"):
            found: Callable[[], Measure] = entries[name].load()
    except ScenarioError as error:
        raise SettingsError(error.message) from error
    if not callable(found):
        raise SettingsError(f"--kpi {name}: {entries[name].value} is no class")
    return found
