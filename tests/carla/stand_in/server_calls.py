"""Calls about the server itself, the map, time and weather. Methods have the calls' names."""

from __future__ import annotations

from typing import Any

from .blueprints import BLUEPRINTS
from .rpc import CallError
from .simulation import SETTINGS, Simulation
from .snapshot import EPISODE_STREAM

GENERATED = "OpenDriveMap"
"""Name of the level that is generated from OpenDRIVE text."""


class ServerCalls:
    """Map, time, weather."""

    def __init__(self, simulation: Simulation, version: str) -> None:
        self._simulation, self._version = simulation, version
        self._sent_map = ""
        self._for_ros: set[int] = set()
        self._managers: dict[int, str] = {}  # hosts by port, as clients have listed them

    # --- connection ---------------------------------------------------------------------------

    def version(self) -> str:
        return self._version

    def get_episode_info(self) -> list[Any]:
        return [self._simulation.episode, self.get_sensor_token(EPISODE_STREAM)]

    def get_sensor_token(self, stream: int) -> list[bytes]:
        return [self._simulation.streams.token(stream)]

    def get_required_files(self, folder: str = "") -> list[str]:
        return []

    def query_lights_state(self, client: str) -> list[Any]:
        return []

    # --- map ----------------------------------------------------------------------------------

    def get_map_info(self) -> list[Any]:
        level = self._simulation.level
        return [f"Carla/Maps/{level.name}", level.spawn_points]

    def get_map_data(self) -> str:
        return self._simulation.level.text

    def get_available_maps(self) -> list[str]:
        return [f"/Game/Carla/Maps/{name}" for name in self._simulation.maps]

    def load_new_episode(self, name: str, reset: bool = True, layers: int = 0) -> None:
        simulation, name = self._simulation, name.rpartition("/")[2]
        if name == GENERATED:
            text = self._sent_map
        elif name in simulation.maps:
            text = simulation.maps[name].read_text(encoding="utf-8")
        else:
            raise CallError(f"map {name} not found")
        simulation.load_soon(name, text, SETTINGS if reset else simulation.settings)

    def copy_opendrive_to_file(self, text: str, parameters: list[Any]) -> None:
        self._sent_map = text

    def project_point(
        self, location: list[float], direction: list[float], reach: float
    ) -> list[Any]:
        ground = self._simulation.level.ground(location, 0.0)
        if ground is None:
            return [False, [[0.0, 0.0, 0.0], 0]]
        return [True, [[location[0], location[1], ground[0]], 1]]

    # --- time ---------------------------------------------------------------------------------

    def get_episode_settings(self) -> list[Any]:
        return self._simulation.settings

    def set_episode_settings(self, settings: list[Any]) -> int:
        self._simulation.settings = list(settings)
        return self.tick_cue()  # the client waits for a frame

    def tick_cue(self) -> int:
        self._simulation.step()
        return self._simulation.frame

    # --- weather, blueprints ------------------------------------------------------------------

    def get_weather_parameters(self) -> list[float]:
        return self._simulation.weather

    def set_weather_parameters(self, weather: list[float]) -> None:
        self._simulation.weather = list(weather)

    def get_actor_definitions(self) -> list[Any]:
        return [each.definition(uid) for uid, each in enumerate(BLUEPRINTS.values(), 1)]

    # --- Traffic Manager (it runs in the client; the server lists them), ROS 2 ------------------

    def is_traffic_manager_running(self, port: int) -> bool:
        return port in self._managers

    def get_traffic_manager_running(self, port: int) -> list[Any]:
        return [self._managers.get(port, ""), port if port in self._managers else 0]

    def add_traffic_manager_running(self, where: list[Any]) -> bool:
        host, port = where
        if port in self._managers:
            return False
        self._managers[port] = host
        return True

    def destroy_traffic_manager(self, port: int) -> bool:
        return self._managers.pop(port, None) is not None

    def enable_sensor_for_ros(self, stream: int) -> None:
        self._for_ros.add(stream)

    def disable_sensor_for_ros(self, stream: int) -> None:
        self._for_ros.discard(stream)

    def is_sensor_enabled_for_ros(self, stream: int) -> bool:
        return stream in self._for_ros
