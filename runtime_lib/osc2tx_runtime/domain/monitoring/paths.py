"""Monitors of paths, routes and trajectories (DSL 8.9.11, 8.9.12)."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

from osc2tx_runtime.domain.modifiers import Along, AlongTrajectory, Modifier, Position, value_of
from osc2tx_runtime.domain.modifiers.base import now
from osc2tx_runtime.domain.monitoring.conditions import Condition, Reading
from osc2tx_runtime.domain.monitoring.registry import monitors, stands_for
from osc2tx_runtime.domain.paths.path_curves import interval_between_offsets
from osc2tx_runtime.domain.paths.path_values import Path
from osc2tx_runtime.domain.routes.network_paths import path_in_world, trajectory_in_world
from osc2tx_runtime.domain.routes.place_on_route import driven_on_route
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.opendrive import LanePosition

if TYPE_CHECKING:
    from osc2tx_runtime.domain.actions.movement.change_position import ChangePosition
    from osc2tx_runtime.domain.actions.movement.path_following import _OnPath, _OnTrajectory
    from osc2tx_runtime.domain.map.roads_and_lanes import Route
    from osc2tx_runtime.domain.monitoring.phase import Phase
    from osc2tx_runtime.world.geometry.curve import Curve

_OFF_ROUTE = "it is not on the route"
_NEAR = 0.05  # m from a path that count as on it
_REACH = 5.0  # m around its last position on a curve, the range of the search


@monitors("along")
def along(modifier: Along, phase: Phase) -> Iterator[Condition]:
    """The position on a path or route."""
    route = modifier.way
    if not isinstance(route, Path):
        yield from _on_route(modifier, route, phase)
        return
    offsets = value_of(modifier.start_offset), value_of(modifier.end_offset)
    measure = _on_path(route, offsets, phase)
    yield Condition("along", "its distance from the path", "position", modifier.at, measure)


def _on_route(modifier: Along, route: Route, phase: Phase) -> Iterator[Condition]:
    """The position on the route, up to its end, and the stated position at the start or end."""
    road_map, me = phase.world.map, phase.me
    left = math.inf  # m up to the end of the route, at the state before

    def place() -> tuple[float, float] | None:
        try:
            return driven_on_route(road_map, route, me())
        except ScenarioError:
            return None

    def is_on() -> Reading:
        nonlocal left
        found, before = place(), left
        left = math.inf if found is None else found[1] - found[0]
        ends = before <= abs(me().v) * phase.dt  # within the last step
        return 0.0 if found is not None or ends else 1.0, 0.0, 0.0

    yield Condition("along", "its route", "lane", modifier.at, is_on, lambda _: _OFF_ROUTE)
    placed = any(isinstance(m, Position) and m.at == modifier.at for m in phase.modifiers)
    if modifier.at == "start" and placed:
        return

    def at_offset() -> Reading | None:
        found = place()
        if found is None or route.kind == "lane_section":  # planned along the lane, not the axis
            return None
        here, length = found
        if modifier.at == "start":
            offset = value_of(modifier.start_offset)
            return here, offset, offset
        end = length - value_of(modifier.end_offset)
        return here, (end if modifier.at == "end" else 0.0), end

    what = "its distance along the route"
    yield Condition("along", what, "position", modifier.at, at_offset)


def _on_path(path: Path, offsets: tuple[float, float], phase: Phase) -> Callable[[], Reading]:
    """Distance from a path that it follows from start to end."""
    curve = path_in_world(phase.world.map, path).curve
    low, high = map(curve.at_length, interval_between_offsets(curve, *offsets))
    me, at = phase.me, low

    def measure() -> Reading:
        nonlocal at
        here = me()
        before, at = at, min(max(_foot(curve, at, here.x, here.y), low), high)
        x, y, _ = curve.point(at)
        away = math.hypot(here.x - x, here.y - y)
        if away > _NEAR:  # or at a corner, where the tangent is misleading
            along = curve.nearest(here.x, here.y, curve.length_at(before), _REACH)
            at = min(max(curve.at_length(along), low), high)
            x, y, _ = curve.point(at)
            away = math.hypot(here.x - x, here.y - y)
        return away, 0.0, 0.0

    return measure


def _foot(curve: Curve, at: float, x: float, y: float) -> float:
    """The parameter of the nearest point of a curve, searched from a close one."""
    for _ in range(2):
        px, py, _ = curve.point(at)
        dx, dy, _ = curve.rate(at)
        square = dx * dx + dy * dy
        if square < 1e-9:
            break
        at += ((x - px) * dx + (y - py) * dy) / square
    return at


@monitors("along_trajectory")
def along_trajectory(modifier: AlongTrajectory, phase: Phase) -> Iterator[Condition]:
    """The position at each time of a trajectory, from its first time."""
    trajectory = trajectory_in_world(phase.world.map, now(modifier.trajectory))
    curve, first = trajectory.curve, trajectory.time_stamps[0]
    offsets = value_of(modifier.start_offset), value_of(modifier.end_offset)
    low, high = interval_between_offsets(curve, *offsets)
    begin = curve.at_length(low) if offsets[0] else 0.0
    end = curve.at_length(high) if offsets[1] else curve.end
    me = phase.me

    def measure() -> Reading | None:
        time = begin + phase.elapsed
        if not first <= time <= end:
            return None
        x, y, _ = curve.point(time)
        here = me()
        return math.hypot(here.x - x, here.y - y), 0.0, 0.0

    what = "its distance from the trajectory"
    yield Condition("along_trajectory", what, "position", modifier.at, measure)


@stands_for("follow_path", "replay_path")
def on_path(action: _OnPath, phase: Phase) -> Iterator[Modifier]:
    """The path, from one offset to the other."""
    yield Along(action.course(), *action.offsets)


@stands_for("follow_trajectory", "replay_trajectory")
def on_trajectory(action: _OnTrajectory, phase: Phase) -> Iterator[Modifier]:
    """The trajectory, from one offset to the other."""
    yield AlongTrajectory(action.course(), *action.offsets)


@stands_for("change_position")
def change_position(action: ChangePosition, phase: Phase) -> Iterator[Condition]:
    """The target, at the end."""
    target: Any = now(action.target)
    place = action.place(target)
    at = phase.world.map.pose(place) if isinstance(place, LanePosition) else place
    me = phase.me

    def measure() -> Reading:
        here = me()
        return math.hypot(here.x - at.x, here.y - at.y), 0.0, 0.0

    what = "its distance from the target"
    yield Condition("change_position", what, "position", "end", measure)
