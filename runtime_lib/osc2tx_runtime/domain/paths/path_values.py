"""Value classes of paths and trajectories (DSL 8.12), SI units."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import field
from typing import ClassVar, Literal, Protocol

from osc2tx_runtime.domain.paths.path_curves import path_curve, trajectory_curve
from osc2tx_runtime.domain.points_and_poses import (
    NetworkPoint,
    OdrPoint,
    Pose,
    RouteAxis,
    RoutePoint,
)
from osc2tx_runtime.enums import PathInterpolation
from osc2tx_runtime.world.geometry.curve import Curve
from osc2tx_shared.classes import dataclass

PathPoint = Pose | RoutePoint | OdrPoint


@dataclass(frozen=True, slots=True)
class Path(RouteAxis):
    """A path through poses in the world.

    Attributes:
        points: Poses; an open yaw follows the path.
        interpolation: Interpolation between the points.
    """

    kind: ClassVar[str] = "path"
    points: Sequence[Pose]
    interpolation: PathInterpolation = "straight_line"
    _curve: list[Curve] = field(default_factory=list, init=False, repr=False, compare=False)

    def in_world(self) -> Path:
        """The path through poses."""
        return self

    @property
    def curve(self) -> Curve:
        """Its curve; computed once.

        Raises:
            PathError: It has no two different points.
        """
        if not self._curve:
            path = self.in_world()
            self._curve.append(path_curve(path.points, path.interpolation))
        return self._curve[0]

    @property
    def length(self) -> float:
        """Its length (m)."""
        return self.curve.length

    @property
    def directionality(self) -> Literal["uni_direction"]:
        """It is followed from its first point to its last."""
        return "uni_direction"

    @property
    def min_lanes(self) -> int:
        """It has no lanes."""
        return 0

    @property
    def max_lanes(self) -> int:
        """It has no lanes."""
        return 0

    @property
    def anchors(self) -> list[str]:
        """It is not part of the map file."""
        return []

    def start_point(self) -> RoutePoint:
        """Its start (DSL 8.12.5.1.1)."""
        return RoutePoint(self, 0.0, 0.0)

    def end_point(self) -> RoutePoint:
        """Its end (DSL 8.12.5.1.2)."""
        return RoutePoint(self, self.length, 0.0)


class PathResolver(Protocol):
    """The methods of a map that paths require."""

    def in_world(self, path: Path) -> Path:
        """A path through poses of the map."""
        ...


@dataclass(frozen=True, slots=True)
class NetworkPath(Path):
    """A path through points of the road network; poses come from the map when it is used.

    Attributes:
        places: The points.
        on_road_network: Whether it follows lanes from point to point.
        network: The map.
    """

    places: Sequence[NetworkPoint] = ()
    on_road_network: bool = False
    network: PathResolver | None = field(default=None, repr=False, compare=False)

    def in_world(self) -> Path:
        """The path through poses.

        Raises:
            PathError: A point is not on the map, or no route along lanes leads to it.
        """
        assert self.network is not None
        return self.network.in_world(self)


@dataclass(frozen=True, slots=True)
class RelativePath:
    """A path relative to an object; see `relative_paths` for the frames."""

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
    """A path through poses in the world at given times.

    Attributes:
        points: As of `Path`.
        time_stamps: Seconds since the start of the action, one per point, ascending.
        interpolation: Interpolation between the points.
    """

    points: Sequence[Pose]
    time_stamps: Sequence[float]
    interpolation: PathInterpolation = "straight_line"

    @property
    def curve(self) -> Curve:
        """The curve through its points; its parameter is the time (s).

        Raises:
            PathError: Numbers of points and times differ, or times do not increase.
        """
        return trajectory_curve(self.points, self.time_stamps, self.interpolation)


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
