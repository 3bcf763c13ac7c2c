"""Gap and headway actions, relative to another actor (DSL 8.8.3.4 to 8.8.3.11).

Longitudinal gaps are measured between facing ends, lateral gaps between facing sides, headways
between fronts. A lateral time gap is the gap divided by the lateral approach speed.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar, Literal, Unpack, get_args

from osc2tx_runtime.domain.modifiers import Modifier, Value, value_of
from osc2tx_runtime.domain.modifiers.groups import SIDE_FREE, SPEED_FREE
from osc2tx_runtime.domain.planning.longitudinal.arrival_time import arrival
from osc2tx_runtime.domain.planning.motion_action import Refused
from osc2tx_runtime.enums import GapDirection, HeadwayDirection, RoadDistanceDirection
from osc2tx_runtime.errors import ScenarioError, UnsupportedError
from osc2tx_runtime.language.actions.action import ActionOptions
from osc2tx_runtime.language.actions.registry import LATERAL, LONGITUDINAL, action
from osc2tx_runtime.world.commands import Beside, KeepGap

from .modifiable import ModifiableAction

if TYPE_CHECKING:
    from osc2tx_runtime.domain.actors import Vehicle
    from osc2tx_runtime.domain.objects.physical_objects import PhysicalObject

_DIRECTIONS: tuple[GapDirection, ...] = get_args(GapDirection)


class _OneAxis(ModifiableAction):
    """Controls the speed or the lane; modifiers may constrain the other slot.

    Attributes:
        measure: Between facing ends, or between fronts.
        timed: Whether it is a time.
    """

    accepts: ClassVar[tuple[type, ...]] = (*SIDE_FREE, *SPEED_FREE)
    physical = True
    direction: str
    measure: Literal["gap", "headway"] = "gap"
    timed = False

    def __init__(
        self,
        actor: Vehicle,
        *modifiers: Modifier,
        reference: PhysicalObject,
        across: bool,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        self.vehicle = actor
        self.reference = reference
        if across:
            self.slots = (LATERAL,)

    def gap(self, size: float, *, ahead: bool) -> KeepGap:
        """The command for a longitudinal size (m or s)."""
        distance, time = (None, size) if self.timed else (size, None)
        return KeepGap(self.reference.id, ahead, self.measure, distance=distance, time=time)

    def beside(self, size: float, *, left: bool, duration: float | None = None) -> Beside:
        """The command for a lateral size (m or s)."""
        if self.timed:
            return Beside(self.reference.id, time=size)
        reach = 0.5 * (self.here.width + self.world.state(self.reference.id).width)
        place = size + reach if left else -size - reach
        return Beside(self.reference.id, place, duration=duration)

    def takes(self, modifier: Modifier) -> bool:
        """Whether the action can carry out a modifier."""
        free = self.accepts_with.get("direction", {}).get(self.direction, self.accepts)
        return super().takes(modifier) and isinstance(modifier, free)

    def setup(self, **kwargs: Any) -> None:
        """Checks what is known at this time."""
        super().setup(**kwargs)
        if self.may_jump:
            raise UnsupportedError(
                f"{self.action_name}: a distance to another actor cannot be reached"
                " instantaneously",
                self.source or None,
            )


class _ChangeGap(_OneAxis):
    """Reaches a distance or time to another actor, at the end of its duration if one is given."""

    accepts_with: ClassVar[Mapping[str, Mapping[str, tuple[type, ...]]]] = {
        "direction": {
            each: SIDE_FREE if each in ("ahead", "behind") else SPEED_FREE for each in _DIRECTIONS
        }
    }

    def __init__(
        self,
        actor: Vehicle,
        *modifiers: Modifier,
        target: Value,
        direction: GapDirection,
        reference: PhysicalObject,
        **options: Unpack[ActionOptions],
    ) -> None:
        across = direction not in ("ahead", "behind")
        super().__init__(actor, *modifiers, reference=reference, across=across, **options)
        if direction not in _DIRECTIONS:
            known = ", ".join(_DIRECTIONS)
            raise ScenarioError(
                f"{self.action_name}: direction `{direction}` is not one of {known}"
            )
        if self.measure == "headway" and across:
            raise ScenarioError(f"{self.action_name}: a headway is ahead or behind")
        self.target = target
        self.direction = direction

    def on_start(self) -> None:
        """Commands the gap; a negative gap is on the other side."""
        target = value_of(self.target)
        size = abs(target)
        if LATERAL in self.own:
            left = self._leads_left() == (target >= 0.0)
            gap = self.vehicle.space_gap(self.reference, "lateral")
            if self.timed and (gap == 0.0 or (gap > 0.0) != left):
                side = "left" if left else "right"
                raise Refused(f"it is not to the {side} of {self.reference.id}")
            command = self.beside(size, left=left, duration=self.fixed_duration())
            self.command(LATERAL, command)
            return
        ahead = (self.direction == "ahead") == (target >= 0.0)
        wanted = self.gap(size, ahead=ahead)
        self.command(LONGITUDINAL, arrival(self, wanted) or wanted)

    def situation(self) -> str:
        """Return the present distance in words."""
        unit = "s" if self.timed else "m"
        direction: RoadDistanceDirection = "lateral" if LATERAL in self.own else "longitudinal"
        kind = "time" if self.timed else "space"
        measure = getattr(self.vehicle, f"{kind}_{self.measure}")
        headway = self.measure == "headway"
        try:
            now = measure(self.reference) if headway else measure(self.reference, direction)
        except ScenarioError as error:
            return error.message
        return f"the {kind} {self.measure} is {abs(now):.2f} {unit}"

    def _leads_left(self) -> bool:
        """True if the direction is to the left of the reference."""
        if self.direction in ("left", "right"):
            return self.direction == "left"
        road = self.place_of(self.reference.id).road
        right_hand = self.world.map.roads[road].right_hand_traffic
        return (self.direction == "inside") == right_hand


@action("vehicle", "change_space_gap", slots=(LONGITUDINAL,), needs=("lanes",))
class ChangeSpaceGap(_ChangeGap):
    """Reach a space gap (m) between facing ends or sides, in a direction from the reference."""


@action("vehicle", "change_time_gap", slots=(LONGITUDINAL,), needs=("lanes",))
class ChangeTimeGap(_ChangeGap):
    """Reach a time gap (s) between facing ends at the speed of the follower, or between sides."""

    timed = True


class _ChangeHeadway(_ChangeGap):
    """Reaches a headway, as a distance or time."""

    measure = "headway"

    def __init__(
        self,
        actor: Vehicle,
        *modifiers: Modifier,
        target: Value,
        direction: HeadwayDirection,
        reference: PhysicalObject,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(
            actor, *modifiers, target=target, direction=direction, reference=reference, **options
        )


@action("vehicle", "change_space_headway", slots=(LONGITUDINAL,), needs=("lanes",))
class ChangeSpaceHeadway(_ChangeHeadway):
    """Reach a space headway (m) between fronts, `ahead` of or `behind` the reference."""


@action("vehicle", "change_time_headway", slots=(LONGITUDINAL,), needs=("lanes",))
class ChangeTimeHeadway(_ChangeHeadway):
    """Reach a time headway (s) between fronts, at the speed of the follower."""

    timed = True


class _KeepGap(_OneAxis):
    """Holds the distance or time to another actor at the start."""

    accepts_with: ClassVar[Mapping[str, Mapping[str, tuple[type, ...]]]] = {
        "direction": {"": SIDE_FREE, "longitudinal": SIDE_FREE, "lateral": SPEED_FREE}
    }

    def __init__(
        self,
        actor: Vehicle,
        *modifiers: Modifier,
        reference: PhysicalObject,
        direction: RoadDistanceDirection = "longitudinal",
        **options: Unpack[ActionOptions],
    ) -> None:
        across = direction == "lateral"
        super().__init__(actor, *modifiers, reference=reference, across=across, **options)
        if direction not in ("longitudinal", "lateral"):
            raise ScenarioError(
                f"{self.action_name}: direction `{direction}` is neither longitudinal nor lateral"
            )
        self.direction: RoadDistanceDirection = direction

    def on_start(self) -> None:
        """Samples the gap and commands it."""
        try:
            size = self._sampled()
        except ScenarioError as error:
            raise Refused(error.message) from error
        if math.isinf(size):
            along = self.direction == "longitudinal"
            why = "the follower is at standstill" if along else "the distance does not decrease"
            raise Refused(f"there is no time gap between the actors: {why}")
        if self.direction == "lateral":
            self.command(LATERAL, self.beside(abs(size), left=size >= 0.0))
        else:
            self.command(LONGITUDINAL, self.gap(abs(size), ahead=size >= 0.0))

    def _sampled(self) -> float:
        """The present size; positive if the actor is ahead."""
        me, other = self.vehicle, self.reference
        if self.measure == "gap":
            if me.space_gap(other, self.direction) == 0.0:
                where = "beside" if self.direction == "longitudinal" else "in the lane of"
                raise Refused(f"{me.id} is {where} {other.id}, so there is no gap to keep")
            read = me.time_gap if self.timed else me.space_gap
            return read(other, self.direction)
        return -(me.time_headway(other) if self.timed else me.space_headway(other))


@action("vehicle", "keep_space_gap", slots=(LONGITUDINAL,), ends="open", needs=("lanes",))
class KeepSpaceGap(_KeepGap):
    """Hold the present space gap between facing ends or sides."""


@action("vehicle", "keep_time_gap", slots=(LONGITUDINAL,), ends="open", needs=("lanes",))
class KeepTimeGap(_KeepGap):
    """Hold the present time gap between facing ends or sides."""

    timed = True


class _KeepHeadway(_KeepGap):
    """Holds a headway, as a distance or time."""

    measure = "headway"

    def __init__(
        self,
        actor: Vehicle,
        *modifiers: Modifier,
        reference: PhysicalObject,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, *modifiers, reference=reference, **options)


@action("vehicle", "keep_space_headway", slots=(LONGITUDINAL,), ends="open", needs=("lanes",))
class KeepSpaceHeadway(_KeepHeadway):
    """Hold the present space headway between fronts."""


@action("vehicle", "keep_time_headway", slots=(LONGITUDINAL,), ends="open", needs=("lanes",))
class KeepTimeHeadway(_KeepHeadway):
    """Hold the present time headway between fronts."""

    timed = True
