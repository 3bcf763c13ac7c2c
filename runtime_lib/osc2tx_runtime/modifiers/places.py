"""Modifiers of the place along the road and in the world (DSL 8.9.2, 8.9.3, 8.9.13, 8.7.4.1)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from osc2tx_runtime.errors import ScenarioError

from .base import At, Modifier, Value, at_most_one, upright

if TYPE_CHECKING:
    from osc2tx_runtime.actors import PhysicalObject
    from osc2tx_runtime.values import Point, Pose

__all__ = ["Distance", "KeepPosition", "Location", "Position"]


@dataclass(frozen=True, slots=True)
class Position(Modifier):
    """Place along the road, or in the world.

    Attributes:
        distance: Metres ahead of or behind a reference, else from the start of the road.
        time: Seconds times the speed of the one behind, instead of a distance.
        ahead_of: Reference.
        behind: Reference.
        ahead_of_point: Reference point in the world, projected on the road.
        behind_point: Likewise.
        at_point: Point in the world.
        x: World x (m).
        y: World y (m).
        z: World z (m).
        h: Heading (rad).
        project_on_route: `at_point` only says how far along the road and on which lane; False:
            the actor is at the point itself.
        frame: `carla`: left-handed, y and heading with the opposite sign, box centre.
        at: When it holds.
    """

    name = "position"
    distance: Value | None = None
    time: Value | None = None
    ahead_of: PhysicalObject | None = None
    behind: PhysicalObject | None = None
    ahead_of_point: Point | None = None
    behind_point: Point | None = None
    at_point: Point | None = None
    project_on_route: bool = True
    x: float | None = None
    y: float | None = None
    z: float | None = None
    h: float | None = None
    frame: Literal["world", "carla"] = "world"
    at: At = "all"

    def __post_init__(self) -> None:
        at_most_one(
            "position: ahead_of, behind, ahead_of_point, behind_point",
            self.ahead_of,
            self.behind,
            self.ahead_of_point,
            self.behind_point,
        )
        at_most_one(
            "position: distance, time, at_point, x", self.distance, self.time, self.at_point, self.x
        )
        if self.distance is None and self.time is None and not self.absolute:
            raise ScenarioError("position: give a distance, a time or a point")
        if self.absolute and (self.reference is not None or self.reference_point is not None):
            raise ScenarioError("position: a point in the world leaves no room for a reference")
        if self.time is not None and self.reference is None:
            raise ScenarioError("position: a time needs ahead_of or behind")
        if (self.x is None) != (self.y is None):
            raise ScenarioError("position: give both x and y")

    @property
    def reference(self) -> PhysicalObject | None:
        """The actor it is relative to."""
        return self.ahead_of or self.behind

    @property
    def reference_point(self) -> Point | None:
        """The point it is relative to."""
        return self.ahead_of_point or self.behind_point

    @property
    def ahead(self) -> bool:
        """True for a place ahead of its reference."""
        return self.ahead_of is not None or self.ahead_of_point is not None

    @property
    def absolute(self) -> bool:
        """True for a point in the world."""
        return self.at_point is not None or self.x is not None


@dataclass(frozen=True, slots=True)
class Location(Modifier):
    """A fixed pose of the reference point, for objects that never move."""

    name = "location"
    pose: Pose

    def __post_init__(self) -> None:
        upright("location", self.pose.pitch, self.pose.roll)


@dataclass(frozen=True, slots=True)
class KeepPosition(Modifier):
    """The place in the world at the start of the action."""

    name = "keep_position"


@dataclass(frozen=True, slots=True)
class Distance(Modifier):
    """Way (m) covered during the action: it ends then, or takes exactly its duration for it."""

    name = "distance"
    distance: Value
