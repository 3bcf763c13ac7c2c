"""Calls about vehicles. Methods have the calls' names."""

from __future__ import annotations

import math
from typing import Any

from .actors import Actor
from .dynamics import MAX_STEER, STEERING_CURVE
from .rpc import CallError
from .simulation import Simulation

WHEEL_RADIUS = 36.0  # cm
TRACK_SHARE = 0.8  # of the half width


class VehicleCalls:
    """Driving, lights, what a vehicle is like."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self._actor = simulation.actor

    def _vehicle(self, actor_id: int) -> Actor:
        actor = self._actor(actor_id)
        if actor.kind != "vehicle":
            raise CallError(f"actor {actor_id} is no vehicle")
        return actor

    def apply_control_to_vehicle(self, actor: int, control: list[Any]) -> None:
        vehicle = self._vehicle(actor)
        vehicle.control, vehicle.ackermann = list(control), None

    def apply_ackermann_control_to_vehicle(self, actor: int, control: list[float]) -> None:
        self._vehicle(actor).ackermann = list(control)

    def apply_physics_control(self, actor: int, control: list[Any]) -> None:
        self._vehicle(actor)

    def set_actor_autopilot(self, actor: int, enabled: bool) -> None:
        self._vehicle(actor)

    def get_physics_control(self, actor: int) -> list[Any]:
        vehicle = self._vehicle(actor)
        if not vehicle.physics:
            raise CallError("servers crash here: ask before physics is switched off")
        engine = [[[0.0, 500.0], [6000.0, 500.0]], 6000.0, 1.0, 0.15, 2.0, 0.35]
        gears = [True, 0.0, 10.0, 4.0, [[1.0, 0.5, 0.65]]]
        body = [1500.0, 0.3, [0.0, 0.0, 0.0], STEERING_CURVE]
        return [*engine, *gears, *body, self._wheels(vehicle), False]

    def _wheels(self, vehicle: Actor) -> list[Any]:
        ahead, aside = math.cos(vehicle.yaw), math.sin(vehicle.yaw)
        x, y, z = vehicle.location
        width, axle = TRACK_SHARE * vehicle.extent[1], vehicle.blueprint.axle
        wheels = []
        for along, right in ((axle, -width), (axle, width), (-axle, -width), (-axle, width)):
            place = [x + along * ahead - right * aside, y + along * aside + right * ahead, z]
            steer = math.degrees(MAX_STEER) if along > 0.0 else 0.0
            tyre = [vehicle.friction, 0.25, steer, WHEEL_RADIUS, 1500.0, 3000.0, 2.0, 17.0, 1000.0]
            wheels.append([*tyre, [100.0 * each for each in place]])  # world axes, centimetres
        return wheels

    def set_vehicle_light_state(self, actor: int, lights: Any) -> None:
        self._vehicle(actor).lights = lights[0] if isinstance(lights, list) else lights

    def get_vehicle_light_state(self, actor: int) -> list[int]:
        return [self._vehicle(actor).lights]

    def get_vehicle_light_states(self) -> list[Any]:
        actors = self._simulation.actors.values()
        return [[each.id, each.lights] for each in actors if each.kind == "vehicle"]
