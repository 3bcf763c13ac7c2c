"""The state of an actor at one instant."""

from __future__ import annotations

from typing import NamedTuple

from osc2tx_runtime.opendrive import LanePosition

from .actor_dimensions import Shape


class ActorState(NamedTuple):
    """State of an actor at a step; a tuple for speed.

    Attributes:
        x: World x of the reference point (m).
        y: World y (m).
        z: World z (m).
        h: Heading (rad), counter-clockwise from x.
        v: Speed along the heading (m/s), negative in reverse.
        a: Acceleration (m/s^2): change of `v` over the last step.
        lane_position: Position on the lane graph; None off the road.
        lateral_speed: Lateral speed (m/s), to the left in the lane.
        shape: Bounding box and reference point.
        pitch: Nose down (rad).
        roll: Right side down (rad).
    """

    x: float
    y: float
    z: float
    h: float
    v: float
    a: float
    lane_position: LanePosition | None
    lateral_speed: float
    shape: Shape
    pitch: float = 0.0
    roll: float = 0.0

    @property
    def road(self) -> str | None:
        """Road under the reference point; None off the roads."""
        return None if self.lane_position is None else self.lane_position.road

    @property
    def lane(self) -> int | None:
        """Lane id on that road."""
        return None if self.lane_position is None else self.lane_position.lane

    @property
    def s(self) -> float | None:
        """Road coordinate (m)."""
        return None if self.lane_position is None else self.lane_position.s

    @property
    def offset(self) -> float | None:
        """Metres to the left of the lane centre in direction of travel."""
        return None if self.lane_position is None else self.lane_position.offset

    @property
    def length(self) -> float:
        """Length of the bounding box (m)."""
        return self.shape.length

    @property
    def width(self) -> float:
        """Width of the bounding box (m)."""
        return self.shape.width

    @property
    def height(self) -> float:
        """Height of the bounding box (m)."""
        return self.shape.height

    @property
    def rear(self) -> float:
        """Metres from the rear end to the reference point."""
        return self.shape.rear
