"""How actors move: vehicles by the kinematic single-track model of `commonroad-vehicle-models`.

The model has no handedness, so it holds in CARLA's axes as it is. Tyres transmit no more than a
friction circle allows, and engines are as strong as the base type says. Contacts have no effect.
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from typing import Any

from vehiclemodels.parameters_vehicle2 import parameters_vehicle2
from vehiclemodels.vehicle_dynamics_ks import vehicle_dynamics_ks

from .actors import Actor
from .blueprints import TYRE_FRICTION, Blueprint

SUBSTEP = 0.01  # s, as in CARLA's default settings
GRAVITY = 9.81
DRAG = 0.0008  # 1/m
DAMPING = 0.01  # 1/s: of the speed of each body, the engine's default
BRAKING = 8.0  # m/s^2 of a full brake
STEERING_RATE = 8.0  # 1/s: how fast the wheels follow the wanted angle
RIGHTING = 60.0  # degrees/s
MAX_STEER = math.radians(70.0)
STEERING_CURVE = [[0.0, 1.0], [120.0, 0.5]]
"""Share of the full lock that a pedal gives, by speed (km/h)."""

THROTTLE = {"car": 5.0, "van": 4.0, "truck": 3.0, "bus": 3.0, "motorcycle": 6.0, "bicycle": 2.0}
"""Acceleration (m/s^2) of full throttle."""


@cache
def parameters_of(blueprint: Blueprint) -> Any:
    """Return the model's parameters, with the axles of a blueprint."""
    return replace(parameters_vehicle2(), a=blueprint.axle, b=blueprint.axle)


def move(actor: Actor, dt: float) -> None:
    """Move an actor over a step."""
    before = tuple(actor.velocity)
    if not actor.physics:  # only the physics of the engine knows a velocity
        actor.velocity, actor.turning = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
    elif actor.kind == "vehicle" and not actor.gravity:
        _float(actor, dt)
    elif actor.kind == "vehicle":
        _drive(actor, dt)
        _fall_on_wheels(actor, dt)
    elif actor.kind == "walker":
        _walk(actor, dt)
    actor.acceleration = [(new - old) / dt for new, old in zip(actor.velocity, before, strict=True)]


def _float(actor: Actor, dt: float) -> None:
    """Go on as a body that nothing holds: without load its tyres transmit nothing."""
    actor.velocity = [v * (1.0 - DAMPING * dt) for v in actor.velocity]
    actor.location = [at + v * dt for at, v in zip(actor.location, actor.velocity, strict=True)]
    about_x, about_y, about_z = actor.turning
    yaw = actor.yaw + 0.5 * math.radians(about_z) * dt
    ahead, aside = math.cos(yaw), math.sin(yaw)
    pitch, turn, roll = actor.rotation
    actor.rotation = [
        pitch + (about_x * aside - about_y * ahead) * dt,
        turn + about_z * dt,
        roll - (about_x * ahead + about_y * aside) * dt,
    ]


def _walk(actor: Actor, dt: float) -> None:
    (x, y, _), speed, _ = actor.walk
    far = math.hypot(x, y) or 1.0
    actor.velocity = [speed * x / far, speed * y / far, 0.0]
    if speed:
        actor.rotation[1] = math.degrees(math.atan2(y, x))
    actor.location = [at + v * dt for at, v in zip(actor.location, actor.velocity, strict=True)]


def _drive(actor: Actor, dt: float) -> None:
    """Go on over substeps; the model's reference point is the rear axle."""
    parameters = parameters_of(actor.blueprint)
    rear, yaw = parameters.b, actor.yaw
    ahead, aside = math.cos(yaw), math.sin(yaw)
    speed = actor.velocity[0] * ahead + actor.velocity[1] * aside
    if actor.constant is not None:
        speed = actor.constant[0]
    x, y = actor.location[0] - rear * ahead, actor.location[1] - rear * aside
    state = [x, y, actor.steered, speed, yaw]
    substeps = max(1, round(dt / SUBSTEP))
    for _ in range(substeps):
        state = _integrated(state, _inputs(actor, state), parameters, dt / substeps)
    x, y, actor.steered, speed, yaw = state
    if abs(speed) < 0.02 and not _accelerates(actor):
        speed = 0.0
    rate = speed / (parameters.a + parameters.b) * math.tan(actor.steered)
    ahead, aside, drift = math.cos(yaw), math.sin(yaw), rear * rate
    actor.location[:2] = [x + rear * ahead, y + rear * aside]
    actor.rotation[1] = (math.degrees(yaw) + 180.0) % 360.0 - 180.0
    actor.velocity = [speed * ahead - drift * aside, speed * aside + drift * ahead, 0.0]
    actor.turning = [0.0, 0.0, math.degrees(rate)]


