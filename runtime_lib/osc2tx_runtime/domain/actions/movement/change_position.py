"""The action `change_position`: a generated path to a position (DSL 8.8.2.11)."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, ClassVar, Unpack, cast

from osc2tx_runtime import opendrive
from osc2tx_runtime.domain.modifiers import Modifier
from osc2tx_runtime.domain.modifiers.base import now
from osc2tx_runtime.domain.modifiers.groups import SPEED_FREE
from osc2tx_runtime.domain.paths.path_curves import PathError
from osc2tx_runtime.domain.paths.path_values import Path
from osc2tx_runtime.domain.planning.path_commands import path_command
from osc2tx_runtime.domain.points_and_poses import (
    AnyPoint,
    OdrPoint,
    Point,
    Pose,
    RoutePoint,
    XyzPoint,
)
from osc2tx_runtime.domain.routes.lane_coordinates import place_of_odr, place_of_route
from osc2tx_runtime.domain.routes.road_paths import way_through
from osc2tx_runtime.enums import PathInterpolation
from osc2tx_runtime.language.actions.action import ActionOptions
from osc2tx_runtime.language.actions.registry import LATERAL, action
from osc2tx_runtime.opendrive import DRIVING, LanePosition
from osc2tx_runtime.world.commands import Command
from osc2tx_shared.rules import at_least_one, at_most_one

from .path_following import CourseAction

if TYPE_CHECKING:
    from osc2tx_runtime.domain.actors import MovableObject

TARGETS = ("target_position", "target_xyz", "target_st", "target_odr")


@action("movable_object", "change_position", slots=(LATERAL,))
class ChangePosition(CourseAction):
    """Move to a position; the speed is free; from standstill it becomes `CRUISE`.

    Args:
        actor: The actor.
        *modifiers: Modifiers of the speed.
        target_position: Any kind of point.
        target_xyz: Point in the world.
        target_st: Point in route coordinates.
        target_odr: Point in road coordinates.
        interpolation: `smooth` starts in the present heading; only off the road network.
        on_road_network: Whether to move along lanes; default: vehicles on a lane do.
        **options: Duration and label.
    """

    rules = (at_most_one(*TARGETS), at_least_one(*TARGETS))
    accepts: ClassVar[tuple[type, ...]] = SPEED_FREE

    def __init__(
        self,
        actor: MovableObject,
        *modifiers: Modifier,
        target_position: AnyPoint | Callable[[], AnyPoint] | None = None,
        target_xyz: Point | Callable[[], Point] | None = None,
        target_st: RoutePoint | Callable[[], RoutePoint] | None = None,
        target_odr: OdrPoint | Callable[[], OdrPoint] | None = None,
        interpolation: PathInterpolation = "straight_line",
        on_road_network: bool | None = None,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        target = target_position or target_xyz or target_st or target_odr
        assert target is not None  # see the rules
        self.target: AnyPoint | Callable[[], AnyPoint] = target
        self.interpolation: PathInterpolation = interpolation
        self.on_road_network = actor.lane_bound if on_road_network is None else on_road_network

    def commands(self) -> dict[str, Command]:
        """The path to the target."""
        target = cast(AnyPoint, now(self.target))
        place = self.place(target)
        path = self._along_lanes(place) if self.on_road_network else self._across(place)
        return {
            LATERAL: path_command(self.world.map, self.here, path, (0.0, 0.0), exact=self.may_jump)
        }

    def place(self, target: AnyPoint) -> LanePosition | opendrive.Pose:
        """The lane position of a point."""
        match target:
            case RoutePoint():
                return place_of_route(self.world.map, target)
            case OdrPoint():
                return place_of_odr(self.world.map, target)
            case XyzPoint():
                target = target.position
        return opendrive.Pose(target.x, target.y, target.z, 0.0)

    def _along_lanes(self, place: LanePosition | opendrive.Pose) -> Path:
        road_map, here = self.world.map, self.here.lane_position
        if not isinstance(place, LanePosition):
            on = road_map.locate(place.x, place.y, place.z, max_distance=1e-3)
            if on is None:
                raise PathError(f"there is no driving lane at ({place.x:g}, {place.y:g})")
            place = on
        if here is None or road_map.lane_type(here.road, here.lane, here.s) not in DRIVING:
            raise PathError(f"{self.actor.id} is on no driving lane to start from")
        return Path(way_through(road_map, (here, place)), "smooth")

    def _across(self, place: LanePosition | opendrive.Pose) -> Path:
        pose = self.world.map.pose(place) if isinstance(place, LanePosition) else place
        here = self.here
        away = math.hypot(pose.x - here.x, pose.y - here.y)
        start, goal = Pose(here.x, here.y, here.z), Pose(pose.x, pose.y, pose.z)
        if self.interpolation == "straight_line" or away < 1e-6:
            return Path((start, goal))
        lead = 0.25 * away  # a point straight ahead sets the initial direction
        ahead = Pose(here.x + lead * math.cos(here.h), here.y + lead * math.sin(here.h), here.z)
        return Path((start, ahead, goal), "smooth")
