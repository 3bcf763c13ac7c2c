"""Observation and control of an external driver: the interface for a system under test."""

from __future__ import annotations

from typing import Protocol

from osc2tx_runtime.opendrive import LanePosition, Pose
from osc2tx_runtime.world.actor_dimensions import Limits, Shape
from osc2tx_runtime.world.protocol import LightState
from osc2tx_runtime.world.surroundings.stop_lines_ahead import StopLine
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True)
class Control:
    """The controls of a driver, valid until the next ones.

    The vehicle follows them within its limits, the steering of its front wheels, and the grip of
    the road. Braking never reverses it.

    Attributes:
        acceleration: m/s^2 along its axis; negative brakes.
        steering: Angle (rad) of the front wheels, positive to the left.
    """

    acceleration: float = 0.0
    steering: float = 0.0


@dataclass(frozen=True, slots=True)
class LaneView:
    """The lane under the vehicle.

    Attributes:
        position: Road, lane, road coordinate (m), offset to the left of the centre (m).
        width: m.
        heading: Heading of the vehicle relative to the lane (rad), positive to the left.
    """

    position: LanePosition
    width: float
    heading: float


@dataclass(frozen=True, slots=True)
class OtherActor:
    """Another actor in sight.

    Attributes:
        id: Name in the scenario.
        kind: Actor kind of the language: `vehicle`, `person`, ...
        pose: Of its reference point.
        speed: m/s along its heading.
        shape: Its box and reference point.
        ahead: Metres along the lanes from one reference point to the other, negative behind; None
            if no lanes lead there.
        left: Lateral distance (m), positive to the left; None likewise.
    """

    id: str
    kind: str
    pose: Pose
    speed: float
    shape: Shape
    ahead: float | None
    left: float | None


@dataclass(frozen=True, slots=True)
class Observation:
    """The world at one step for an external driver.

    World axes are the axes of the map (x, y in metres, counter-clockwise angles in radians), and
    the reference point of a vehicle is the middle of its rear axle.

    Attributes:
        time: Seconds since the start of the scenario.
        speed: m/s.
        acceleration: m/s^2 over the last step.
        pose: Of the reference point.
        shape: Size of the vehicle, with its wheelbase.
        limits: Its limits on the present road.
        lane: The lane under it; None off the road.
        route: Positions on the centre of the lanes ahead, every `ROUTE_STEP` metres, at forks
            towards the destination of the actor; empty off the road.
        others: Other actors in sight, in the order of the cast.
        stop_line: First stop line ahead whose light requires a stop; None without one.
        lights: Its own lights.
    """

    time: float
    speed: float
    acceleration: float
    pose: Pose
    shape: Shape
    limits: Limits
    lane: LaneView | None
    route: tuple[Pose, ...]
    others: tuple[OtherActor, ...]
    stop_line: StopLine | None
    lights: LightState


class Driver(Protocol):
    """The driver of an actor of the scenario, created for each run: `Driver()`."""

    def step(self, observation: Observation, dt: float) -> Control:
        """Return the controls until the next step, `dt` seconds from now."""
