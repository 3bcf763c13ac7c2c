"""Generic movement: `drive`, `walk`, `move`, shaped by modifiers only (DSL 8.8.2.3, 8.8.3.1)."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, TypeVar, Unpack

from osc2tx_runtime.action import ActionOptions
from osc2tx_runtime.behaviour.base import Status
from osc2tx_runtime.errors import ScenarioError, UnsupportedError
from osc2tx_runtime.modifiers import (
    Acceleration,
    ChangeLane,
    ChangeSpeed,
    KeepLane,
    KeepSpeed,
    Lane,
    Lateral,
    Modifier,
    Orient,
    PhysicalMovement,
    Position,
    Speed,
    Yaw,
    value_of,
)
from osc2tx_runtime.poses import heading_of
from osc2tx_runtime.registry import LATERAL, LONGITUDINAL, action
from osc2tx_runtime.world.commands import (
    Accelerate,
    Command,
    FollowSpeed,
    KeepGap,
    LaneChange,
    LaneOffset,
    SpeedChange,
    Turn,
)
from osc2tx_runtime.world.lanes import lane_with_number, lanes_to_left
from osc2tx_runtime.world.longitudinal import excessive_rate

from .support import MotionAction

if TYPE_CHECKING:
    from osc2tx_runtime.actors import MovableObject

__all__ = ["Drive", "Move", "Walk"]

_SPEED_MODIFIERS = (Speed, ChangeSpeed, KeepSpeed, Acceleration, Position)
_SIDE_MODIFIERS = (Lane, Lateral, ChangeLane, KeepLane, Yaw, Orient)
_AT_START = (
    "a speed at the start together with another one is not there yet; put assign_speed before it"
)
ModifierT = TypeVar("ModifierT", bound=Modifier)


class _Movement(MotionAction):
    """Moves as the modifiers say, until it is ended from outside.

    It controls the speed if a modifier speaks of it, and the lane likewise, so that
    `drive() with: speed(...)` and `change_lane(...)` run side by side.
    """

    def __init__(
        self, actor: MovableObject, *modifiers: Modifier, **options: Unpack[ActionOptions]
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        self.movable = actor
        self._only_one_of((Speed,), (ChangeSpeed,), (KeepSpeed,), (Position,))
        self._only_one_of((Acceleration,), (ChangeSpeed,), (KeepSpeed,), (Position,))
        self._only_one_of((Lane,), (ChangeLane,), (KeepLane,), (Yaw, Orient))
        self.slots = tuple(
            slot
            for slot, kinds in ((LONGITUDINAL, _SPEED_MODIFIERS), (LATERAL, _SIDE_MODIFIERS))
            if any(isinstance(modifier, kinds) for modifier in modifiers)
        )
        self._refused: str | None = None

    def on_start(self) -> None:
        """Commands what the modifiers say."""
        speed = self._speed_command()
        if isinstance(speed, SpeedChange) and speed.duration != 0.0:  # 0: it may jump
            self._refused = excessive_rate(speed, self.here.v)
        if speed is not None and self._refused is None:
            self.command(LONGITUDINAL, speed)
        side = self._side_command()
        if side is not None:
            self.command(LATERAL, side)

    def on_update(self) -> Status:
        """Fails if it cannot move so."""
        return super().on_update() if self._refused is None else self.fail(self._refused)

    def _only_one_of(self, *groups: tuple[type[Modifier], ...]) -> None:
        """Refuses modifiers that speak of the same thing."""
        found = [m.name for group in groups for m in self.modifiers if isinstance(m, group)]
        here = {group for group in groups for m in self.modifiers if isinstance(m, group)}
        if len(here) > 1:
            raise UnsupportedError(
                f"{self.action_name}: {' and '.join(found)} speak of the same thing; give one"
            )

    def _all(self, kind: type[ModifierT]) -> list[ModifierT]:
        """The modifiers of a kind."""
        return [modifier for modifier in self.modifiers if isinstance(modifier, kind)]

    def _the(self, kind: type[ModifierT]) -> ModifierT | None:
        """The one modifier of a kind."""
        found = self._all(kind)
        if len(found) > 1:
            raise ScenarioError(
                f"{self.action_name} has {len(found)} modifiers {found[0].name}", self.source
            )
        return found[0] if found else None

    # --- speed --------------------------------------------------------------------------------

    def _speed_command(self) -> Command | None:
        position = self._the(Position)
        if position is not None:
            return self._gap(position)
        rate = self._the(Acceleration)
        change = self._the(ChangeSpeed)
        if change is not None:
            return SpeedChange(self.here.v + value_of(change.speed))
        speed = self._speed()
        if rate is not None and any(m.at == "start" for m in self._all(Speed)):
            raise UnsupportedError(f"{self.action_name}: {_AT_START}", self.source)
        if speed is None:
            return None if rate is None else Accelerate(value_of(rate.acceleration))
        if speed.reference is not None:
            if speed.rate_profile != "none" or speed.rate_peak is not None or speed.at == "end":
                raise UnsupportedError(
                    f"{self.action_name}: a speed relative to an actor takes neither a rate nor"
                    " an end yet",
                    self.source,
                )
            return FollowSpeed(speed.reference.id, speed.factor, speed.difference())
        return self._to_speed(speed, rate)

    def _speed(self) -> Speed | None:
        """The speed to reach; one that holds at the start is assigned."""
        wanted = self._all(Speed)
        for modifier in wanted:
            if modifier.at == "start":
                value = modifier.difference()
                if modifier.reference is not None:
                    value += modifier.factor * self.world.state(modifier.reference.id).v
                self._assign_speed(value)
        lasting = [modifier for modifier in wanted if modifier.at != "start"]
        if len(lasting) > 1:
            raise ScenarioError(f"{self.action_name} has two speeds for one time", self.source)
        if lasting and len(wanted) > len(lasting):
            raise UnsupportedError(f"{self.action_name}: {_AT_START}", self.source)
        return lasting[0] if lasting else None

    def _assign_speed(self, value: float) -> None:
        actor_id = self.actor.id
        self.effect("speed", value, lambda: self.world.assign(actor_id, speed=value))

    def _to_speed(self, speed: Speed, rate: Acceleration | None) -> SpeedChange:
        target = speed.difference()
        jump = self._the(PhysicalMovement)
        if jump is not None and jump.option == "prefer_non_physical":
            return SpeedChange(target, "constant", None, 0.0)
        if rate is not None:
            return SpeedChange(target, "constant", abs(value_of(rate.acceleration)))
        if speed.at == "end":
            duration = self.fixed_duration()
            if duration is None:
                raise UnsupportedError(
                    f"{self.action_name}: speed at the end needs a duration", self.source
                )
            return SpeedChange(target, speed.rate_profile, speed.rate_peak, duration)
        return SpeedChange(target, speed.rate_profile, speed.rate_peak)

    def _gap(self, position: Position) -> KeepGap:
        reference = position.reference
        if reference is None or position.at != "all":
            raise UnsupportedError(
                f"{self.action_name}: position needs ahead_of or behind while it moves; for a"
                " start use assign_position",
                self.source,
            )
        time = None if position.time is None else value_of(position.time)
        size = time if time is not None else value_of(position.distance or 0.0)
        ahead = (position.ahead_of is not None) == (size >= 0.0)
        return KeepGap(
            reference.id,
            ahead,
            "reference",
            distance=abs(size) if time is None else None,
            time=None if time is None else abs(time),
        )

    # --- lane ---------------------------------------------------------------------------------

    def _side_command(self) -> Command | None:
        heading = heading_of(self.world, self.movable, self.modifiers, self.here)
        if heading is not None:
            return Turn(heading)
        lateral = self._the(Lateral)
        lanes = self._lanes()
        if lanes is not None:
            duration = None
            lane = self._the(Lane)
            if lane is not None and lane.at == "end":
                duration = self.fixed_duration()
            offset = 0.0 if lateral is None else lateral.offset()
            if lanes == 0 and lateral is None and self.here.offset == 0.0:
                return None
            return LaneChange(lanes, offset, duration=duration)
        return None if lateral is None else LaneOffset(lateral.offset())

    def _lanes(self) -> int | None:
        """Lanes to the left of the present one; None if no modifier names a lane."""
        change = self._the(ChangeLane)
        if change is not None:
            if change.side is None:
                raise ScenarioError(f"{self.action_name}: change_lane needs a side", self.source)
            return change.lane if change.side == "left" else -change.lane
        lane = self._the(Lane)
        if lane is None:
            return None
        if lane.at == "start":
            raise UnsupportedError(
                f"{self.action_name}: for a lane to start in use assign_position", self.source
            )
        own = self.place_of(self.actor.id)
        if lane.reference is not None:
            beside = lanes_to_left(self.world.map, own, self.place_of(lane.reference.id))
            if lane.side_of is None:
                return beside
            return beside + (lane.number if lane.side == "left" else -lane.number)
        target = lane_with_number(self.world.map, own, lane.number, lane.from_)
        if target is None:
            self._refused = (
                f"road {own.road} has no lane {lane.number} from the {lane.from_}"
                f" at s = {own.s:.1f} m"
            )
            return None
        return lanes_to_left(self.world.map, own, target)


@action("movable_object", "move", slots=(LONGITUDINAL, LATERAL), ends="open")
class Move(_Movement):
    """Move as the modifiers say."""

    accepts: ClassVar[tuple[type, ...]] = (*_SPEED_MODIFIERS, *_SIDE_MODIFIERS, PhysicalMovement)


@action("vehicle", "drive", slots=(LONGITUDINAL, LATERAL), ends="open")
class Drive(_Movement):
    """Drive as the modifiers say; without any, on in the lane at the present speed."""

    accepts: ClassVar[tuple[type, ...]] = (
        *_SPEED_MODIFIERS,
        *(Lane, Lateral, ChangeLane, KeepLane),
        PhysicalMovement,
    )


@action("animal", "walk", slots=(LONGITUDINAL, LATERAL), ends="open")
@action("person", "walk", slots=(LONGITUDINAL, LATERAL), ends="open")
class Walk(_Movement):
    """Walk as the modifiers say, straight on."""

    accepts: ClassVar[tuple[type, ...]] = (
        *(Speed, ChangeSpeed, KeepSpeed, Acceleration),
        *(Yaw, Orient),
        PhysicalMovement,
    )
