"""Generic movement: `drive`, `walk`, `move`, shaped by modifiers only (DSL 8.8.2.3, 8.8.3.1).

`at: all` holds (or is approached and then held) from the start of the action on; `at: end` is
reached exactly at the end of its duration, or ends an action without one; `at: start` is a jump.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any, ClassVar, Unpack

from osc2tx_runtime.action import ActionOptions
from osc2tx_runtime.actors import MovableObject
from osc2tx_runtime.behaviour.base import Status
from osc2tx_runtime.errors import UnsupportedError
from osc2tx_runtime.modifiers import (
    Acceleration,
    Along,
    AlongTrajectory,
    AvoidCollisions,
    ChangeLane,
    ChangeSpeed,
    Distance,
    KeepLane,
    KeepPosition,
    KeepSpeed,
    Lane,
    Lateral,
    Modifier,
    Orient,
    PhysicalMovement,
    Position,
    Speed,
    Yaw,
)
from osc2tx_runtime.paths import PathError
from osc2tx_runtime.poses import one_of_kind
from osc2tx_runtime.registry import LATERAL, LONGITUDINAL, Method, action
from osc2tx_runtime.world.commands import Careful

from .checks import check_modifiers
from .sides import side_command
from .speeds import distance_to_cover, speed_command
from .support import MotionAction, Refused

__all__ = ["Drive", "Move", "Walk"]

_SPEED_MODIFIERS = (
    *(Speed, ChangeSpeed, KeepSpeed, Acceleration),
    *(Position, Distance, KeepPosition, AvoidCollisions, AlongTrajectory),
)
_LANE_MODIFIERS = (Lane, Lateral, ChangeLane, KeepLane)
_TURN_MODIFIERS = (Yaw, Orient)
_PATH_MODIFIERS = (Along, AlongTrajectory)


class Movement(MotionAction):
    """Moves as the modifiers say, until it is ended from outside or reaches what they say.

    It controls the speed if a modifier speaks of it, and the lane likewise, so that
    `drive() with: speed(...)` and `change_lane(...)` run side by side.
    """

    def __init__(
        self, actor: MovableObject, *modifiers: Modifier, **options: Unpack[ActionOptions]
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        self.movable = actor
        check_modifiers(self)
        self.slots = tuple(slot for slot in (LONGITUDINAL, LATERAL) if self._speaks_of(slot))
        self._refused: str | None = None
        self._reached = False
        self._to_cover: float | None = None
        self._covered = 0.0
        self._counted = (0, 0.0)

    def become(self, method: Method) -> None:
        """Take the method; a goal bounds the action."""
        super().become(method)
        if self.has_goal and self.duration is None:
            self.open_ended = False

    @cached_property
    def has_goal(self) -> bool:
        """True if a modifier says what is to be reached."""
        return any(
            isinstance(modifier, (Distance, *_PATH_MODIFIERS))
            or getattr(modifier, "at", "all") == "end"
            for modifier in self.modifiers
        )

    def option(self) -> str:
        """What `physical_movement` says; `prefer_physical` without it."""
        physical = one_of_kind(self.modifiers, PhysicalMovement)
        return "prefer_physical" if physical is None else physical.option

    def _speaks_of(self, slot: str) -> bool:
        for modifier in self.modifiers:
            match modifier:
                case Speed(direction="lateral"):
                    found = slot == LATERAL
                case AlongTrajectory() | KeepPosition():
                    found = True
                case AvoidCollisions(avoid=False):
                    found = False
                case Distance():
                    found = slot == LONGITUDINAL and self.duration is not None
                case _:
                    kinds: tuple[type[Modifier], ...] = _SPEED_MODIFIERS
                    if slot == LATERAL:
                        kinds = (*_LANE_MODIFIERS, *_TURN_MODIFIERS, Along)
                    found = isinstance(modifier, kinds)
            if found:
                return True
        return False

    # --- how it runs --------------------------------------------------------------------------

    def on_start(self) -> None:
        """Commands what the modifiers say."""
        self._refused, self._reached, self._covered = None, False, 0.0
        try:
            self._to_cover = distance_to_cover(self)
            speed, side = speed_command(self), side_command(self)
        except (Refused, PathError) as error:
            self._refused = error.message
            return
        careful = one_of_kind(self.modifiers, AvoidCollisions)
        if careful is not None and careful.avoid:
            speed = Careful(speed)
        if speed is not None:
            self.command(LONGITUDINAL, speed)
        if side is not None:
            self.command(LATERAL, side)
        self._counted = (0, self.here.v)

    def on_update(self) -> Status:
        """Fails if it cannot move so; ends with its goal."""
        if self._refused is not None:
            return self.fail(self._refused)
        if self._to_cover is not None:
            self._reached = self._cover() >= self._to_cover - 1e-6
        return super().on_update()

    def ends_with(self, slot: str) -> bool:
        """Whether what is pursued in a slot belongs to the goal."""
        for modifier in self.modifiers:
            lasting = getattr(modifier, "at", "all") == "end"
            lasting = lasting or isinstance(modifier, _PATH_MODIFIERS)
            speed = isinstance(modifier, (*_SPEED_MODIFIERS, AlongTrajectory))
            if lasting and not isinstance(modifier, Distance) and speed == (slot == LONGITUDINAL):
                return True
            if isinstance(modifier, AlongTrajectory):
                return True
        return False

    def goal_reached(self, done: dict[str, bool]) -> bool:
        """Whether all that is to be reached is."""
        if not self.has_goal:
            return False
        reached = all(done[slot] for slot in self.slots if self.ends_with(slot))
        self._reached = reached and (self._to_cover is None or self._reached)
        return self._reached

    def update(self) -> Status:
        """Update; at the end of a duration the goal has to be there."""
        status = super().update()
        if status is Status.SUCCESS and self.has_goal and not self._reached:
            return self.fail("its duration is over before what is to hold at its end does")
        return status

    def _cover(self) -> float:
        """Metres covered since the start."""
        step, speed = self.elapsed_steps, self.here.v
        before, speed_before = self._counted
        if step > before:
            self._covered += 0.5 * abs(speed + speed_before) * (step - before) * self.context.dt
            self._counted = (step, speed)
        return self._covered

    def setup(self, **kwargs: Any) -> None:
        """Check what can be known before the start."""
        super().setup(**kwargs)
        sideways = [m for m in self.modifiers if isinstance(m, Speed) and m.direction == "lateral"]
        if sideways and not self.movable.lane_bound:
            raise UnsupportedError(
                f"{self.action_name}: only vehicles on lanes have a lateral speed",
                self.source or None,
            )


@action("movable_object", "move", slots=(LONGITUDINAL, LATERAL), ends="open")
class Move(Movement):
    """Move as the modifiers say."""

    accepts: ClassVar[tuple[type, ...]] = (
        *_SPEED_MODIFIERS,
        *_LANE_MODIFIERS,
        *_TURN_MODIFIERS,
        *(Along, PhysicalMovement),
    )


@action("vehicle", "drive", slots=(LONGITUDINAL, LATERAL), ends="open")
class Drive(Movement):
    """Drive as the modifiers say; without any, on in the lane at the present speed."""

    accepts: ClassVar[tuple[type, ...]] = (
        *_SPEED_MODIFIERS,
        *_LANE_MODIFIERS,
        *(Along, PhysicalMovement),
    )


@action("animal", "walk", slots=(LONGITUDINAL, LATERAL), ends="open")
@action("person", "walk", slots=(LONGITUDINAL, LATERAL), ends="open")
class Walk(Movement):
    """Walk as the modifiers say, straight on or along a path."""

    accepts: ClassVar[tuple[type, ...]] = (
        *(Speed, ChangeSpeed, KeepSpeed, Acceleration),
        *(Distance, KeepPosition, AvoidCollisions),
        *_TURN_MODIFIERS,
        *(Along, AlongTrajectory, PhysicalMovement),
    )
