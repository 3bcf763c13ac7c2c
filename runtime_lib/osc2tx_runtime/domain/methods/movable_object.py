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
        """Set an acceleration (m/s^2) instantly, whatever the limits (§8.8.2.7)."""

    def assign_orientation(
        self,
        label: str | None = None,
        /,
        *,
        orientation: Orientation | Callable[[], Orientation],
        duration: Duration | None = None,
    ) -> Behaviour:
        """Set heading, pitch and roll instantly (§8.8.2.5).

        A vehicle then returns to the direction of its lane, and to the attitude of the road as soon
        as its wheels roll; other actors keep the assigned pose. A pitch or roll of zero follows the
        road.
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
        """Teleport to a position; the speed remains (§8.8.2.4).

        Args:
            *modifiers: position, lane, speed, yaw, orientation: instead of a point.
            position: Point in the world.
            route_point: Point in route coordinates.
            odr_point: Point in road coordinates.
        """

    def assign_speed(
        self, label: str | None = None, /, *, speed: Value, duration: Duration | None = None
    ) -> Behaviour:
        """Set a speed (m/s) instantly, whatever the limits (§8.8.2.6)."""

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
        """Reach an acceleration; fails if the actor reaches standstill before (§8.8.2.14).

        Args:
            *modifiers: Modifiers of the lane.
            target: Acceleration (m/s^2), within the limits of the actor.
            rate_profile: Profile of the jerk; `constant`, `none` and `asap` keep it constant.
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
        """Move to a position; the speed is free; from standstill it becomes `CRUISE`.

        Section §8.8.2.11.

        Args:
            *modifiers: Modifiers of the speed.
            target_position: Any kind of point.
            target_xyz: Point in the world.
            target_st: Point in route coordinates.
            target_odr: Point in road coordinates.
            interpolation: `smooth` starts in the present heading; only off the road network.
            on_road_network: Whether to move along lanes; default: vehicles on a lane do.
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
            rate_profile: Profile of the acceleration.
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
            start_offset: Metres of the path to omit at its start.
            end_offset: Metres to omit at its end.
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
        """Follow a trajectory as the limits of the actor allow; late arrival is not a failure.

        Section §8.8.2.17.

        Args:
            *modifiers: Only `physical_movement`.
            absolute: The trajectory; its times count from the start of the action.
            relative: Or a trajectory relative to the pose of a reference at the start.
            reference: Default: the actor itself.
            transform: Frame of the relative points.
            start_offset: Metres to omit at the start: the action begins at their end, instantly.
            end_offset: Metres to omit at its end.
        """

    def keep_acceleration(
        self,
        label: str | SideModifier | StartModifier | None = None,
        /,
        *modifiers: SideModifier | StartModifier,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Hold the present acceleration; an actor that reaches standstill remains there.

        Section §8.8.2.15.
        """

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
        """Move as the modifiers state (§8.8.2.3)."""

    def remain_stationary(
        self,
        label: str | TurnModifier | StartModifier | KeepPosition | PhysicalMovement | None = None,
        /,
        *modifiers: TurnModifier | StartModifier | KeepPosition | PhysicalMovement,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Remain at standstill (§8.8.2.10).

        A moving actor first brakes with its greatest deceleration, unless physics must hold. If a
        modifier states the position, the actor has to be there at the start.
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
        """Follow a path exactly, whatever the limits; arguments as of `follow_path` (§8.8.2.8)."""

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
        """Follow a trajectory exactly in position and time; arguments as of `follow_trajectory`.

        Section §8.8.2.9.
        """