def _fall_on_wheels(actor: Actor, dt: float) -> None:
    """Right a body that is tilted to a side.

    Rates are about the axes of the world, `v = w x r` by components as the engine has it: what
    turns about x to the positive lifts the right side, which is a negative roll.
    """
    roll = actor.rotation[2]
    actor.rotation[2] = math.copysign(max(abs(roll) - RIGHTING * dt, 0.0), roll)
    rate = (roll - actor.rotation[2]) / dt
    actor.turning[0] += rate * math.cos(actor.yaw)
    actor.turning[1] += rate * math.sin(actor.yaw)


def _accelerates(actor: Actor) -> bool:
    return actor.control[0] > 0.0 if actor.ackermann is None else actor.ackermann[2] != 0.0


def _inputs(actor: Actor, state: list[float]) -> list[float]:
    """Rate of the steering angle (rad/s) and acceleration (m/s^2), within the friction circle."""
    _, _, steered, speed, _ = state
    parameters = parameters_of(actor.blueprint)
    wheelbase = parameters.a + parameters.b
    grip = GRAVITY * min(actor.friction / TYRE_FRICTION, 1.0)
    if actor.ackermann is None:
        share = 1.0 - 0.5 * min(abs(speed) / STEERING_CURVE[1][0] * 3.6, 1.0)
        wanted, acceleration = actor.control[1] * share * MAX_STEER, _pedals(actor, speed)
    else:
        wanted, acceleration = actor.ackermann[0], _towards(actor, speed)
    if actor.constant is not None:
        acceleration = 0.0
    sharpest = min(MAX_STEER, math.atan(grip * wheelbase / max(speed * speed, 1.0)))
    wanted = min(max(wanted, -sharpest), sharpest)
    across = speed * speed * math.tan(steered) / wheelbase
    along = math.sqrt(max(grip * grip - across * across, 0.0))
    return [STEERING_RATE * (wanted - steered), min(max(acceleration, -along), along)]


def _pedals(actor: Actor, speed: float) -> float:
    """Acceleration (m/s^2) by throttle and brakes, and by the air."""
    throttle, _, brake, hand_brake, reverse = actor.control[:5]
    strength = THROTTLE[actor.blueprint.base]
    driving = throttle * (-strength if reverse else strength)
    braking = BRAKING * min(1.0, brake + (1.0 if hand_brake else 0.0))
    if speed == 0.0:
        return math.copysign(max(abs(driving) - braking, 0.0), driving)
    return (
        driving
        - DRAG * speed * abs(speed)
        - math.copysign(min(braking, abs(speed) / SUBSTEP), speed)
    )


def _towards(actor: Actor, speed: float) -> float:
    """Acceleration (m/s^2) of the Ackermann controller."""
    assert actor.ackermann is not None
    _, _, target, given, _ = actor.ackermann
    most = abs(given) or THROTTLE[actor.blueprint.base]
    return min(max(2.0 * (target - speed), -max(most, BRAKING)), most)


def _integrated(state: list[float], inputs: list[float], parameters: Any, dt: float) -> list[float]:
    """State after a Runge-Kutta step."""

    def rate(of: list[float]) -> list[float]:
        return vehicle_dynamics_ks(of, inputs, parameters)

    def after(slope: list[float], share: float) -> list[float]:
        return [value + share * dt * each for value, each in zip(state, slope, strict=True)]

    first = rate(state)
    second = rate(after(first, 0.5))
    third = rate(after(second, 0.5))
    fourth = rate(after(third, 1.0))
    slopes = zip(first, second, third, fourth, strict=True)
    return after([(a + 2.0 * b + 2.0 * c + d) / 6.0 for a, b, c, d in slopes], 1.0)
