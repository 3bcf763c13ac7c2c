"""Lane actions: change and follow a lane (DSL 8.8.3)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, ClassVar, Unpack, get_args

from osc2tx_runtime.domain.map.road_graph import graph_of
from osc2tx_runtime.domain.modifiers import Modifier, Value, value_of
from osc2tx_runtime.domain.modifiers.base import Late, band_of, now
from osc2tx_runtime.domain.modifiers.groups import SPEED_FREE
from osc2tx_runtime.domain.planning.lateral.lateral_planning import lane_of
from osc2tx_runtime.domain.planning.lateral.lateral_targets import (
    check_shift,
    jump_aside,
    lanes_beside,
    lanes_to,
    leads_beside,
    may_leave_lane_before,
    target_of_shift,
)
from osc2tx_runtime.domain.planning.motion_action import Refused
from osc2tx_runtime.enums import DynamicProfile, LaneChangeSide
from osc2tx_runtime.errors import BeyondMapError, ScenarioError
from osc2tx_runtime.language.actions.action import ActionOptions
from osc2tx_runtime.language.actions.registry import LATERAL, action
from osc2tx_runtime.language.tree.base import Status
from osc2tx_runtime.language.tree.duration_limits import Duration
from osc2tx_runtime.opendrive import LanePosition
from osc2tx_runtime.world.commands import LaneChange
from osc2tx_runtime.world.geometry.lane_neighbours import lane_beside, offset_from
from osc2tx_runtime.world.lateral.execution import shift_profile
from osc2tx_shared.rules import above, at_least, at_least_one, at_most_one

from .modifiable import ModifiableAction
from .profiled_change import check_profile, peak_of

if TYPE_CHECKING:
    from osc2tx_runtime.domain.actors import Vehicle
    from osc2tx_runtime.domain.map.roads_and_lanes import Lane
    from osc2tx_runtime.domain.objects.physical_objects import PhysicalObject
    from osc2tx_runtime.language.values.parameters import Range

SIDES: tuple[LaneChangeSide, ...] = get_args(LaneChangeSide)


class _OnLane(ModifiableAction):
    """Moves to a lateral position."""

    accepts: ClassVar[tuple[type, ...]] = SPEED_FREE

    def __init__(
        self,
        actor: Vehicle,
        *modifiers: Modifier,
        course: tuple[DynamicProfile, Value | None],
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        self.rate_profile, self._rate_peak = course
        check_profile(self.action_name, self.rate_profile)

    @property
    def rate_peak(self) -> float | None:
        """The peak of the lateral speed (m/s) now; None if none is given."""
        return peak_of(self._rate_peak, "m/s")

    def shift(self, lanes: int, offset: float, duration: Duration | None) -> None:
        """Commands the motion to a lane (a number of lanes to the left) and an offset (m) in it.

        Raises:
            Refused: It is not possible.
        """
        if self.may_jump:
            jump_aside(self, lanes, offset)
            return
        peak = self.rate_peak
        there = lane_beside(self.world.map, self.place_of(self.actor.id), lanes)
        time = None
        if there is not None and duration is not None and self.rate_profile != "asap":
            time = self._time(there, offset, duration, peak)
            if self.strict and time is not None:
                check_shift(self, lanes, offset, time)
        self.command(LATERAL, LaneChange(lanes, offset, self.rate_profile, peak, time))

    def _time(
        self, there: LanePosition, offset: float, duration: Duration, peak: float | None
    ) -> float | None:
        """The time (s) for it, if the duration leaves a choice."""
        here = self.here
        start = offset_from(self.world.map, there, here.x, here.y)
        course = (self.rate_profile, peak, None)
        own = shift_profile(start, offset, here.lateral_speed, course, self.limits).duration
        low, high = duration if isinstance(duration, tuple) else (duration, duration)
        if low - self.context.dt <= own <= high + self.context.dt and low < high:
            return None
        if peak is None:
            return min(max(own, low), high)
        if abs(own - min(max(own, low), high)) > self.context.dt:
            raise Refused(
                f"with rate_peak {peak:g} m/s it takes {own:.2f} s, not"
                f" {low if own < low else high:g} s"
            )
        return None


@action("vehicle", "change_lane", slots=(LATERAL,), needs=("lanes",))
class ChangeLane(_OnLane):
    """Change to another lane, and end aligned with it.

    Without a rate or a duration it takes `LANE_CHANGE_TIME` (3 s) for 3.5 m. The lane may be one
    of oncoming traffic: there the actor continues in its own direction.

    Args:
        actor: The actor.
        *modifiers: Modifiers of the speed.
        num_of_lanes: Number of lanes from the reference.
        side: Side of the reference; `inside` is towards opposing traffic, `same` its own lane.
            Default: drawn from the seed among the sides with a lane of its direction.
        reference: Default: the actor itself.
        offset: Metres to the left of the target lane centre at the end.
        rate_profile: Profile of the lateral speed.
        rate_peak: Its peak (m/s).
        target: Instead of a number and a side: a lane of the map beside the present lane.
        **options: Duration and label.
    """

    rules = (
        at_most_one("target", "side"),
        at_most_one("target", "reference"),
        at_least_one("reference", when=["side"], values=["same"]),
        at_least(0, "num_of_lanes", when=["reference"]),
        at_least(1, "num_of_lanes", unless=["reference"]),  # it is in its own lane already
        above(0, "rate_peak"),
    )

    def __init__(
        self,
        actor: Vehicle,
        *modifiers: Modifier,
        num_of_lanes: int | Callable[[], int] = 1,
        side: Late[LaneChangeSide] | None = None,
        reference: PhysicalObject | None = None,
        offset: Value = 0.0,
        rate_profile: DynamicProfile = "none",
        rate_peak: Value | None = None,
        target: Lane | None = None,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, *modifiers, course=(rate_profile, rate_peak), **options)
        if side is not None and not callable(side) and side not in SIDES:
            raise ScenarioError(
                f"{self.action_name}: side `{side}` is not one of {', '.join(SIDES)}"
            )
        self.num_of_lanes = num_of_lanes
        self.side = side
        self.reference = None if reference is actor else reference  # it starts from its own lane
        self.offset = offset
        self.target = target
        self._beside: int | None = None  # lane of the reference when the change was planned

    def look_ahead(self) -> None:
        """Check that the road has enough lanes, unless the actor may be in another lane by then."""
        count, place = self.num_of_lanes, self.here.lane_position
        if place is None or callable(count) or callable(self.side) or self.side in (None, "same"):
            return
        if self.target is not None or self.reference is not None or may_leave_lane_before(self):
            return
        lanes = count * self._direction(count)
        if not leads_beside(graph_of(self.world.map), place, lanes):
            side = "left" if lanes > 0 else "right"
            raise BeyondMapError(
                f"no part of its route has {count} driving lanes to the {side} of lane"
                f" {place.lane} of road {place.road}",
                self.source,
            )

    def on_start(self) -> None:
        """Commands the change."""
        lanes = self._lanes()
        if lanes == 0:
            lane = self.place_of(self.actor.id).lane
            raise Refused(
                f"it is already in lane {lane}, the target of the lane change;"
                " follow_lane stays in it"
            )
        self._beside = self._lane_of_reference()
        self.shift(lanes, value_of(self.offset), self.time_frame())

    def _lane_of_reference(self) -> int | None:
        return None if self.reference is None else lane_of(self, self.reference)

    @property
    def looks_further(self) -> bool:
        """After an instant change, and for a reference that changes lanes."""
        return self.may_jump or self.reference is not None

    def on_update(self) -> Status:
        """Ends in the lane, after an instant change at the next step; follows the reference."""
        if self.may_jump and not self.has_goal:
            return Status.SUCCESS if self.elapsed_steps else Status.RUNNING
        if self._beside != (now_in := self._lane_of_reference()):
            self._beside = now_in
            left = self.time_left()
            duration = self.duration if left is None or self.duration is None else max(left, 0.0)
            self.shift(self._lanes(), value_of(self.offset), duration)
            return Status.RUNNING
        return super().on_update()

    def _lanes(self) -> int:
        """Lanes to the left of the present one; negative: to the right."""
        if self.target is not None:
            return lanes_to(self, self.target)
        lanes = 0
        if self.side is None or now(self.side) != "same":
            count = now(self.num_of_lanes)
            if count < 0:
                raise Refused(f"num_of_lanes {count} is negative")
            lanes = count * self._direction(count)
        return lanes if self.reference is None else lanes_beside(self, self.reference.id, lanes)

    def _direction(self, count: int) -> int:
        """1 for left, -1 for right."""
        own = self.place_of(self.actor.id)
        right_hand = self.world.map.roads[own.road].right_hand_traffic
        match None if self.side is None else now(self.side):
            case "left":
                return 1
            case "right":
                return -1
            case "inside":
                return 1 if right_hand else -1
            case "outside":
                return -1 if right_hand else 1
        return 1 if self.drawn_side(count) == "left" else -1


@action("vehicle", "follow_lane", slots=(LATERAL,), ends="open", needs=("lanes",))
class FollowLane(_OnLane):
    """Stay in a lane.

    Args:
        actor: The actor.
        *modifiers: Modifiers of the speed.
        offset: Metres to the left of its centre.
        offset_range: Instead of the offset: its range at all times.
        rate_profile: Profile of the lateral speed until it is reached.
        rate_peak: Its peak (m/s).
        target: The lane of the map; None: the present lane.
        **options: Duration and label.
    """

    rules = (at_most_one("offset", "offset_range"), above(0, "rate_peak"))

    def __init__(
        self,
        actor: Vehicle,
        *modifiers: Modifier,
        offset: Value | None = None,
        offset_range: Range[float] | Callable[[], Range[float]] | None = None,
        rate_profile: DynamicProfile = "none",
        rate_peak: Value | None = None,
        target: Lane | None = None,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, *modifiers, course=(rate_profile, rate_peak), **options)
        self.offset = offset
        self.offset_range = offset_range
        self.target = target

    def on_start(self) -> None:
        """Commands the offset."""
        lanes = 0 if self.target is None else lanes_to(self, self.target)
        if lanes != 0:
            side = "left" if lanes > 0 else "right"
            raise Refused(
                f"the lane to follow is {abs(lanes)} to the {side} of the present one;"
                " change_lane leads to it"
            )
        low, high = band_of(self.offset, self.offset_range)
        here = self.place_of(self.actor.id).offset - target_of_shift(self, 0).offset
        self.shift(0, min(max(here, low), high), None)
