"""Measures by name: of this package, and of installed packages."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence

from osc2tx_runtime.errors import OwnCode, ScenarioError, SettingsError
from osc2tx_runtime.world.state import ActorState

from .encroachment import MinEncroachment
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
