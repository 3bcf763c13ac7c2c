"""Actions of the actor type `movable_object`; made by tools/make_actor_methods.py."""

# The registry executes these declarations.
# mypy: disable-error-code="empty-body"

from __future__ import annotations

from typing import TYPE_CHECKING

from osc2tx_runtime.language.actions.registry import carried_out

if TYPE_CHECKING:
    from collections.abc import Callable

    from osc2tx_runtime.domain.modifiers import Value
    from osc2tx_runtime.domain.modifiers.groups import (
        PathModifier,
        SideModifier,
        SpeedModifier,
        StartModifier,
        TurnModifier,
    )
    from osc2tx_runtime.domain.modifiers.movement.conduct import PhysicalMovement
    from osc2tx_runtime.domain.modifiers.movement.lane import Lane
    from osc2tx_runtime.domain.modifiers.movement.position import Distance, KeepPosition, Position
    from osc2tx_runtime.domain.modifiers.movement.speed import Speed
    from osc2tx_runtime.domain.objects.physical_objects import PhysicalObject
    from osc2tx_runtime.domain.paths.path_values import (
        Path,
        RelativePath,
        RelativeTrajectory,
        Trajectory,
    )
    from osc2tx_runtime.domain.points_and_poses import (
        AnyPoint,
        OdrPoint,
        Orientation,
        Point,
        RoutePoint,
    )
    from osc2tx_runtime.enums import DynamicProfile, PathInterpolation, RelativeTransform
    from osc2tx_runtime.language.tree.base import Behaviour
    from osc2tx_runtime.language.tree.duration_limits import Duration


