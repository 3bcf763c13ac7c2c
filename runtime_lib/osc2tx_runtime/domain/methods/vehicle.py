"""Actions of the actor type `vehicle`; made by tools/make_actor_methods.py."""

# The registry executes these declarations.
# mypy: disable-error-code="empty-body"

from __future__ import annotations

from typing import TYPE_CHECKING

from osc2tx_runtime.language.actions.registry import carried_out

if TYPE_CHECKING:
    from collections.abc import Callable

    from osc2tx_runtime.domain.map.roads_and_lanes import Lane
    from osc2tx_runtime.domain.modifiers import Value
    from osc2tx_runtime.domain.modifiers.base import Late
    from osc2tx_runtime.domain.modifiers.groups import (
        PathModifier,
        SideModifier,
        SpeedModifier,
        StartModifier,
    )
    from osc2tx_runtime.domain.modifiers.movement.position import Distance, KeepPosition
    from osc2tx_runtime.domain.objects.parts import Towable
    from osc2tx_runtime.domain.objects.physical_objects import PhysicalObject
    from osc2tx_runtime.enums import (
        DynamicProfile,
        GapDirection,
        HeadwayDirection,
        LaneChangeSide,
        RoadDistanceDirection,
    )
    from osc2tx_runtime.language.tree.base import Behaviour
    from osc2tx_runtime.language.tree.duration_limits import Duration
    from osc2tx_runtime.language.values.parameters import Range
    from osc2tx_runtime.world.protocol import LightMode


@carried_out
class VehicleMethods:
    """Actions of the actor type `vehicle`."""

    def change_lane(
        self,
        label: str | SpeedModifier | StartModifier | None = None,
        /,
        *modifiers: SpeedModifier | StartModifier,
        num_of_lanes: int | Callable[[], int] = 1,
        side: Late[LaneChangeSide] | None = None,
        reference: PhysicalObject | None = None,
        offset: Value = 0.0,
        rate_profile: DynamicProfile = "none",
        rate_peak: Value | None = None,
        target: Lane | None = None,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Change to another lane, and end aligned with it (§8.8.3.3).

        Without a rate or a duration it takes `LANE_CHANGE_TIME` (3 s) for 3.5 m. The lane may be
        one of oncoming traffic: there the actor continues in its own direction.

        Args:
            *modifiers: Modifiers of the speed.
            num_of_lanes: Number of lanes from the reference.
            side: Side of the reference; `inside` is towards opposing traffic, `same` its own lane.
                Default: drawn from the seed among the sides with a lane of its direction.
            reference: Default: the actor itself.
            offset: Metres to the left of the target lane centre at the end.
            rate_profile: Profile of the lateral speed.
            rate_peak: Its peak (m/s).
            target: Instead of a number and a side: a lane of the map beside the present lane.
        """

    def change_space_gap(
        self,
        label: str | SpeedModifier | SideModifier | None = None,
        /,
        *modifiers: SpeedModifier | SideModifier,
        target: Value,
        direction: GapDirection,
        reference: PhysicalObject,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Reach a space gap (m) between facing ends or sides, in a direction from the reference.

        Section §8.8.3.6.
        """

    def change_space_headway(
        self,
        label: str | SpeedModifier | SideModifier | None = None,
        /,
        *modifiers: SpeedModifier | SideModifier,
        target: Value,
        direction: HeadwayDirection,
        reference: PhysicalObject,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Reach a space headway (m) between fronts, `ahead` of or `behind` the reference.

        Section §8.8.3.10.
        """

    def change_time_gap(
        self,
        label: str | SpeedModifier | SideModifier | None = None,
        /,
        *modifiers: SpeedModifier | SideModifier,
        target: Value,
        direction: GapDirection,
        reference: PhysicalObject,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Reach a time gap (s) between facing ends at the speed of the follower, or between sides.

        Section §8.8.3.4.
        """

    def change_time_headway(
        self,
        label: str | SpeedModifier | SideModifier | None = None,
        /,
        *modifiers: SpeedModifier | SideModifier,
        target: Value,
        direction: HeadwayDirection,
        reference: PhysicalObject,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Reach a time headway (s) between fronts, at the speed of the follower (§8.8.3.8)."""

    def connect_trailer(
        self, label: str | None = None, /, *, trailer: Towable, duration: Duration | None = None
    ) -> Behaviour:
        """Couple a trailer whose coupler is within `COUPLING_REACH` of the rear end of the vehicle.

        Section §8.8.3.12.
        """

    def disconnect_trailer(
        self, label: str | None = None, /, *, duration: Duration | None = None
    ) -> Behaviour:
        """Uncouple the trailer, which brakes to standstill (§8.8.3.13)."""

    def drive(
        self,
        label: (
            str | SpeedModifier | SideModifier | PathModifier | Distance | KeepPosition | None
        ) = None,
        /,
        *modifiers: SpeedModifier | SideModifier | PathModifier | Distance | KeepPosition,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Drive as the modifiers state (§8.8.3.1).

        Without modifiers along the lane at the present speed.
        """

    def follow_lane(
        self,
        label: str | SpeedModifier | StartModifier | None = None,
        /,
        *modifiers: SpeedModifier | StartModifier,
        offset: Value | None = None,
        offset_range: Range[float] | Callable[[], Range[float]] | None = None,
        rate_profile: DynamicProfile = "none",
        rate_peak: Value | None = None,
        target: Lane | None = None,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Stay in a lane (§8.8.3.2).

        Args:
            *modifiers: Modifiers of the speed.
            offset: Metres to the left of its centre.
            offset_range: Instead of the offset: its range at all times.
            rate_profile: Profile of the lateral speed until it is reached.
            rate_peak: Its peak (m/s).
            target: The lane of the map; None: the present lane.
        """

    def keep_space_gap(
        self,
        label: str | SpeedModifier | SideModifier | None = None,
        /,
        *modifiers: SpeedModifier | SideModifier,
        reference: PhysicalObject,
        direction: RoadDistanceDirection = "longitudinal",
        duration: Duration | None = None,
    ) -> Behaviour:
        """Hold the present space gap between facing ends or sides (§8.8.3.7)."""

    def keep_space_headway(
        self,
        label: str | SpeedModifier | SideModifier | None = None,
        /,
        *modifiers: SpeedModifier | SideModifier,
        reference: PhysicalObject,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Hold the present space headway between fronts (§8.8.3.11)."""

    def keep_time_gap(
        self,
        label: str | SpeedModifier | SideModifier | None = None,
        /,
        *modifiers: SpeedModifier | SideModifier,
        reference: PhysicalObject,
        direction: RoadDistanceDirection = "longitudinal",
        duration: Duration | None = None,
    ) -> Behaviour:
        """Hold the present time gap between facing ends or sides (§8.8.3.5)."""

    def keep_time_headway(
        self,
        label: str | SpeedModifier | SideModifier | None = None,
        /,
        *modifiers: SpeedModifier | SideModifier,
        reference: PhysicalObject,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Hold the present time headway between fronts (§8.8.3.9)."""

    def set_lights(
        self, label: str | None = None, /, *, mode: LightMode, duration: Duration | None = None
    ) -> Behaviour:
        """Switch the lights.

        Args:
            *modifiers: None are accepted.
            mode: `off`, `auto` (low beams while the sun is lower than 15 degrees or the visual
                range is below 100 m), `daytime`, `position`, `low_beam` or `high_beam`.
        """
