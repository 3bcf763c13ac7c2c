"""Changes of traffic lights, weather and vehicle lights over time."""

from __future__ import annotations

from dataclasses import field
from typing import TYPE_CHECKING

from osc2tx_shared.classes import dataclass

from .json_values import Json, number, short, text

if TYPE_CHECKING:
    from osc2tx_runtime.opendrive import RoadMap


@dataclass
class Surroundings:
    """Changes by time, in the order of the trace.

    Attributes:
        signals: Id of a light to its changes: time, meaning, states of its lamps.
        lights: Id of an actor to its changes: time, lit lights.
        weather: Time, and the values that change then (SI units).
    """

    signals: dict[str, list[Json]] = field(default_factory=dict)
    lights: dict[str, list[Json]] = field(default_factory=dict)
    weather: list[Json] = field(default_factory=list)

    def add(self, kind: str, time: float, line: Json) -> None:
        """Add a line of the trace; lines of other kinds are ignored."""
        t = short(time, 4)
        if kind == "signal":
            bulbs = line.get("bulbs")
            lamps = [text(bulb) for bulb in bulbs] if isinstance(bulbs, list) else []
            change: Json = {"t": t, "state": text(line.get("state")), "lamps": lamps}
            self.signals.setdefault(text(line.get("signal")), []).append(change)
        elif kind == "lights":
            self.lights.setdefault(text(line.get("actor")), []).append(
                {"t": t, "lit": text(line.get("lit"))}
            )
        elif kind == "environment":
            values = {key: number(value) for key, value in line.items() if key not in ("t", "kind")}
            self.weather.append({"t": t, "values": values})

    def as_json(self, road_map: RoadMap | None) -> Json:
        """The data for the page; without a map, traffic lights have no positions."""
        return {
            "signals": [] if road_map is None else self._placed(road_map),
            "lights": self.lights,
            "weather": self.weather,
        }

    def _placed(self, road_map: RoadMap) -> list[Json]:
        placed: list[Json] = []
        for signal in road_map.signals():
            changes = self.signals.get(signal.id)
            if changes:
                pose = road_map.road_pose(signal.road, signal.s, signal.t)
                x, y = short(pose.x, 2), short(pose.y, 2)
                placed.append({"id": signal.id, "x": x, "y": y, "changes": changes})
        return placed
