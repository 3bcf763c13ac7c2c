"""Gaps and headways to another actor (DSL 8.8.3.4 to 8.8.3.11), along the road.

Gaps count from end to end, headways from front to front. Lateral gaps are not there yet.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Literal, Unpack

from osc2tx_runtime.action import ActionOptions
from osc2tx_runtime.behaviour.base import Status
from osc2tx_runtime.errors import ScenarioError, UnsupportedError
from osc2tx_runtime.modifiers import Modifier, Value, value_of
from osc2tx_runtime.registry import LONGITUDINAL, action
from osc2tx_runtime.world.commands import KeepGap

from .support import MotionAction

if TYPE_CHECKING:
    from osc2tx_runtime.actors import Vehicle

__all__ = [
    "ChangeSpaceGap",
    "ChangeSpaceHeadway",
    "ChangeTimeGap",
    "ChangeTimeHeadway",
    "KeepSpaceGap",
    "KeepSpaceHeadway",
    "KeepTimeGap",
    "KeepTimeHeadway",
]

GapDirection = Literal["ahead", "behind", "left", "right", "inside", "outside"]
HeadwayDirection = Literal["ahead", "behind"]


class _ChangeGap(MotionAction):
    """Reaches a distance or time to another actor."""

    measure: Literal["gap", "headway"] = "gap"
    timed = False

    def __init__(
        self,
        actor: Vehicle,
        *modifiers: Modifier,
        target: Value,
        direction: GapDirection,
        reference: Vehicle,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        if direction not in ("ahead", "behind"):
            raise UnsupportedError(f"{self.action_name}: direction {direction} is not there yet")
        self.target = target
        self.ahead = direction == "ahead"
        self.reference = reference

    def on_start(self) -> None:
        """Commands the gap; a negative one is on the other side."""
        target = value_of(self.target)
        ahead = self.ahead if target >= 0.0 else not self.ahead
        size = abs(target)
        self.command(
            LONGITUDINAL,
            KeepGap(
                self.reference.id,
                ahead,
                self.measure,
                distance=None if self.timed else size,
                time=size if self.timed else None,
            ),
        )


@action("vehicle", "change_space_gap", slots=(LONGITUDINAL,))
class ChangeSpaceGap(_ChangeGap):
    """Reach a space (m) between facing ends, `ahead` of or `behind` the reference."""


@action("vehicle", "change_time_gap", slots=(LONGITUDINAL,))
class ChangeTimeGap(_ChangeGap):
    """Reach a time (s) between facing ends, at the speed of the one behind."""

    timed = True


@action("vehicle", "change_space_headway", slots=(LONGITUDINAL,))
class ChangeSpaceHeadway(_ChangeGap):
    """Reach a distance (m) between fronts, `ahead` of or `behind` the reference."""

    measure = "headway"


@action("vehicle", "change_time_headway", slots=(LONGITUDINAL,))
class ChangeTimeHeadway(_ChangeGap):
    """Reach a time (s) between fronts, at the speed of the one behind."""

    measure = "headway"
    timed = True


class _KeepGap(MotionAction):
    """Holds the distance or time to another actor that there is at the start."""

    measure: Literal["gap", "headway"] = "gap"
    timed = False

    def __init__(
        self,
        actor: Vehicle,
        *modifiers: Modifier,
        reference: Vehicle,
        direction: Literal["longitudinal", "lateral"] = "longitudinal",
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        if direction != "longitudinal":
            raise UnsupportedError(f"{self.action_name}: direction {direction} is not there yet")
        self.vehicle = actor
        self.reference = reference
        self._undefined = False

    def on_start(self) -> None:
        """Samples the gap and commands it."""
        size = self._sampled()
        self._undefined = math.isinf(size)
        if self._undefined:
            return
        self.command(
            LONGITUDINAL,
            KeepGap(
                self.reference.id,
                size >= 0.0,
                self.measure,
                distance=None if self.timed else abs(size),
                time=abs(size) if self.timed else None,
            ),
        )

    def on_update(self) -> Status:
        """Runs on, unless there is nothing to hold."""
        if self._undefined:
            return self.fail("there is no time between actors of which the trailing one stands")
        return super().on_update()

    def _sampled(self) -> float:
        """The present size; positive if the actor is ahead."""
        me, other = self.vehicle, self.reference
        if self.measure == "gap":
            if me.space_gap(other, "longitudinal") == 0.0:
                raise ScenarioError(
                    f"{me.id} is beside {other.id}, so there is no gap to keep", self.source
                )
            read = me.time_gap if self.timed else me.space_gap
            return read(other, "longitudinal")
        return -(me.time_headway(other) if self.timed else me.space_headway(other))


@action("vehicle", "keep_space_gap", slots=(LONGITUDINAL,), ends="open")
class KeepSpaceGap(_KeepGap):
    """Hold the present space between facing ends."""


@action("vehicle", "keep_time_gap", slots=(LONGITUDINAL,), ends="open")
class KeepTimeGap(_KeepGap):
    """Hold the present time between facing ends."""

    timed = True


@action("vehicle", "keep_space_headway", slots=(LONGITUDINAL,), ends="open")
class KeepSpaceHeadway(_KeepGap):
    """Hold the present distance between fronts."""

    measure = "headway"


@action("vehicle", "keep_time_headway", slots=(LONGITUDINAL,), ends="open")
class KeepTimeHeadway(_KeepGap):
    """Hold the present time between fronts."""

    measure = "headway"
    timed = True
