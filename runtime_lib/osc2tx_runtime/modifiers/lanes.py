"""Modifiers of the lane and of the place across it (DSL 8.9.8, 8.9.14 to 8.9.16)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from osc2tx_runtime.errors import ScenarioError

from .base import At, Modifier, Side, Value, at_most_one, value_of

if TYPE_CHECKING:
    from osc2tx_runtime.actors import PhysicalObject, Vehicle

LatMeasure = Literal[
    "left_to_left",
    "left_to_center",
    "left_to_right",
    "center_to_left",
    "center_to_center",
    "center_to_right",
    "right_to_left",
    "right_to_center",
    "right_to_right",
    "closest",
]
_EDGE = {"left": 0.5, "center": 0.0, "right": -0.5}  # of the width, to the left

__all__ = ["ChangeLane", "KeepLane", "Lane", "LatMeasure", "Lateral"]


@dataclass(frozen=True, slots=True)
class Lane(Modifier):
    """A lane.

    Attributes:
        lane: Number counted from one edge of the road, or lanes beside a reference.
        same_as: Actor whose lane it is.
        side_of: Actor beside whose lane it is.
        side: On which side of it.
        from_: Edge from which lanes are counted, in direction of travel; the outermost is 1.
        at: When it holds.
    """

    name = "lane"
    lane: int | None = None
    same_as: PhysicalObject | None = None
    side_of: PhysicalObject | None = None
    side: Side | None = None
    from_: Side = "right"
    at: At = "all"

    def __post_init__(self) -> None:
        at_most_one("lane: same_as, side_of", self.same_as, self.side_of)
        if self.side_of is not None and self.side is None:
            raise ScenarioError("lane: side_of needs a side, left or right")
        if self.number < (0 if self.side_of is not None else 1):
            raise ScenarioError(f"lane: {self.number} is no lane; the outermost one is 1")

    @property
    def number(self) -> int:
        """Number of the lane; 1 if none is given."""
        return 1 if self.lane is None else self.lane

    @property
    def reference(self) -> PhysicalObject | None:
        """The actor it is relative to."""
        return self.same_as or self.side_of


@dataclass(frozen=True, slots=True)
class Lateral(Modifier):
    """Place across the lane, or beside another actor.

    Attributes:
        distance: Metres to the left, unless `side` says right.
        side_of: Actor from which the distance counts; None: the centre of the lane.
        side: To which side the distance points.
        measure_by: Own edge `to` edge of the reference (of the lane without `side_of`); `closest`:
            between the facing sides.
        at: When it holds.
    """

    name = "lateral"
    distance: Value = 0.0
    side_of: Vehicle | None = None
    side: Side = "left"
    measure_by: LatMeasure = "center_to_center"
    at: At = "all"

    @property
    def reference(self) -> Vehicle | None:
        """The actor it is relative to."""
        return self.side_of

    def offset(self, own_width: float = 0.0, other_width: float = 0.0) -> float:
        """How far (m) the own centre is to be left of that of the reference, now.

        Args:
            own_width: Width of the actor (m).
            other_width: Width of the reference or of the lane (m).
        """
        value = value_of(self.distance)
        left = -value if self.side == "right" else value
        if self.measure_by == "closest":
            reach = 0.5 * (own_width + other_width)
            return left + (reach if left > 0.0 or (left == 0.0 and self.side == "left") else -reach)
        own, _, other = self.measure_by.split("_")
        return left + _EDGE[other] * other_width - _EDGE[own] * own_width


@dataclass(frozen=True, slots=True)
class ChangeLane(Modifier):
    """Lanes to the side of the lane at the start of the action; no side: drawn from the seed."""

    name = "change_lane"
    lane: int = 1
    side: Side | None = None
    at: At = "all"


@dataclass(frozen=True, slots=True)
class KeepLane(Modifier):
    """The lane at the start of the action."""

    name = "keep_lane"
