"""Actors: what the server knows of each, in CARLA's axes.

x forward, y right, z up (m); pitch, yaw and roll in degrees, yaw clockwise from above.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

from .blueprints import TYRE_FRICTION, Blueprint


def zeros() -> list[float]:
    """Return a vector of zeros."""
    return [0.0, 0.0, 0.0]


@dataclass
class Light:
    """A traffic light: states are 0 red, 1 yellow, 2 green, 3 off.

    Attributes:
        sign: Id of its signal in the OpenDRIVE file.
        since: Seconds in this state.
        times: Seconds of red, yellow and green.
    """

    sign: str
    state: int = 0
    since: float = 0.0
    frozen: bool = False
    times: list[float] = field(default_factory=lambda: [2.0, 3.0, 10.0])


@dataclass
class Actor:
    """An actor.

    Attributes:
        attributes: Name, type and value of each, as the client sent them.
        velocity: World axes (m/s).
        turning: Degrees per second about the world axes.
        control: throttle, steer, brake, hand brake, reverse, manual gear shift, gear.
        ackermann: Steering angle (rad), its speed, speed, acceleration, jerk; None without.
        walk: Direction, speed (m/s), jump.
        constant: Velocity in its own axes that it is kept at (m/s); None without.
        steered: Angle of the front wheels (rad), positive to the right.
        dormant: A large level has put it to sleep.
        stream: Of a sensor; 0 for those without.
    """

    id: int
    blueprint: Blueprint
    attributes: list[list[Any]]
    location: list[float]
    rotation: list[float]
    parent: int = 0
    velocity: list[float] = field(default_factory=zeros)
    turning: list[float] = field(default_factory=zeros)
    acceleration: list[float] = field(default_factory=zeros)
    control: list[Any] = field(default_factory=lambda: [0.0, 0.0, 0.0, False, False, False, 0])
    ackermann: list[float] | None = None
    walk: list[Any] = field(default_factory=lambda: [[1.0, 0.0, 0.0], 0.0, False])
    constant: list[float] | None = None
    physics: bool = True
    gravity: bool = True
    dormant: bool = False
    lights: int = 0
    friction: float = TYRE_FRICTION
    steered: float = 0.0
    stream: int = 0
    light: Light | None = None

    @property
    def kind(self) -> str:
        """First word of the blueprint."""
        return self.blueprint.kind

    @property
    def extent(self) -> tuple[float, float, float]:
        """Half length, width and height (m)."""
        return self.blueprint.extent

    @property
    def solid(self) -> bool:
        """Whether it can be touched."""
        return self.extent[0] > 0.0

    @property
    def yaw(self) -> float:
        """Radians, clockwise from above."""
        return math.radians(self.rotation[1])

    def attribute(self, name: str) -> str:
        """Return the value of an attribute, empty if it has none."""
        return next((str(value) for key, _, value, *_ in self.attributes if key == name), "")


def touch(one: Actor, other: Actor) -> bool:
    """Whether two boxes touch, seen from above and as to height."""
    dx, dy = other.location[0] - one.location[0], other.location[1] - one.location[1]
    if math.hypot(dx, dy) > math.hypot(*one.extent[:2]) + math.hypot(*other.extent[:2]):
        return False
    if abs(other.location[2] - one.location[2]) > 2.0 * max(one.extent[2], other.extent[2]):
        return False
    axes = [(math.cos(each.yaw), math.sin(each.yaw)) for each in (one, other)]
    normals = [axis for x, y in axes for axis in ((x, y), (-y, x))]
    return all(abs(dx * x + dy * y) <= _reach(one, x, y) + _reach(other, x, y) for x, y in normals)


def _reach(actor: Actor, x: float, y: float) -> float:
    """Half the width of a box (m) seen along an axis."""
    ahead, aside = math.cos(actor.yaw), math.sin(actor.yaw)
    length, width, _ = actor.extent
    return length * abs(ahead * x + aside * y) + width * abs(ahead * y - aside * x)
