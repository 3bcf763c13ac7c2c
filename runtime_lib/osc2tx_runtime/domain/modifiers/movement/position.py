"""Modifiers of the position (DSL 8.9.2, 8.9.3, 8.9.13, 8.7.4.1)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Literal

from osc2tx_runtime.domain.modifiers.base import Modifier, MovementModifier, Value, band_of, wanted
from osc2tx_runtime.domain.modifiers.registry import modifier
from osc2tx_runtime.domain.shapes import AnyPositionShape, OwnShape
from osc2tx_runtime.language.actions.modifier import COURSE
from osc2tx_runtime.language.actions.registry import LATERAL, LONGITUDINAL
from osc2tx_shared.classes import dataclass
from osc2tx_shared.rules import Sort, at_least, at_least_one, at_most_one, none_of

if TYPE_CHECKING:
    from osc2tx_runtime.domain.objects.physical_objects import PhysicalObject
    from osc2tx_runtime.domain.points_and_poses import Point, Pose
    from osc2tx_runtime.language.values.parameters import Range

REFERENCES = ("ahead_of", "behind", "ahead_of_point", "behind_point")

__all__ = ["Distance", "KeepPosition", "Location", "Position"]


@modifier(
    "position",
    slots=(LONGITUDINAL,),
    topics=(COURSE,),
    sorts=(
        Sort("place on the lane", lacks=("ahead_of", "behind"), excludes=("along",)),
        Sort(
            "course of the place",
            given=("shape",),
            excludes=(COURSE, "speed", "keep_speed", "acceleration", "distance"),
        ),
    ),
    lanes_only=True,
    while_moving=(none_of("at_point", when=["project_on_route"], values=["false"]),),
    placement=True,
    places=True,
    orders=("ahead_of", "behind"),
    amounts=("distance", "time", "distance_range", "time_range"),
)
@dataclass(frozen=True, slots=True)
class Position(MovementModifier):
    """Position along the road, or in the world.

    Attributes:
        distance: Metres ahead of or behind a reference, else from the start of the road.
        time: Instead of a distance: seconds times the speed of the follower.
        distance_range: Instead of a distance: its range at all times.
        time_range: Instead of a time: its range at all times.
        ahead_of: Reference.
        behind: Reference.
        ahead_of_point: Reference point in the world, projected on the road.
        behind_point: Likewise.
        at_point: Point in the world.
        x: World x (m).
        y: World y (m).
        z: World z (m).
        h: Heading (rad).
        project_on_route: `at_point` only states the road coordinate and the lane; False: the actor
            is at the point itself.
        frame: `carla`: left-handed, y and heading with the opposite sign, box centre.
        shape: Profile of the distance (without a reference: of the position along the road), and
            its value if none is given here.
    """

    shaped_by = AnyPositionShape
    rules = (
        at_most_one("ahead_of", "behind", "ahead_of_point", "behind_point"),
        at_most_one("distance", "time", "distance_range", "time_range", "at_point", "x"),
        at_least_one("distance", "time", "distance_range", "time_range", "at_point", "x", "shape"),
        at_most_one("shape", "time", "time_range"),
        none_of(*REFERENCES, when=["at_point", "x"]),
        at_least_one("ahead_of", "behind", when=["time", "time_range"]),
        at_least_one("y", when=["x"]),
        at_least_one("x", when=["y"]),
    )
    distance: Value | None = None
    time: Value | None = None
    distance_range: Range[float] | Callable[[], Range[float]] | None = None
    time_range: Range[float] | Callable[[], Range[float]] | None = None
    ahead_of: PhysicalObject | None = None
    behind: PhysicalObject | None = None
    ahead_of_point: Point | None = None
    behind_point: Point | None = None
    at_point: Point | None = None
    project_on_route: bool = True
    x: float | None = None
    y: float | None = None
    z: float | None = None
    h: float | None = None
    frame: Literal["world", "carla"] = "world"
    shape: AnyPositionShape | OwnShape[AnyPositionShape] | None = None

    @property
    def reference(self) -> PhysicalObject | None:
        """The actor it is relative to."""
        return self.ahead_of or self.behind

    @property
    def stands(self) -> bool:
        """True for a fixed position on the road at all times."""
        return self.at == "all" and self.reference is None and self.shape is None

    @property
    def reference_point(self) -> Point | None:
        """The point it is relative to."""
        return self.ahead_of_point or self.behind_point

    @property
    def ahead(self) -> bool:
        """True for a position ahead of its reference."""
        return self.ahead_of is not None or self.ahead_of_point is not None

    @property
    def timed(self) -> bool:
        """True if the distance is stated as a time."""
        return self.time is not None or self.time_range is not None

    def size(self) -> tuple[float, float]:
        """Least and greatest distance (m) or time (s) now; equal without a range."""
        if self.timed:
            return band_of(self.time, self.time_range)
        return wanted(self.distance, self.distance_range, self.shape)

    @property
    def absolute(self) -> bool:
        """True for a point in the world."""
        return self.at_point is not None or self.x is not None

    @property
    def is_on_road(self) -> bool:
        """True for a position along the road, without a reference."""
        return self.reference is None and self.reference_point is None and not self.absolute


@modifier("location", placement=True, places=True)
@dataclass(frozen=True, slots=True)
class Location(Modifier):
    """A fixed pose of the reference point, for stationary objects."""

    pose: Pose


@modifier("keep_position", slots=(LONGITUDINAL, LATERAL), topics=(COURSE,), paces=True)
@dataclass(frozen=True, slots=True)
class KeepPosition(Modifier):
    """The position in the world at the start of the action."""


@modifier(
    "distance",
    slots=(LONGITUDINAL,),
    sorts=(
        Sort(
            "course of the way",
            given=("shape",),
            excludes=(COURSE, "speed", "keep_speed", "acceleration", "distance"),
        ),
    ),
    no_start="is covered during the action, not at its start",
    paces=True,
    bounds=True,
)
@dataclass(frozen=True, slots=True)
class Distance(MovementModifier):
    """Distance (m) covered during the action, which ends then or covers it exactly in its duration.

    Attributes:
        distance: Metres.
        shape: Profile of the distance.
    """

    shaped_by = AnyPositionShape
    rules = (at_least(0, "distance", unless=["shape"]),)
    distance: Value
    shape: AnyPositionShape | OwnShape[AnyPositionShape] | None = None

    def way(self) -> float:
        """The metres to cover, now."""
        return wanted(self.distance, None, self.shape)[0]
