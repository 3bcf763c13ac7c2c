"""Plain values of the domain model that scenarios pass around, SI units."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from osc2tx_runtime.errors import PlacementError

if TYPE_CHECKING:
    from osc2tx_runtime.road_parts import RoadPart

__all__ = [
    "NetworkPath",
    "NetworkPoint",
    "NetworkTrajectory",
    "OdrPoint",
    "Orientation",
    "Path",
    "PathInterpolation",
    "PathPoint",
    "Point",
    "Pose",
    "RelativePath",
    "RelativePathOdr",
    "RelativePathPose3d",
    "RelativePathSt",
    "RelativeTrajectory",
    "RelativeTrajectoryOdr",
    "RelativeTrajectoryPose3d",
    "RelativeTrajectorySt",
    "RelativeTransform",
    "RoadRoute",
    "RoutePoint",
    "Trajectory",
    "XyzPoint",
]


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
    """A point (m) with an orientation (rad); in paths a yaw of None is that of the way."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    roll: float = 0.0
    pitch: float = 0.0
    yaw: float | None = None

    @property
    def position(self) -> Point:
        """Where it is."""
        return Point(self.x, self.y, self.z)

    @property
    def orientation(self) -> Orientation:
        """How it is turned."""
        return Orientation(self.roll, self.pitch, self.yaw or 0.0)


@dataclass(frozen=True, slots=True)
class OdrPoint:
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
            PlacementError: It is no number.
        """
        if self.lane_id is None or self.lane_id == "":
            return None
        try:
            return int(self.lane_id)
        except ValueError:
            raise PlacementError(f"`{self.lane_id}` is no lane of OpenDRIVE") from None


@dataclass(frozen=True, slots=True)
class XyzPoint:
    """A point of the road network in world coordinates."""

    position: Point


@dataclass(frozen=True, slots=True)
class RoadRoute:
    """A road, or one of its lanes, as something to measure along.

    Attributes:
        road_id: Road.
        lane_id: Lane; None: the road, with its reference line as the axis.
    """

    road_id: str
    lane_id: int | None = None


@dataclass(frozen=True, slots=True)
class RoutePoint:
    """A point in the coordinates of a route.

    Attributes:
        route: A lane (`s` runs along its centre line in direction of travel) or a road (`s`, `t` of
            its reference line), also one that a scenario declares; None in relative paths.
        s: Metres along it.
        t: Metres to the left of it.
    """

    route: RoadRoute | RoadPart | None = None
    s: float = 0.0
    t: float = 0.0


NetworkPoint = RoutePoint | OdrPoint | XyzPoint
PathPoint = Pose | RoutePoint | OdrPoint
PathInterpolation = Literal["straight_line", "smooth"]
RelativeTransform = Literal["world_relative", "object_relative", "road_relative", "lane_relative"]


@dataclass(frozen=True, slots=True)
class Path:
    """A way through poses in the world.

    Attributes:
        points: Poses; a yaw that is left open is that of the way.
        interpolation: How they are joined.
    """

    points: Sequence[Pose]
    interpolation: PathInterpolation = "straight_line"


@dataclass(frozen=True, slots=True)
class NetworkPath(Path):
    """A path through points of the road network; poses come from the map when it is used.

    Attributes:
        places: The points.
        on_road_network: Along lanes from point to point.
    """

    places: Sequence[NetworkPoint] = ()
    on_road_network: bool = False


@dataclass(frozen=True, slots=True)
class RelativePath:
    """A way relative to an object; see `relative_to` in `paths` for the frames."""

    points: Sequence[PathPoint]
    interpolation: PathInterpolation = "straight_line"


@dataclass(frozen=True, slots=True)
class RelativePathPose3d(RelativePath):
    """Points in Cartesian coordinates."""


@dataclass(frozen=True, slots=True)
class RelativePathSt(RelativePath):
    """Points in s and t."""


@dataclass(frozen=True, slots=True)
class RelativePathOdr(RelativePath):
    """Points in road coordinates."""


@dataclass(frozen=True, slots=True)
class Trajectory:
    """A way through poses in the world at given times.

    Attributes:
        points: As of `Path`.
        time_stamps: Seconds since the start of the action, one per point, ascending.
        interpolation: How they are joined.
    """

    points: Sequence[Pose]
    time_stamps: Sequence[float]
    interpolation: PathInterpolation = "straight_line"


@dataclass(frozen=True, slots=True)
class NetworkTrajectory(Trajectory):
    """A trajectory through points of the road network; likewise."""

    places: Sequence[NetworkPoint] = ()
    on_road_network: bool = False


@dataclass(frozen=True, slots=True)
class RelativeTrajectory:
    """A trajectory relative to an object."""

    points: Sequence[PathPoint]
    time_stamps: Sequence[float]
    interpolation: PathInterpolation = "straight_line"


@dataclass(frozen=True, slots=True)
class RelativeTrajectoryPose3d(RelativeTrajectory):
    """Points in Cartesian coordinates."""


@dataclass(frozen=True, slots=True)
class RelativeTrajectorySt(RelativeTrajectory):
    """Points in s and t."""


@dataclass(frozen=True, slots=True)
class RelativeTrajectoryOdr(RelativeTrajectory):
    """Points in road coordinates."""
