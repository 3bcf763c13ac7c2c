"""Movement modifiers: how an action is to be carried out, or where an actor starts.

Each is a small value with the parameters of the DSL in their order. Numbers are SI floats, or
functions that are called when the action starts. `MODIFIERS` lists all that have an effect.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Literal

from osc2tx_runtime.errors import ScenarioError, UnsupportedError

if TYPE_CHECKING:
    from osc2tx_runtime.actors import PhysicalObject
    from osc2tx_runtime.values import Point, Pose
    from osc2tx_runtime.world.profiles import DynamicProfile

__all__ = [
    "MODIFIERS",
    "At",
    "Modifier",
    "Side",
    "Value",
    "acceleration",
    "change_lane",
    "change_speed",
    "keep_lane",
    "keep_speed",
    "lane",
    "lateral",
    "location",
    "orientation",
    "physical_movement",
    "position",
    "speed",
    "value_of",
    "yaw",
]

Value = float | Callable[[], float]
Side = Literal["left", "right"]
At = Literal["start", "end", "all"]


def value_of(value: Value) -> float:
    """The number now."""
    return float(value()) if callable(value) else float(value)


def _at_most_one(what: str, *given: object) -> None:
    if sum(value is not None for value in given) > 1:
        raise ScenarioError(f"{what}: give at most one of them")


def _upright(what: str, pitch: float | None, roll: float | None) -> None:
    if pitch or roll:
        raise UnsupportedError(f"{what}: pitch and roll are not there yet")


@dataclass(frozen=True, slots=True)
class Modifier:
    """Base of all modifiers.

    Attributes:
        name: Name in the DSL.
    """

    name: ClassVar[str] = ""


@dataclass(frozen=True, slots=True)
class Speed(Modifier):
    """Speed, absolute or relative to another actor.

    Attributes:
        speed: Speed, or difference to the reference (m/s); subtracted for `slower_than`.
        faster_than: Reference.
        slower_than: Reference.
        same_as: Reference.
        factor: Multiplies the speed of the reference.
        rate_profile: Course of the acceleration.
        rate_peak: Peak of the acceleration (m/s^2).
        at: When it holds.
    """

    name = "speed"
    speed: Value | None = None
    faster_than: PhysicalObject | None = None
    slower_than: PhysicalObject | None = None
    same_as: PhysicalObject | None = None
    factor: float = 1.0
    rate_profile: DynamicProfile = "none"
    rate_peak: float | None = None
    at: At = "all"

    def __post_init__(self) -> None:
        _at_most_one(
            "speed: faster_than, slower_than, same_as",
            self.faster_than,
            self.slower_than,
            self.same_as,
        )
        if self.speed is None and self.reference is None:
            raise ScenarioError("speed: give a speed or a reference")

    @property
    def reference(self) -> PhysicalObject | None:
        """The actor it is relative to."""
        return self.faster_than or self.slower_than or self.same_as

    def difference(self) -> float:
        """Signed value (m/s) now: the speed, or what is added to that of the reference."""
        value = 0.0 if self.speed is None else value_of(self.speed)
        return -value if self.slower_than is not None else value


@dataclass(frozen=True, slots=True)
class ChangeSpeed(Modifier):
    """Speed relative to that at the start of the action (m/s)."""

    name = "change_speed"
    speed: Value = 0.0


@dataclass(frozen=True, slots=True)
class KeepSpeed(Modifier):
    """The speed at the start of the action."""

    name = "keep_speed"


@dataclass(frozen=True, slots=True)
class Acceleration(Modifier):
    """Rate of change of the speed (m/s^2); to a speed if one is given as well."""

    name = "acceleration"
    acceleration: Value = 0.0


@dataclass(frozen=True, slots=True)
class Position(Modifier):
    """Place along the road, or in the world.

    Attributes:
        distance: Metres ahead of or behind a reference, else from the start of the road.
        time: Seconds times the speed of the one behind, instead of a distance.
        ahead_of: Reference.
        behind: Reference.
        at_point: Point in the world.
        x: World x (m).
        y: World y (m).
        z: World z (m).
        h: Heading (rad).
        project_on_route: `at_point` only says how far along the road and on which lane; False:
            the actor is at the point itself.
        frame: `carla`: left-handed, y and heading with the opposite sign, box centre.
        at: When it holds.
    """

    name = "position"
    distance: Value | None = None
    time: Value | None = None
    ahead_of: PhysicalObject | None = None
    behind: PhysicalObject | None = None
    at_point: Point | None = None
    project_on_route: bool = True
    x: float | None = None
    y: float | None = None
    z: float | None = None
    h: float | None = None
    frame: Literal["world", "carla"] = "world"
    at: At = "all"

    def __post_init__(self) -> None:
        _at_most_one("position: ahead_of, behind", self.ahead_of, self.behind)
        _at_most_one(
            "position: distance, time, at_point, x", self.distance, self.time, self.at_point, self.x
        )
        if self.distance is None and self.time is None and not self.absolute:
            raise ScenarioError("position: give a distance, a time or a point")
        if self.time is not None and self.reference is None:
            raise ScenarioError("position: a time needs ahead_of or behind")
        if (self.x is None) != (self.y is None):
            raise ScenarioError("position: give both x and y")

    @property
    def reference(self) -> PhysicalObject | None:
        """The actor it is relative to."""
        return self.ahead_of or self.behind

    @property
    def absolute(self) -> bool:
        """True for a point in the world."""
        return self.at_point is not None or self.x is not None


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
        _at_most_one("lane: same_as, side_of", self.same_as, self.side_of)
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
    """Offset from the centre of the lane (m), to the left unless `side` says right."""

    name = "lateral"
    distance: Value = 0.0
    side: Side = "left"

    def offset(self) -> float:
        """Offset (m) to the left, now."""
        value = value_of(self.distance)
        return -value if self.side == "right" else value


@dataclass(frozen=True, slots=True)
class ChangeLane(Modifier):
    """Lanes to the side of the lane at the start of the action."""

    name = "change_lane"
    lane: int = 1
    side: Side | None = None


@dataclass(frozen=True, slots=True)
class KeepLane(Modifier):
    """The lane at the start of the action."""

    name = "keep_lane"


@dataclass(frozen=True, slots=True)
class Yaw(Modifier):
    """Heading (rad) against the road, or against another actor.

    Attributes:
        angle: Counter-clockwise.
        relative_to: Reference; None: the road.
        measure_by: What the angle is measured against; only these two have an effect.
    """

    name = "yaw"
    angle: Value
    relative_to: PhysicalObject | None = None
    measure_by: Literal["relative_to_road", "relative_to_north"] = "relative_to_road"


@dataclass(frozen=True, slots=True)
class Orient(Modifier):
    """Heading (rad) in the world, or against another actor.

    Attributes:
        yaw: Counter-clockwise.
        pitch: Only 0: actors stand upright on the road.
        roll: Only 0.
        relative_to: Reference; None: the world.
    """

    name = "orientation"
    yaw: Value | None = None
    pitch: float | None = None
    roll: float | None = None
    relative_to: PhysicalObject | None = None

    def __post_init__(self) -> None:
        _upright("orientation", self.pitch, self.roll)
        if self.yaw is None:
            raise ScenarioError("orientation: give a yaw")


@dataclass(frozen=True, slots=True)
class Location(Modifier):
    """A fixed pose of the reference point, for objects that never move."""

    name = "location"
    pose: Pose

    def __post_init__(self) -> None:
        _upright("location", self.pose.pitch, self.pose.roll)


@dataclass(frozen=True, slots=True)
class PhysicalMovement(Modifier):
    """Whether a quantity may jump to its value."""

    name = "physical_movement"
    option: Literal["prefer_physical", "prefer_non_physical", "must_be_physical"] = (
        "must_be_physical"
    )


speed = Speed
change_speed = ChangeSpeed
keep_speed = KeepSpeed
acceleration = Acceleration
position = Position
lane = Lane
lateral = Lateral
change_lane = ChangeLane
keep_lane = KeepLane
yaw = Yaw
orientation = Orient
location = Location
physical_movement = PhysicalMovement

MODIFIERS: dict[str, type[Modifier]] = {
    each.name: each
    for each in (
        Speed,
        ChangeSpeed,
        KeepSpeed,
        Acceleration,
        Position,
        Lane,
        Lateral,
        ChangeLane,
        KeepLane,
        Yaw,
        Orient,
        Location,
        PhysicalMovement,
    )
}
"""Modifiers that have an effect, by their name in the DSL."""
