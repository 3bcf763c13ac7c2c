"""Value classes of points, orientations, poses and route points, SI units."""

from __future__ import annotations

import math
from typing import Literal

from osc2tx_runtime.errors import PlacementError, ScenarioError
from osc2tx_shared.classes import dataclass


class Rgb(str):
    """A colour as red, green and blue from 0 to 255: `0,128,0`."""

    __slots__ = ()


@dataclass(frozen=True, slots=True)
class Point:
    """A point in world coordinates (m)."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0

    def norm(self) -> float:
        """Distance from the origin (m)."""
        return math.sqrt(self.x * self.x + self.y * self.y + self.z * self.z)


@dataclass(frozen=True, slots=True)
class Orientation:
    """An orientation (rad), applied in the order yaw, pitch, roll (ISO 8855)."""

    roll: float = 0.0
    pitch: float = 0.0
    yaw: float = 0.0


@dataclass(frozen=True, slots=True)
class Pose:
    """A point (m) with an orientation (rad); in paths a yaw of None follows the path.

    Attributes:
        x: Metres along x of the world.
        y: Metres along y.
        z: Metres above the ground of the world.
        roll: Right side down.
        pitch: Nose down.
        yaw: Counter-clockwise from x.
    """

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    roll: float = 0.0
    pitch: float = 0.0
    yaw: float | None = None

    def __init__(
        self,
        x: float = 0.0,
        y: float = 0.0,
        z: float = 0.0,
        roll: float = 0.0,
        pitch: float = 0.0,
        yaw: float | None = None,
        *,
        position: Point | None = None,
        orientation: Orientation | None = None,
    ) -> None:
        """Create a pose from numbers, or from a point and an orientation."""
        if position is not None:
            x, y, z = position.x, position.y, position.z
        if orientation is not None:
            roll, pitch, yaw = orientation.roll, orientation.pitch, orientation.yaw
        values = {"x": x, "y": y, "z": z, "roll": roll, "pitch": pitch, "yaw": yaw}
        for name, value in values.items():
            object.__setattr__(self, name, value)

    @property
    def position(self) -> Point:
        """Where it is."""
        return Point(self.x, self.y, self.z)

    @property
    def orientation(self) -> Orientation:
        """Its orientation."""
        return Orientation(self.roll, self.pitch, self.yaw or 0.0)


class RoutableDot:
    """The route members of points (DSL 8.12.5): points occur in routes, but have no extent.

    It has no length and no lanes.
    """

    __slots__ = ()

    @property
    def length(self) -> float:
        """None (m)."""
        return 0.0

    @property
    def directionality(self) -> Literal["none"]:
        """No direction."""
        return "none"

    @property
    def min_lanes(self) -> int:
        """No lanes."""
        return 0

    @property
    def max_lanes(self) -> int:
        """No lanes."""
        return 0

    @property
    def anchors(self) -> list[str]:
        """It is not part of the map file."""
        return []

    def start_point(self) -> RoutePoint:
        """Its start.

        Raises:
            ScenarioError: A point has no start.
        """
        raise ScenarioError("a point is not a route with a begin and an end: convert it to one")

    def end_point(self) -> RoutePoint:
        """Its end; as `start_point`."""
        return self.start_point()


@dataclass(frozen=True, slots=True)
class OdrPoint(RoutableDot):
    """A point in road coordinates.

    Attributes:
        road_id: Road.
        lane_id: Lane; None or empty: `t` counts from the reference line of the road.
        s: Road coordinate (m).
        t: Metres to the left in the direction of s, from the lane's centre or the reference line.
    """

    road_id: str
    lane_id: str | int | None = None
    s: float = 0.0
    t: float = 0.0

    @property
    def lane(self) -> int | None:
        """Number of the lane; None if the point only names its road.

        Raises:
            PlacementError: It is not a number.
        """
        if self.lane_id is None or self.lane_id == "":
            return None
        try:
            return int(self.lane_id)
        except ValueError:
            raise PlacementError(f"`{self.lane_id}` is not a lane id of OpenDRIVE") from None


@dataclass(frozen=True, slots=True)
class XyzPoint(RoutableDot):
    """A point of the road network in world coordinates."""

    position: Point


class RouteAxis:
    """Base of the elements with coordinates for points: roads, lanes, crossings, paths."""

    __slots__ = ()


@dataclass(frozen=True, slots=True)
class RoadRoute(RouteAxis):
    """A road, or one of its lanes, as an axis.

    Attributes:
        road_id: Road.
        lane_id: Lane; None: the road, with its reference line as the axis.
    """

    road_id: str
    lane_id: int | None = None


@dataclass(frozen=True, slots=True)
class RoutePoint(RoutableDot):
    """A point in the coordinates of a route.

    Attributes:
        route: A lane (`s` runs along its centre line in direction of travel) or a road (`s`, `t` of
            its reference line), also one that a scenario declares, or a path; None in relative
            paths.
        s: Metres along it.
        t: Metres to the left of it.
    """

    route: RouteAxis | None = None
    s: float = 0.0
    t: float = 0.0


@dataclass(frozen=True, slots=True)
class GeodeticPoint(RoutableDot):
    """A point on the globe (WGS 84), on the road.

    Attributes:
        latitude: rad, to the north.
        longitude: rad, to the east.
        altitude: Metres above the nearest road.
    """

    latitude: float
    longitude: float
    altitude: float = 0.0


AnyPoint = Point | XyzPoint | RoutePoint | OdrPoint
"""A point to move to."""

NetworkPoint = RoutePoint | OdrPoint | XyzPoint | GeodeticPoint
"""A point of the road network."""
