"""Measures of rule violations: collisions, leaving the lanes, passing red lights."""

from __future__ import annotations

import math
from collections.abc import Mapping

from osc2tx_runtime.opendrive import DRIVING
from osc2tx_runtime.running.criteria import Criteria

from .measure import Moving, Scene


class Collisions:
    """Number of contacts; `collision_speed` is the greatest difference of velocities (m/s).

    Attributes:
        found: Time (s), both actors, and the difference of their velocities one step before (m/s).
    """

    name = "collisions"
    worst = "max"

    def __init__(self) -> None:
        self._before: Mapping[str, Moving] = {}
        self.found: list[tuple[float, str, str, float]] = []

    def observe(self, scene: Scene) -> None:
        """Evaluate the contacts of the last step."""
        if scene.step > 0:
            for one, other in scene.context.world.collisions():
                speed = _closing(self._before.get(one), self._before.get(other))
                self.found.append((scene.time, one, other, speed))
        self._before = {actor.id: actor for actor in scene.actors}

    def results(self) -> Mapping[str, float | None]:
        """Return the number and the greatest difference."""
        speed = max((each[-1] for each in self.found), default=None)
        return {self.name: float(len(self.found)), "collision_speed": speed}


def _closing(one: Moving | None, other: Moving | None) -> float:
    if one is None or other is None:
        return 0.0
    return math.hypot(other.vx - one.vx, other.vy - one.vy)


class OffRoad:
    """Time of vehicles off all driving lanes (s): the longest, and that of each vehicle."""

    name = "off_road"
    worst = "max"

    def __init__(self) -> None:
        self._seconds: dict[str, float] = {}

    def observe(self, scene: Scene) -> None:
        """Evaluate the last step."""
        road_map = scene.context.world.map
        for actor in scene.actors:
            if "vehicle" not in scene.context.actors[actor.id].kinds:
                continue
            place = actor.state.lane_position
            here = place is not None and (
                road_map.lane_type(place.road, place.lane, place.s) in DRIVING
            )
            spent = 0.0 if here or scene.step == 0 else scene.dt
            self._seconds[actor.id] = self._seconds.get(actor.id, 0.0) + spent

    def results(self) -> Mapping[str, float | None]:
        """Return the longest, then that of each vehicle that was off the road."""
        found: dict[str, float | None] = {self.name: max(self._seconds.values(), default=0.0)}
        for actor, seconds in sorted(self._seconds.items()):
            if seconds > 0.0:
                found[f"{self.name}({actor})"] = seconds
        return found


class RedLights:
    """Number of vehicles that passed the stop line of a light showing stop."""

    name = "red_lights"
    worst = "max"

    def __init__(self) -> None:
        self._criteria: Criteria | None = None

    def observe(self, scene: Scene) -> None:
        """Evaluate the stop lines passed in the last step."""
        if self._criteria is None:
            self._criteria = Criteria(scene.context, ("red_light",), is_noted=False)
        else:
            self._criteria.observe(scene.step)

    def results(self) -> Mapping[str, float | None]:
        """Return the number."""
        return {self.name: float(len(self._criteria.broken)) if self._criteria else 0.0}
