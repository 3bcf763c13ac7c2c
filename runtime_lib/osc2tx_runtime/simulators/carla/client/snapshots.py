"""Content of snapshots and sensors, as numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from threading import Lock
from typing import Any


def actor_state(found: Any) -> list[float]:
    """Return pose, velocity (m/s), turning (degrees/s) and acceleration (m/s^2) of an actor."""
    pose = found.get_transform()
    at, turn = pose.location, pose.rotation
    state = [at.x, at.y, at.z, turn.pitch, turn.yaw, turn.roll]
    for vector in (found.get_velocity(), found.get_angular_velocity(), found.get_acceleration()):
        state += [vector.x, vector.y, vector.z]
    return state


def light_states(lights: Mapping[str, Any]) -> Mapping[str, str]:
    """Return the states of the traffic lights, by OpenDRIVE id."""
    return {name: str(light.state) for name, light in lights.items() if name}


class Collisions:
    """Contacts reported by sensors, in a thread of the library."""

    def __init__(self) -> None:
        self._events: list[tuple[int, float, int, int, str]] = []
        self._lock = Lock()

    def add(self, event: Any) -> None:
        """Note a contact."""
        other = event.other_actor
        found = (event.frame, event.timestamp, event.actor.id, other.id, other.type_id)
        with self._lock:
            self._events.append(found)

    def take(self) -> Sequence[Sequence[Any]]:
        """Return time (s of the episode), actor, other actor and its blueprint, in order."""
        with self._lock:
            events, self._events = self._events, []
        return [event[1:] for event in sorted(events)]