@carried_out
class MovableObjectMethods:
    """Actions of the actor type `movable_object`."""

    def assign_acceleration(
        self, label: str | None = None, /, *, acceleration: Value, duration: Duration | None = None
    ) -> Behaviour:
        """Have an acceleration (m/s^2) at once, whatever the limits (§8.8.2.7)."""

    def assign_orientation(
        self,
        label: str | None = None,
        /,
        *,
        orientation: Orientation | Callable[[], Orientation],
        duration: Duration | None = None,
    ) -> Behaviour:
        """Have a heading, pitch and roll at once (§8.8.2.5).

        A vehicle returns to its lane from there, and to its wheels as soon as they roll; other
        actors keep the assigned pose. A pitch or roll of zero leaves it to the road.
        """

    def assign_position(
        self,
        label: str | TurnModifier | Lane | Position | Speed | None = None,
        /,
        *modifiers: TurnModifier | Lane | Position | Speed,
        position: Point | Callable[[], Point] | None = None,
        route_point: RoutePoint | Callable[[], RoutePoint] | None = None,
        odr_point: OdrPoint | Callable[[], OdrPoint] | None = None,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Be somewhere else at once; the speed stays (§8.8.2.4).

        Args:
            *modifiers: position, lane, speed, yaw, orientation: instead of a point.
            position: Point in the world.
            route_point: Point in route coordinates.
            odr_point: Point in road coordinates.
        """

    def assign_speed(
        self, label: str | None = None, /, *, speed: Value, duration: Duration | None = None
    ) -> Behaviour:
        """Have a speed (m/s) at once, whatever the limits (§8.8.2.6)."""

    def change_acceleration(
        self,
        label: str | SideModifier | StartModifier | None = None,
        /,
        *modifiers: SideModifier | StartModifier,
        target: Value,
        rate_profile: DynamicProfile = "none",
        rate_peak: Value | None = None,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Reach an acceleration; fails if the actor comes to a stand before (§8.8.2.14).

        Args:
            *modifiers: Modifiers of the lane.
            target: Acceleration (m/s^2), within the limits of the actor.
            rate_profile: Course of the jerk; `constant`, `none` and `asap` keep it constant.
            rate_peak: Its peak (m/s^3); default: the duration, else the limits of the actor.
        """

    def change_position(
        self,
        label: str | SpeedModifier | StartModifier | None = None,
        /,
        *modifiers: SpeedModifier | StartModifier,
        target_position: AnyPoint | Callable[[], AnyPoint] | None = None,
        target_xyz: Point | Callable[[], Point] | None = None,
        target_st: RoutePoint | Callable[[], RoutePoint] | None = None,
        target_odr: OdrPoint | Callable[[], OdrPoint] | None = None,
        interpolation: PathInterpolation = "straight_line",
        on_road_network: bool | None = None,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Move to a position; the speed is free, from standstill it becomes `CRUISE`.

        Section §8.8.2.11.

        Args:
            *modifiers: Modifiers of the speed.
            target_position: Any kind of point.
            target_xyz: Point in the world.
            target_st: Point in route coordinates.
            target_odr: Point in road coordinates.
            interpolation: `smooth` starts in the present direction; off the road network only.
            on_road_network: Along lanes; default: for vehicles on a lane.
        """

    def change_speed(
        self,
        label: str | SideModifier | StartModifier | None = None,
        /,
        *modifiers: SideModifier | StartModifier,
        target: Value,
        rate_profile: DynamicProfile = "none",
        rate_peak: Value | None = None,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Reach a speed (§8.8.2.12).

        Args:
            *modifiers: Modifiers of the lane.
            target: Speed (m/s).
            rate_profile: Course of the acceleration.
            rate_peak: Its peak (m/s^2); default: the duration, else the limits of the actor.
        """

    def follow_path(
        self,
        label: str | SpeedModifier | StartModifier | None = None,
        /,
        *modifiers: SpeedModifier | StartModifier,
        absolute: Path | Callable[[], Path] | None = None,
        relative: RelativePath | Callable[[], RelativePath] | None = None,
        reference: PhysicalObject | None = None,
        transform: RelativeTransform = "object_relative",
        start_offset: Value = 0.0,
        end_offset: Value = 0.0,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Follow a path as the limits of the actor allow (§8.8.2.16).

        Args:
            *modifiers: Modifiers of the speed.
            absolute: The path.
            relative: Or a path relative to the pose of a reference at the start.
            reference: Default: the actor itself.
            transform: Frame of the relative points.
            start_offset: Metres of the path that are left out at its start.
            end_offset: Metres that are left out at its end.
        """

    def follow_trajectory(
        self,
        label: str | StartModifier | PhysicalMovement | None = None,
        /,
        *modifiers: StartModifier | PhysicalMovement,
        absolute: Trajectory | Callable[[], Trajectory] | None = None,
        relative: RelativeTrajectory | Callable[[], RelativeTrajectory] | None = None,
        reference: PhysicalObject | None = None,
        transform: RelativeTransform = "object_relative",
        start_offset: Value = 0.0,
        end_offset: Value = 0.0,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Follow a trajectory as the limits of the actor allow; late arrival is no failure.

        Section §8.8.2.17.

        Args:
            *modifiers: Only `physical_movement`.
            absolute: The trajectory; its times count from the start of the action.
            relative: Or one relative to a reference, where that is at the start.
            reference: Default: the actor itself.
            transform: Frame of the relative points.
            start_offset: Metres left out at the start: the action begins at their end, at once.
            end_offset: Metres that are left out at its end.
        """

    def keep_acceleration(
        self,
        label: str | SideModifier | StartModifier | None = None,
        /,
        *modifiers: SideModifier | StartModifier,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Hold the present acceleration; an actor that comes to a stand stays there (§8.8.2.15)."""

    def keep_speed(
        self,
        label: str | SideModifier | StartModifier | None = None,
        /,
        *modifiers: SideModifier | StartModifier,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Hold the present speed (§8.8.2.13)."""

    def move(
        self,
        label: (
            str | SpeedModifier | SideModifier | PathModifier | Distance | KeepPosition | None
        ) = None,
        /,
        *modifiers: SpeedModifier | SideModifier | PathModifier | Distance | KeepPosition,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Move as the modifiers say (§8.8.2.3)."""

    def remain_stationary(
        self,
        label: str | TurnModifier | StartModifier | PhysicalMovement | None = None,
        /,
        *modifiers: TurnModifier | StartModifier | PhysicalMovement,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Stand still; a moving actor first brakes as hard as it can, unless physics must hold.

        Section §8.8.2.10.

        Where a modifier states the position at standstill, the actor has to be there at the start.
        """

    def replay_path(
        self,
        label: str | SpeedModifier | StartModifier | None = None,
        /,
        *modifiers: SpeedModifier | StartModifier,
        absolute: Path | Callable[[], Path] | None = None,
        relative: RelativePath | Callable[[], RelativePath] | None = None,
        reference: PhysicalObject | None = None,
        transform: RelativeTransform = "object_relative",
        start_offset: Value = 0.0,
        end_offset: Value = 0.0,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Be on a path exactly, whatever the limits; arguments as of `follow_path` (§8.8.2.8)."""

    def replay_trajectory(
        self,
        label: str | StartModifier | PhysicalMovement | None = None,
        /,
        *modifiers: StartModifier | PhysicalMovement,
        absolute: Trajectory | Callable[[], Trajectory] | None = None,
        relative: RelativeTrajectory | Callable[[], RelativeTrajectory] | None = None,
        reference: PhysicalObject | None = None,
        transform: RelativeTransform = "object_relative",
        start_offset: Value = 0.0,
        end_offset: Value = 0.0,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Be on a trajectory at its times exactly; arguments as of `follow_trajectory`.

        Section §8.8.2.9.
        """
