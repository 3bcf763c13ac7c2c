"""Sensor stacks: JSON files with the sensors of an actor, as in CARLA's ROS 2 examples.

A stack is a list of sensors, or an object with a list `sensors`: each has an `id`, a `type`
(blueprint), a `spawn_point` (x, y, z in m, roll, pitch, yaw in degrees, in the axes of ROS: x
forward, y left, z up), and `attributes`.

CARLA 0.9.16 publishes the data of sensors itself (`--ros2` of the server), under `/carla/<ros_name
of the vehicle>/<ros_name of the sensor>`.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from math import isfinite
from pathlib import Path
from typing import Any

from osc2tx_runtime.errors import InputError, SettingsError
from osc2tx_shared.classes import dataclass

from .cast import CastMember
from .client_process import ClientProcess

AXES = ("x", "y", "z", "roll", "pitch", "yaw")
CAMERA = ("/image", "/camera_info")
CLOUD = ("/point_cloud",)
SUFFIXES: Mapping[str, Sequence[str]] = {
    "sensor.camera": CAMERA,
    "sensor.lidar": CLOUD,
    "sensor.other.radar": ("",),
}
"""Suffixes of the topics of a sensor, by the first part of its blueprint; others have none."""

UNPUBLISHED = ("sensor.other.obstacle", "sensor.other.rss", "sensor.other.v2x")
MISSING_TOPICS = ("odometry", "vehicle_status", "vehicle_info")
"""Topics of the ROS bridge that the native ROS 2 of 0.9.16 lacks."""


@dataclass(frozen=True, slots=True)
class Sensor:
    """A sensor to attach.

    Attributes:
        id: Its role name and ROS name.
        type: Blueprint.
        place: x, y, z, pitch, yaw, roll on its vehicle, in CARLA's axes.
        attributes: Values of the blueprint's attributes.
    """

    id: str
    type: str
    place: tuple[float, ...]
    attributes: Mapping[str, str]


def read_stack(path: Path) -> tuple[Sensor, ...]:
    """Read a sensor stack.

    Raises:
        InputError: It cannot be read, or is invalid.
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError) as error:
        raise InputError(f"the sensors cannot be read: {path}: {error}") from error
    listed = content.get("sensors") if isinstance(content, dict) else content
    if not isinstance(listed, list):
        raise InputError(f"{path}: a list of sensors is missing")
    sensors = tuple(_sensor(path, each) for each in listed)
    names = [sensor.id for sensor in sensors]
    double = next((name for name in names if names.count(name) > 1), None)
    if double is not None:
        raise InputError(f"{path}: two sensors have the id {double}")
    return sensors


def _sensor(path: Path, written: Any) -> Sensor:
    try:
        name, kind = str(written["id"]), str(written["type"])
        point = written.get("spawn_point", {})
        x, y, z, roll, pitch, yaw = (float(point.get(axis, 0.0)) for axis in AXES)
        attributes = {key: str(value) for key, value in written.get("attributes", {}).items()}
        if not all(map(isfinite, (x, y, z, roll, pitch, yaw))):
            raise ValueError("a coordinate is not a number")
    except (ArithmeticError, AttributeError, KeyError, TypeError, ValueError) as error:
        raise InputError(f"{path}: a sensor needs id, type and spawn_point ({error})") from error
    if not kind.startswith("sensor."):
        raise InputError(f"{path}: {name}: {kind} is not a blueprint of a sensor")
    return Sensor(name, kind, (x, -y, z, -pitch, -yaw, roll), attributes)


def topics_of(vehicle: str, sensor: Sensor) -> tuple[str, ...]:
    """Return the topics that CARLA publishes for a sensor of a vehicle."""
    if sensor.type.startswith(UNPUBLISHED):
        return ()
    suffixes = next((s for kind, s in SUFFIXES.items() if sensor.type.startswith(kind)), ("",))
    return tuple(f"/carla/{vehicle}/{sensor.id}{suffix}" for suffix in suffixes)


class SensorStacks:
    """Sensors of the actors of a run.

    Args:
        files: Sensor stacks by the ids of actors.
    """

    def __init__(self, files: Mapping[str, Path]) -> None:
        self._stacks = {actor: read_stack(path) for actor, path in files.items()}

    @property
    def see_velocities(self) -> bool:
        """Whether a sensor measures velocities of other actors."""
        sensors = (each for stack in self._stacks.values() for each in stack)
        return any(each.type == "sensor.other.radar" for each in sensors)

    def attach(self, client: ClientProcess, members: Mapping[str, CastMember]) -> None:
        """Spawn the sensors with their names, then publish them.

        Raises:
            SettingsError: There is no such actor.
        """
        for actor, sensors in self._stacks.items():
            if actor not in members:
                raise SettingsError(f"--sensors {actor}: the scenario has no such actor")
            for sensor in sensors:
                names = {"role_name": sensor.id, "ros_name": sensor.id}
                attributes = {**sensor.attributes, **names}
                holder = members[actor].actor
                found = client.ask("spawn", sensor.type, attributes, sensor.place, holder)
                client.ask("enable_for_ros", found["id"])

    def table(self, roles: Mapping[str, str]) -> Iterator[str]:
        """Yield lines with the expected topics."""
        for actor, sensors in self._stacks.items():
            vehicle = roles.get(actor, actor)
            for sensor in sensors:
                for topic in topics_of(vehicle, sensor):
                    yield f"{topic}  ({sensor.type}, expected)"
                if not topics_of(vehicle, sensor):
                    yield f"{sensor.id}: CARLA does not publish {sensor.type}"
            if vehicle == "hero":
                yield f"/carla/{vehicle}/vehicle_control_cmd  (taken)"
                yield f"/carla/{vehicle}/ackermann_control_cmd  (taken)"
            missing = ", ".join(f"/carla/{vehicle}/{each}" for each in MISSING_TOPICS)
            yield f"not in CARLA 0.9.16: {missing}"
