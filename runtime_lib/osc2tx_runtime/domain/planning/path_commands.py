"""Commands for following and replaying paths and trajectories."""

from __future__ import annotations

import math

from osc2tx_runtime.domain.paths.path_curves import PathError, interval_between_offsets
from osc2tx_runtime.domain.paths.path_values import Path, Trajectory
from osc2tx_runtime.domain.points_and_poses import Pose
from osc2tx_runtime.domain.routes.network_paths import path_in_world, trajectory_in_world
from osc2tx_runtime.language.actions.registry import LATERAL, LONGITUDINAL
from osc2tx_runtime.opendrive import RoadMap
from osc2tx_runtime.world.commands import (
    Command,
    FollowCourse,
    KeepSchedule,
    ReplayCourse,
    ReplayTrajectory,
)
from osc2tx_runtime.world.geometry.curve import Curve, Vector, turn_between
from osc2tx_runtime.world.state import ActorState

_FAR = 100.0  # greatest distance (m) to a path
_SLIP = 0.2  # greatest angle (rad) between heading and path of a follower


def path_command(
    road_map: RoadMap, here: ActorState, path: Path, offsets: tuple[float, float], *, exact: bool
) -> Command:
    """The lateral command for a path.

    Raises:
        PathError: The path is empty, too far away, or infeasible.
    """
    curve = path_in_world(road_map, path).curve
    begin, end = interval_between_offsets(curve, *offsets)
    if exact:
        return ReplayCourse(curve, begin, end)
    _check_yaw(curve, curve.knots)
    _check_way_to(here, curve, begin)
    return FollowCourse(curve, begin, end)


def trajectory_commands(
    road_map: RoadMap,
    here: ActorState,
    trajectory: Trajectory,
    offsets: tuple[float, float],
    *,
    exact: bool,
) -> dict[str, Command]:
    """The commands for a trajectory. Before its first time the actor goes to its first point.

    Raises:
        PathError: The trajectory is empty, too far away, or infeasible.
    """
    trajectory = trajectory_in_world(road_map, trajectory)
    _ = trajectory.curve  # checks it
    lead = 0.0
    if trajectory.time_stamps[0] > 1e-9:
        first = trajectory.points[0]
        lead = math.hypot(first.x - here.x, first.y - here.y)
        yaw = here.h if first.yaw is not None else None
        points = (Pose(here.x, here.y, here.z, yaw=yaw), *trajectory.points)
        times = (0.0, *trajectory.time_stamps)
        trajectory = Trajectory(points, times, trajectory.interpolation)
    curve = trajectory.curve
    low, high = 0.0, curve.length
    begin, end = curve.begin, curve.end
    if any(offsets):
        start_offset, end_offset = offsets
        low, high = interval_between_offsets(
            curve, lead + start_offset if start_offset else 0.0, end_offset
        )
        begin, end = curve.at_length(low), curve.at_length(high) if end_offset else curve.end
    if exact:
        replay = ReplayTrajectory(curve, begin, end)
        return {LONGITUDINAL: replay, LATERAL: replay}
    _check_yaw(curve, curve.knots)
    _check_way_to(here, curve, low)
    return {LONGITUDINAL: KeepSchedule(curve, begin, end), LATERAL: FollowCourse(curve, low, high)}


def begin_of(command: Command) -> Vector | None:
    """The point at which a replay begins; None for other commands."""
    match command:
        case ReplayCourse(curve=curve, begin=begin):
            return curve.point(curve.at_length(begin))
        case ReplayTrajectory(curve=curve, begin=begin):
            return curve.point(begin)
    return None


def _check_yaw(curve: Curve, places: tuple[float, ...]) -> None:
    """Check that the headings of a path are those of a follower."""
    for at in places:
        wanted, way = curve.yaw(at), curve.heading(at)
        if wanted is None or way is None:
            continue
        slip = abs(turn_between(way, wanted))
        if slip > _SLIP:
            raise PathError(
                f"a point requires a heading {math.degrees(slip):.0f} degrees off the path, which"
                " only replay can do"
            )


def _check_way_to(here: ActorState, curve: Curve, begin: float) -> None:
    along = curve.nearest(here.x, here.y, begin, 5.0)
    away = curve.distance_to(here.x, here.y, along)
    if away > _FAR:
        raise PathError(f"the path is {away:.0f} m away, too far to get there")
