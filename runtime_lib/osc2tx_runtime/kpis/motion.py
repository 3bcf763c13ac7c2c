"""Measures of one actor: braking, jerk, acceleration to the side."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from osc2tx_runtime.world.state import ActorState

from .measure import Scene

__all__ = ["MaxDeceleration", "MaxJerk", "MaxLateralAcceleration"]


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
