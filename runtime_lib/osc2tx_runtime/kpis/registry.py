"""Measures by name: of this package, and of installed packages."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from numbers import Real
from typing import Any

from osc2tx_runtime.errors import OwnCode, ScenarioError, SettingsError
from osc2tx_runtime.kpis.encroachment import MinEncroachment
from osc2tx_runtime.kpis.measure import Measure, Scene, scene_of
from osc2tx_runtime.kpis.pairs import MinGap, MinTimeGap, MinTimeToCollision
from osc2tx_runtime.kpis.rules import Collisions, OffRoad, RedLights
from osc2tx_runtime.language.context import ExecutionContext
from osc2tx_runtime.world.state import ActorState


class _Greatest:
    """The greatest value of all actors and steps, and of each actor."""

    name = ""
    worst = "max"

    def __init__(self) -> None:
        self._before: dict[str, ActorState] = {}
        self._greatest: dict[str, float] = {}

    def results(self) -> Mapping[str, float | None]:
        """Return the greatest value of all, then that of each actor: `max_jerk(ego)`."""
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
    """Greatest deceleration (m/s^2): decrease of the absolute speed over a step."""

    name = "max_deceleration"

    def observe(self, scene: Scene) -> None:
        """Evaluate the last step."""
        for actor, before, after in self._steps(scene):
            self._note(actor, (abs(before.v) - abs(after.v)) / scene.dt)


class MaxJerk(_Greatest):
    """Greatest longitudinal jerk (m/s^3): change of the acceleration from step to step."""

    name = "max_jerk"

    def observe(self, scene: Scene) -> None:
        """Evaluate the last step."""
        for actor, before, after in self._steps(scene):
            if scene.step > 1:  # the start has no acceleration of a step
                self._note(actor, abs(after.a - before.a) / scene.dt)


class MaxLateralAcceleration(_Greatest):
    """Greatest lateral acceleration (m/s^2): speed times yaw rate over a step."""

    name = "max_lateral_acceleration"

    def observe(self, scene: Scene) -> None:
        """Evaluate the last step."""
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
"""The measures of this package; a campaign takes all of them by default."""


def measures_by_name(names: Sequence[str]) -> dict[str, Callable[[], Measure]]:
    """Return classes of measures.

    Raises:
        SettingsError: A name is unknown, or its class cannot be loaded.
    """
    return {name: MEASURES[name] if name in MEASURES else _installed(name) for name in names}


def _installed(name: str) -> Callable[[], Measure]:
    from importlib.metadata import entry_points

    entries = {entry.name: entry for entry in entry_points(group=ENTRY_POINTS)}
    if name not in entries:
        known = ", ".join([*MEASURES, *sorted(entries)])
        raise SettingsError(f"--kpi {name}: there is no such measure; available: {known}")
    try:
        with OwnCode(f"--kpi {name}: {entries[name].value}:"):
            found: Callable[[], Measure] = entries[name].load()
    except ScenarioError as error:
        raise SettingsError(error.message) from error
    if not callable(found):
        raise SettingsError(f"--kpi {name}: {entries[name].value} is not a class")
    return found


class Measuring:
    """The measures of one run, as its observer; it also keeps the samples of coverage items.

    Args:
        makers: Create the measures when the run begins.

    Attributes:
        samples: `cover` or `record`, and the fields of the value in the trace.
    """

    def __init__(self, makers: Iterable[Callable[[], Measure]]) -> None:
        self._makers = tuple(makers)
        self._measures: tuple[Measure, ...] = ()
        self._context: ExecutionContext | None = None
        self.samples: list[tuple[str, Mapping[str, Any]]] = []

    def begin(self, context: ExecutionContext) -> None:
        """Evaluate the start; an earlier attempt at a start does not count."""
        self._context = context
        self._measures = tuple(make() for make in self._makers)
        self.samples.clear()
        self.observe(0)

    def observe(self, step: int) -> None:
        """Evaluate a step."""
        assert self._context is not None, "it has begun"
        if not self._measures:
            return
        scene = scene_of(self._context, step)
        for measure in self._measures:
            with OwnCode(f"measure {type(measure).__name__} raised"):
                measure.observe(scene)

    def sampled(self, kind: str, values: Mapping[str, Any]) -> None:
        """Keep the value of a coverage item."""
        self.samples.append((kind, dict(values)))

    def results(self) -> dict[str, float | None]:
        """Return all values by name; empty for a run that never began.

        Raises:
            ScenarioError: A measure of the user raises an exception, or has values of other types.
        """
        found: dict[str, float | None] = {}
        for measure in self._measures:
            told = f"measure {type(measure).__name__}"
            with OwnCode(f"{told} raised"):
                results: dict[str, Any] = dict(measure.results())
            for name, value in results.items():
                if value is not None and not isinstance(value, Real):
                    raise ScenarioError(f"{told}: its value {name} is {value!r}, no number or None")
                found[name] = None if value is None else float(value)
        return found

    @property
    def collisions(self) -> tuple[tuple[float, str, str, float], ...]:
        """Contacts: time (s), both actors, difference of their velocities (m/s)."""
        found = (each.found for each in self._measures if isinstance(each, Collisions))
        return tuple(contact for contacts in found for contact in contacts)
