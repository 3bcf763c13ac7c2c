"""Start positions from modifiers: on the map, relative to another actor, at a point."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING

from osc2tx_runtime import opendrive
from osc2tx_runtime.domain.map.road_graph import graph_of
from osc2tx_runtime.domain.modifiers import (
    Along,
    AlongTrajectory,
    Lane,
    Lateral,
    Location,
    Modifier,
    OnPath,
    Position,
    value_of,
)
from osc2tx_runtime.domain.modifiers.base import now, settled
from osc2tx_runtime.domain.paths.path_values import Path
from osc2tx_runtime.domain.placing.default_starts import StartPlaces, TakenBy
from osc2tx_runtime.domain.placing.initial_state import (
    InitialState,
    aside_speed_at,
    speed_at,
    tilt_at,
)
from osc2tx_runtime.domain.placing.point_placement import PointPlaces
from osc2tx_runtime.domain.placing.pose_resolution import heading_of, one_of_kind
from osc2tx_runtime.domain.points_and_poses import RoutePoint
from osc2tx_runtime.domain.routes.lane_coordinates import place_along_road, place_at_distance
from osc2tx_runtime.domain.routes.network_paths import trajectory_in_world
from osc2tx_runtime.domain.routes.place_on_route import on_route
from osc2tx_runtime.enums import SideLeftRight
from osc2tx_runtime.errors import PlacementError
from osc2tx_runtime.opendrive import LanePosition
from osc2tx_runtime.world.geometry.lane_neighbours import are_opposed, offset_from

if TYPE_CHECKING:
    from osc2tx_runtime.domain.actors import PhysicalObject
    from osc2tx_runtime.world.protocol import World
    from osc2tx_runtime.world.state import ActorState


class Placer:
    """Finds the position that modifiers describe, among the actors that are already placed."""

    def __init__(self, world: World) -> None:
        self._world = world
        self._map = world.map
        self._starts = StartPlaces(world.map)
        self._points = PointPlaces(world.map)
        self._draws: random.Random | None = None

    def initial_state(
        self,
        actor: PhysicalObject,
        modifiers: Sequence[Modifier],
        now: ActorState | None = None,
        *,
        spawn: LanePosition | None = None,
        taken_by: TakenBy = lambda _place: None,
        draws: random.Random | None = None,
    ) -> InitialState:
        """Resolves modifiers to a position and state.

        Args:
            actor: The actor to place.
            modifiers: position, lane, lateral, speed, yaw, orientation.
            now: Its present state, if any, for what the modifiers leave open.
            spawn: Position given by the settings.
            taken_by: Returns the actor that blocks a default position.
            draws: Chooses from ranges; None: their middle.

        Raises:
            PlacementError: The position does not exist.
        """
        self._draws = draws
        modifiers = settled(modifiers)
        speed = speed_at(self._world, modifiers, self._of)
        timed = one_of_kind(modifiers, AlongTrajectory)
        if speed is None and timed is not None:
            speed = self._begin(timed)[1]
        own_speed = speed if speed is not None else (0.0 if now is None else now.v)
        lateral = one_of_kind(modifiers, Lateral)
        if lateral is not None and lateral.side_of is None and lateral.is_fixed:
            taken_by = partial(self._taken_aside, actor, lateral, taken_by)
        at = self._place(actor, modifiers, own_speed, now, spawn, taken_by)
        if speed and not actor.movable:
            raise PlacementError(f"{actor.id} is stationary, so it has no speed")
        if lateral is not None:
            if not isinstance(at, LanePosition):
                raise PlacementError(f"{actor.id}: lateral needs a lane, not a point off the lanes")
            at = self._aside(actor, at, lateral)
        pose = self._map.pose(at) if isinstance(at, LanePosition) else at
        heading = heading_of(self._world, actor, modifiers, pose)
        along = heading is not None and math.cos(heading - pose.h) >= 1.0 - 1e-9
        if along and actor.lane_bound and isinstance(at, LanePosition):
            heading = None
        turned = pose if heading is None else pose._replace(h=heading)
        tilt = tilt_at(self._world, modifiers, turned)
        aside = aside_speed_at(self._world, modifiers, self._of)
        return InitialState(at, speed, heading, tilt, aside)

    # --- kinds of positions -------------------------------------------------------------------

    def _place(
        self,
        actor: PhysicalObject,
        modifiers: Sequence[Modifier],
        speed: float,
        now: ActorState | None,
        spawn: LanePosition | None,
        taken_by: TakenBy,
    ) -> LanePosition | opendrive.Pose:
        position, lane = self._position(actor, modifiers), one_of_kind(modifiers, Lane)
        if spawn is not None:
            return self._starts.given(actor.id, spawn, lane, position)
        if position is not None and position.absolute:
            if position.at_point is not None and position.project_on_route:
                return self._points.projected(actor, position.at_point, lane)
            at = self._points.at_point(actor, position)
            if lane is not None:
                self._points.check_lane(actor, at, lane)
            return at
        if position is not None and position.reference_point is not None:
            return self._points.near_point(actor, position, self._of(position.size()), lane)
        beside = None if lane is None else lane.reference
        reference = None if position is None else position.reference
        if beside is not None or reference is not None:
            return self._beside(actor, lane, position, speed)
        along = one_of_kind(modifiers, Along)
        if along is not None:
            return self._on_route(actor, along, lane, position, taken_by)
        timed = one_of_kind(modifiers, AlongTrajectory)
        if timed is not None:
            return self._points.at_pose(actor, self._begin(timed)[0])
        if now is not None and now.lane_position is not None:
            return self._from_here(actor, now.lane_position, lane, position)
        distance = None if position is None else self._of(position.size())
        on_path = one_of_kind(modifiers, OnPath)
        if on_path is not None:
            return self._starts.on_path(actor.id, on_path.path.found, lane, distance, taken_by)
        return self._starts.default(actor.id, lane, distance, taken_by)

    @staticmethod
    def _position(actor: PhysicalObject, modifiers: Sequence[Modifier]) -> Position | None:
        """The position; a location is one."""
        position, location = one_of_kind(modifiers, Position), one_of_kind(modifiers, Location)
        if location is None:
            return position
        if position is not None or actor.movable:
            raise PlacementError(
                f"{actor.id}: location is for stationary objects, instead of position"
            )
        pose = location.pose
        return Position(x=pose.x, y=pose.y, z=pose.z, h=pose.yaw or 0.0)

    def _taken_aside(
        self,
        actor: PhysicalObject,
        lateral: Lateral,
        taken_by: TakenBy,
        place: LanePosition,
    ) -> str | None:
        """The blocking actor at an offset from the lane centre."""
        return taken_by(self._aside(actor, place, lateral))

    def _aside(self, actor: PhysicalObject, at: LanePosition, lateral: Lateral) -> LanePosition:
        """The lateral position, in the lane or beside another actor."""
        own = actor.shape.width
        if lateral.side_of is None:
            width = self._map.lane_width(at.road, at.lane, at.s)
            return LanePosition(at.road, at.lane, at.s, self._of(lateral.offsets(own, width)))
        other = self._world.state(lateral.side_of.id)
        centre = LanePosition(at.road, at.lane, at.s)
        offset = offset_from(self._map, centre, other.x, other.y)
        there = other.lane_position
        oncoming = there is not None and are_opposed(self._map, centre, there)
        aside = self._of(lateral.offsets(own, other.width, oncoming=oncoming))
        return LanePosition(at.road, at.lane, at.s, offset + aside)

    def _beside(
        self, actor: PhysicalObject, lane: Lane | None, position: Position | None, speed: float
    ) -> LanePosition:
        reference = None if position is None else position.reference
        in_lane_of = None if lane is None else lane.reference
        start = self._centre(in_lane_of or reference, actor)
        if lane is not None and lane.side_of is not None and lane.side is not None:
            side: SideLeftRight = now(lane.side)
            beside = self._map.neighbour(start, side, lane.number) if lane.number else start
            if beside is None:
                raise PlacementError(
                    f"{actor.id}: there is no lane to the {side} of {lane.side_of.id},"
                    f" which is in lane {start.lane} of road {start.road}"
                )
            start = beside
        if position is not None and reference is not None:
            start = self._at_distance(actor, start, position, speed)
        elif position is not None:
            start = self._along_road(actor, start, self._of(position.size()))
        if lane is not None and in_lane_of is None:
            return self._points.numbered(actor, start, lane)
        return start

    def _at_distance(
        self, actor: PhysicalObject, start: LanePosition, position: Position, speed: float
    ) -> LanePosition:
        """Moves along the lane of `start` until the distance to the reference is right."""
        reference = position.reference
        assert reference is not None
        origin = self._centre(reference, actor)
        wanted = self._of(position.size())
        if position.timed:
            wanted *= self._world.state(reference.id).v if position.ahead else speed
        wanted = wanted if position.ahead else -wanted
        place = place_at_distance(self._map, start, origin, wanted)
        if place is not None:
            return place
        side = "ahead of" if wanted >= 0.0 else "behind"
        raise PlacementError(
            f"{actor.id}: the lane does not reach {abs(wanted):.1f} m {side} {reference.id}"
        )

    def _on_route(
        self,
        actor: PhysicalObject,
        along: Along,
        lane: Lane | None,
        position: Position | None,
        taken_by: TakenBy,
    ) -> LanePosition | opendrive.Pose:
        """The start of a route of the map, or a distance from there; in any lane by default."""
        route = along.way
        distance = value_of(along.start_offset)
        distance += 0.0 if position is None else self._of(position.size())
        if isinstance(route, Path) or route.found.kind == "crossing":
            return self._points.on_way(actor, RoutePoint(route, distance))
        graph = graph_of(self._map)
        for place in graph.beginnings(route.found):
            step = on_route(graph, route.found, place, distance)
            if abs(step.travelled - distance) > 1e-6:
                raise PlacementError(
                    f"{actor.id}: {route.found} ends after {step.travelled:.1f} m, before"
                    f" {distance:g} m"
                )
            if lane is not None:
                return self._points.numbered(actor, step.position, lane)
            if taken_by(step.position) is None:
                return step.position
        raise PlacementError(f"{actor.id}: {route.found} has no free lane {distance:g} m along it")

    def _begin(self, timed: AlongTrajectory) -> tuple[opendrive.Pose, float]:
        """Pose at the start of a trajectory, and the speed (m/s) there.

        Zero before its first time.
        """
        trajectory = trajectory_in_world(self._map, now(timed.trajectory))
        curve = trajectory.curve
        begin = curve.at_length(value_of(timed.start_offset))
        (x, y, z), way = curve.point(begin), curve.heading(begin) or 0.0
        heading = curve.yaw(begin)
        pace = math.hypot(*curve.rate(begin)[:2]) if trajectory.time_stamps[0] <= 0.0 else 0.0
        return opendrive.Pose(x, y, z, way if heading is None else heading), pace

    def _from_here(
        self,
        actor: PhysicalObject,
        here: LanePosition,
        lane: Lane | None,
        position: Position | None,
    ) -> LanePosition:
        place = LanePosition(here.road, here.lane, here.s)
        if position is not None:
            place = self._along_road(actor, place, self._of(position.size()))
        return place if lane is None else self._points.numbered(actor, place, lane)

    # --- parts --------------------------------------------------------------------------------

    def _along_road(
        self, actor: PhysicalObject, place: LanePosition, distance: float
    ) -> LanePosition:
        found = place_along_road(self._map, place, distance)
        if found is None:
            raise PlacementError(
                f"{actor.id}: lane {place.lane} of road {place.road} does not lead to the position"
                f" {distance:g} m along the road, which is {self._map.roads[place.road].length:.1f}"
                " m long"
            )
        return found

    def _centre(self, of: PhysicalObject | None, actor: PhysicalObject) -> LanePosition:
        """Position of a placed actor on the centre of its driving lane."""
        assert of is not None
        state = self._world.state(of.id)
        on = self._map.locate(state.x, state.y, state.z, hint=state.lane_position)
        if on is None:
            raise PlacementError(f"{actor.id}: {of.id} is not on a road, so it has no lane")
        return LanePosition(on.road, on.lane, on.s)

    def _of(self, bounds: tuple[float, float]) -> float:
        """A value between bounds."""
        low, high = bounds
        if low == high:
            return low
        return 0.5 * (low + high) if self._draws is None else self._draws.uniform(low, high)
