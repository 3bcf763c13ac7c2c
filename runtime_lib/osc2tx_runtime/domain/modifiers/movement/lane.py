"""Modifiers of the lane and of the lateral position (DSL 8.9.8, 8.9.14 to 8.9.16)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from osc2tx_runtime.domain.modifiers.base import (
    Late,
    Modifier,
    MovementModifier,
    Value,
    now,
    wanted,
)
from osc2tx_runtime.domain.modifiers.registry import modifier
from osc2tx_runtime.domain.shapes import AnyLateralShape, OwnShape
from osc2tx_runtime.enums import LatMeasureBy, SideLeftRight
from osc2tx_runtime.language.actions.modifier import LANE, SIDE
from osc2tx_runtime.language.actions.registry import LATERAL
from osc2tx_shared.classes import dataclass
from osc2tx_shared.rules import Sort, at_least, at_least_one, at_most_one

if TYPE_CHECKING:
    from osc2tx_runtime.domain.objects.physical_objects import PhysicalObject
    from osc2tx_runtime.language.values.parameters import Range

_EDGE = {"left": 0.5, "center": 0.0, "right": -0.5}  # of the width, to the left

__all__ = ["ChangeLane", "KeepLane", "Lane", "Lateral"]


@modifier(
    "lane",
    slots=(LATERAL,),
    topics=(LANE,),
    lanes_only=True,
    placement=True,
    places=True,
    needs=("lanes",),
)
@dataclass(frozen=True, slots=True)
class Lane(MovementModifier):
    """A lane.

    Attributes:
        lane: Number counted from one edge of the road, or lanes beside a reference.
        same_as: Actor whose lane it is.
        side_of: Actor from whose lane the lanes are counted.
        side: Side of that lane.
        from_: Edge from which lanes are counted, in direction of travel; the outermost is 1.
        shape: Profile of the lateral position (m to the left of the lane centre) until it is
            reached.
    """

    shaped_by = AnyLateralShape
    rules = (
        at_most_one("same_as", "side_of", "from_"),
        at_most_one("same_as", "lane"),
        at_least_one("side", when=["side_of"]),
        at_least_one("side_of", when=["side"]),
        at_least(1, "lane", unless=["side_of"]),  # the outermost one is 1
        at_least(0, "lane", when=["side_of"]),
    )
    lane: int | Callable[[], int] | None = None
    same_as: PhysicalObject | None = None
    side_of: PhysicalObject | None = None
    side: Late[SideLeftRight] | None = None
    from_: Late[SideLeftRight] = "right"
    shape: AnyLateralShape | OwnShape[AnyLateralShape] | None = None

    @property
    def number(self) -> int:
        """Number of the lane; 1 if none is given."""
        return 1 if self.lane is None else int(now(self.lane))

    @property
    def edge(self) -> SideLeftRight:
        """Edge from which lanes are counted, now."""
        return now(self.from_)

    @property
    def reference(self) -> PhysicalObject | None:
        """The actor it is relative to."""
        return self.same_as or self.side_of


@modifier(
    "lateral",
    slots=(LATERAL,),
    topics=(SIDE,),
    sorts=(Sort("place beside an actor", given=("side_of",), excludes=(LANE,)),),
    lanes_only=True,
    placement=True,
    places=True,
    needs=("lanes",),
)
@dataclass(frozen=True, slots=True)
class Lateral(MovementModifier):
    """Lateral position in the lane, or relative to another actor.

    Attributes:
        distance: Metres to the left, unless `side` is right.
        distance_range: Instead of the value: its range at all times.
        side_of: Actor from which the distance counts; None: the centre of the lane.
        side: Side to which the distance points.
        measure_by: Own edge `to` edge of the reference (of the lane without `side_of`); `closest`:
            between the facing sides.
        shape: Profile of the distance, and its value if none is given here.
    """

    shaped_by = AnyLateralShape
    rules = (
        at_most_one("distance", "distance_range"),
        at_least_one("distance", "distance_range", "shape"),
        at_least_one("side_of", when=["measure_by"], values=["closest"]),
    )
    distance: Value | None = None
    distance_range: Range[float] | Callable[[], Range[float]] | None = None
    side_of: PhysicalObject | None = None
    side: Late[SideLeftRight] = "left"
    measure_by: Late[LatMeasureBy] = "center_to_center"
    shape: AnyLateralShape | OwnShape[AnyLateralShape] | None = None

    @property
    def reference(self) -> PhysicalObject | None:
        """The actor it is relative to."""
        return self.side_of

    @property
    def is_fixed(self) -> bool:
        """Whether it states a single distance."""
        return self.distance_range is None

    def offsets(
        self, own_width: float = 0.0, other_width: float = 0.0, *, oncoming: bool = False
    ) -> tuple[float, float]:
        """Range (m) of the own centre to the left of the centre of the reference, now.

        Args:
            own_width: Width of the actor (m).
            other_width: Width of the reference or of the lane (m).
            oncoming: Whether the reference is oncoming: its sides are seen from the reference.

        Returns:
            The least and the greatest value; equal without a range.
        """
        low, high = wanted(self.distance, self.distance_range, self.shape)
        ends = [self.place(value, own_width, other_width, oncoming) for value in (low, high)]
        return min(ends), max(ends)

    def offset(self, own_width: float, other_width: float, now: float) -> float:
        """The allowed offset (m) nearest to the present one; arguments as above."""
        low, high = self.offsets(own_width, other_width)
        return min(max(now, low), high)

    def place(
        self, value: float, own_width: float, other_width: float, oncoming: bool = False
    ) -> float:
        """Offset (m) of the own centre to the left of the reference at a distance.

        See `offsets`.
        """
        side, measure_by = now(self.side), now(self.measure_by)
        left = -value if side == "right" else value
        if measure_by == "closest":
            reach = 0.5 * (own_width + other_width)
            left += reach if left > 0.0 or (left == 0.0 and side == "left") else -reach
            return -left if oncoming else left
        own, _, other = measure_by.split("_")
        left += _EDGE[other] * other_width
        return -left - _EDGE[own] * own_width if oncoming else left - _EDGE[own] * own_width


@modifier(
    "change_lane",
    slots=(LATERAL,),
    topics=(LANE,),
    no_start="cannot change the lane at the start",
    lanes_only=True,
    bounds=True,
    needs=("lanes",),
)
@dataclass(frozen=True, slots=True)
class ChangeLane(MovementModifier):
    """Number of lanes beside the lane at the start of the action.

    Attributes:
        lane: Number of lanes.
        side: Side; None: drawn from the seed.
        shape: As of `lane`.
    """

    shaped_by = AnyLateralShape
    lane: int | Callable[[], int] = 1
    side: Late[SideLeftRight] | None = None
    shape: AnyLateralShape | OwnShape[AnyLateralShape] | None = None

    @property
    def number(self) -> int:
        """Number of lanes, now."""
        return int(now(self.lane))


@modifier("keep_lane", slots=(LATERAL,), topics=(LANE,), lanes_only=True, needs=("lanes",))
@dataclass(frozen=True, slots=True)
class KeepLane(Modifier):
    """The lane at the start of the action."""
