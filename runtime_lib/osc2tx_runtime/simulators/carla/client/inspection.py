"""Requests of `osc2tx world check`: findings, and the values that a session has to restore."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import carla

from .session import Session, written

REACH = 20.0  # m: depth of the search for ground
SPAWNED = ("vehicle.", "walker.", "sensor.", "static.", "controller.")
WEATHER = (
    "cloudiness",
    "fog_density",
    "precipitation",
    "precipitation_deposits",
    "sun_altitude_angle",
    "sun_azimuth_angle",
    "wetness",
    "wind_intensity",
)


class Inspection:
    """Inspects the server of a session; its methods are requests.

    Args:
        session: A connected session, except for `library`.
    """

    def __init__(self, session: Session) -> None:
        self._session = session

    def library(self) -> Mapping[str, str]:
        """Return version and file of the client library."""
        client = carla.Client("localhost", 1)
        return {"version": client.get_client_version(), "file": carla.__file__}

    def situation(self) -> Mapping[str, Any]:
        """Return what a session may change: settings, weather, actors, camera, lights.

        `substeps` are the seconds of a step that substeps of the physics can cover.
        """
        world = self._session.world
        settings, weather, actors = world.get_settings(), world.get_weather(), world.get_actors()
        spawned = [each for each in actors if each.type_id.startswith(SPAWNED)]
        lights = actors.filter("traffic.traffic_light*")
        return {
            "settings": [settings.synchronous_mode, settings.fixed_delta_seconds],
            "substeps": (
                settings.max_substeps * settings.max_substep_delta_time
                if settings.substepping
                else None
            ),
            "weather": [round(getattr(weather, name), 3) for name in WEATHER],
            "actors": sorted([a.id, a.type_id, a.attributes.get("role_name", "")] for a in spawned),
            "camera": [round(each, 2) for each in written(world.get_spectator().get_transform())],
            "frozen": sorted(light.get_opendrive_id() for light in lights if light.is_frozen()),
        }

    def remove(self, actors: Sequence[int]) -> None:
        """Destroy actors that a former client has left."""
        destroy = [carla.command.DestroyActor(each) for each in actors]
        self._session.client.apply_batch_sync(destroy, False)

    def ground(self, points: Sequence[Sequence[float]]) -> Sequence[float | None]:
        """Return the height (m) of the ground below each point; None without ground."""
        world = self._session.world
        found = [world.ground_projection(carla.Location(*point), REACH) for point in points]
        return [None if each is None else each.location.z for each in found]
