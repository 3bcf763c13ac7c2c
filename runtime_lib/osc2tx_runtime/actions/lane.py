"""Actions on the lane alone (DSL 8.8.3)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, Unpack

from osc2tx_runtime.action import ActionOptions
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.modifiers import Modifier, Value, value_of
from osc2tx_runtime.registry import LATERAL, action
from osc2tx_runtime.world.commands import LaneChange, LaneOffset
from osc2tx_runtime.world.lanes import lanes_to_left
from osc2tx_runtime.world.profiles import DynamicProfile

from .speed import check_profile
from .support import MotionAction

if TYPE_CHECKING:
    from osc2tx_runtime.actors import PhysicalObject, Vehicle

__all__ = ["SIDES", "ChangeLane", "FollowLane", "LaneSide"]

LaneSide = Literal["left", "right", "inside", "outside", "same"]
SIDES: tuple[LaneSide, ...] = ("left", "right", "inside", "outside", "same")


@action("vehicle", "change_lane", slots=(LATERAL,))
class ChangeLane(MotionAction):
    """End in another lane, aligned with it.

    Without a rate or a duration it takes `LANE_CHANGE_TIME` (3 s) for 3.5 m.

    Args:
        actor: Who.
        *modifiers: None are taken.
        num_of_lanes: How many lanes away from the reference.
        side: On which side of it; `inside` is towards opposing traffic, `same` its own lane.
            Without a side one is drawn from the seed among those that exist.
        reference: Default: the actor itself.
        offset: Metres left of the centre of the target lane at the end.
        rate_profile: Course of the lateral speed.
        rate_peak: Its peak (m/s).
        **options: Duration and label.
    """

    def __init__(
        self,
        actor: Vehicle,
        *modifiers: Modifier,
        num_of_lanes: int = 1,
        side: LaneSide | None = None,
        reference: PhysicalObject | None = None,
        offset: Value = 0.0,
        rate_profile: DynamicProfile = "none",
        rate_peak: float | None = None,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        check_profile(self.action_name, rate_profile)
        if side is not None and side not in SIDES:
            raise ScenarioError(f"{self.action_name}: side `{side}` is none of {', '.join(SIDES)}")
        if num_of_lanes < 0:
            raise ScenarioError(f"{self.action_name}: num_of_lanes {num_of_lanes} is negative")
        self.num_of_lanes = num_of_lanes
        self.side = side
        self.reference = reference
        self.offset = offset
        self.rate_profile: DynamicProfile = rate_profile
        self.rate_peak = rate_peak

    def on_start(self) -> None:
        """Commands the change."""
        command = LaneChange(
            self._lanes(),
            value_of(self.offset),
            self.rate_profile,
            self.rate_peak,
            self.fixed_duration() if self.rate_profile != "asap" else None,
        )
        self.command(LATERAL, command)

    def _lanes(self) -> int:
        """Lanes to the left of the present one; negative: to the right."""
        own = self.place_of(self.actor.id)
        beside = 0
        if self.reference is not None:
            beside = lanes_to_left(self.world.map, own, self.place_of(self.reference.id))
        if self.side == "same":
            return beside
        return beside + self.num_of_lanes * self._direction()

    def _direction(self) -> int:
        """1 for left, -1 for right."""
        own = self.place_of(self.actor.id)
        right_hand = self.world.map.roads[own.road].right_hand_traffic
        match self.side:
            case "left":
                return 1
            case "right":
                return -1
            case "inside":
                return 1 if right_hand else -1
            case "outside":
                return -1 if right_hand else 1
        return 1 if self.drawn_side(self.num_of_lanes) == "left" else -1


@action("vehicle", "follow_lane", slots=(LATERAL,), ends="open")
class FollowLane(MotionAction):
    """Stay in the present lane.

    Args:
        actor: Who.
        *modifiers: None are taken.
        offset: Metres left of its centre.
        rate_profile: Course of the lateral speed on the way there.
        rate_peak: Its peak (m/s).
        **options: Duration and label.
    """

    def __init__(
        self,
        actor: Vehicle,
        *modifiers: Modifier,
        offset: Value = 0.0,
        rate_profile: DynamicProfile = "none",
        rate_peak: float | None = None,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        check_profile(self.action_name, rate_profile)
        self.offset = offset
        self.rate_profile: DynamicProfile = rate_profile
        self.rate_peak = rate_peak

    def on_start(self) -> None:
        """Commands the offset."""
        offset = value_of(self.offset)
        self.command(LATERAL, LaneOffset(offset, self.rate_profile, self.rate_peak))
