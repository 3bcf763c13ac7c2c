"""Commands of a step: a name, the id of an actor, and values."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import carla

command = carla.command


def transform(pose: Sequence[float]) -> Any:
    """Return x, y, z, pitch, yaw, roll as a transform of the library."""
    x, y, z, pitch, yaw, roll = pose
    return carla.Transform(carla.Location(x, y, z), carla.Rotation(pitch, yaw, roll))


def _control(actor: int, *values: Any) -> Any:
    """Throttle, steer, brake, hand brake, reverse."""
    return command.ApplyVehicleControl(actor, carla.VehicleControl(*values))


def _walk(actor: int, x: float, y: float, speed: float) -> Any:
    return command.ApplyWalkerControl(
        actor, carla.WalkerControl(carla.Vector3D(x, y, 0.0), speed, False)
    )


def _place(actor: int, *pose: float) -> Any:
    return command.ApplyTransform(actor, transform(pose))


def _lead(actor: int, *values: float) -> Any:
    """Pose of a walker on the ground, and the speed (m/s) at which it walks ahead from there."""
    *pose, speed = values
    return command.ApplyWalkerState(actor, transform(pose), speed)


def _lights(actor: int, flags: int) -> Any:
    return command.SetVehicleLightState(actor, carla.VehicleLightState(flags))


COMMANDS: Mapping[str, Callable[..., Any]] = {
    "control": _control,
    "walk": _walk,
    "place": _place,
    "lead": _lead,
    "gravity": command.SetEnableGravity,
    "turning": lambda actor, x, y, z: command.ApplyTargetAngularVelocity(
        actor, carla.Vector3D(x, y, z)
    ),
    "velocity": lambda actor, x, y, z: command.ApplyTargetVelocity(actor, carla.Vector3D(x, y, z)),
    "physics": command.SetSimulatePhysics,
    "autopilot": command.SetAutopilot,
    "lights": _lights,
}


def command_of(given: Sequence[Any]) -> Any:
    """Return a command of a batch."""
    name, *values = given
    return COMMANDS[name](*values)
