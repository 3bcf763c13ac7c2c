"""What an action asks of a world: frozen values, one per slot.

A world takes a command over at the step it first sees the object and pursues it until another
one (or None) comes. Worlds that cannot pursue a command say so in `World.capabilities()`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from osc2tx_runtime.opendrive import LanePosition

from .curve import Curve
from .profiles import DynamicProfile

__all__ = [
    "Accelerate",
    "AccelerationChange",
    "Arrive",
    "Beside",
    "Careful",
    "Command",
    "FollowCourse",
    "FollowRoute",
    "FollowSpeed",
    "GapMeasure",
    "KeepGap",
    "KeepLane",
    "KeepSchedule",
    "LaneChange",
    "LaneOffset",
    "ReplayCourse",
    "ReplayTrajectory",
    "Sideways",
    "Slant",
    "SpeedChange",
    "Standstill",
    "Turn",
]

GapMeasure = Literal["gap", "headway", "reference"]


@dataclass(frozen=True, slots=True, eq=False)
class Command:
    """Base of all commands. Two commands are the same only if they are one object."""


@dataclass(frozen=True, slots=True, eq=False)
class SpeedChange(Command):
    """Longitudinal: reach a speed, then hold it.

    Attributes:
        target: Speed (m/s).
        profile: Shape of the acceleration.
        rate_peak: Its peak (m/s^2); None: from the duration or the limits of the actor.
        duration: Length of the change (s); None: from the peak.
        start: Speed to begin with (m/s), at once; None: the present one.
    """

    target: float
    profile: DynamicProfile = "none"
    rate_peak: float | None = None
    duration: float | None = None
    start: float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Accelerate(Command):
    """Longitudinal: a constant acceleration (m/s^2); ends at standstill.

    Attributes:
        acceleration: m/s^2; None: the present one.
        start: Speed to begin with (m/s), at once; None: the present one.
    """

    acceleration: float | None
    start: float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class AccelerationChange(Command):
    """Longitudinal: reach an acceleration, then hold it; ends at standstill.

    Attributes:
        target: Acceleration (m/s^2).
        profile: Shape of the jerk.
        rate_peak: Its peak (m/s^3); None: from the duration or the limits of the actor.
        duration: Length of the change (s); None: from the peak.
        start: Acceleration to begin with (m/s^2); None: the present one.
    """

    target: float
    profile: DynamicProfile = "none"
    rate_peak: float | None = None
    duration: float | None = None
    start: float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Careful(Command):
    """Longitudinal: another command, but never so fast as to run into what is ahead.

    Attributes:
        course: What to do with a free road; None: hold the speed.
        headway: Seconds to keep behind what is ahead.
        gap: Metres to keep behind it at standstill.
    """

    course: Command | None
    headway: float = 1.5
    gap: float = 2.0


@dataclass(frozen=True, slots=True, eq=False)
class KeepSchedule(Command):
    """Longitudinal: be along a curve over time when it says so, as the limits allow.

    Attributes:
        curve: Its parameter is the time (s).
        begin: Time on it at which the command starts (s).
        end: Time at which it ends (s).
    """

    curve: Curve
    begin: float
    end: float


@dataclass(frozen=True, slots=True, eq=False)
class FollowSpeed(Command):
    """Longitudinal: speed of another actor times `factor` plus `difference` (m/s).

    Attributes:
        reference: The other actor.
        factor: Multiplies its speed.
        difference: Least difference (m/s).
        spread: How much more (m/s) the difference may be.
    """

    reference: str
    factor: float = 1.0
    difference: float = 0.0
    spread: float = 0.0


@dataclass(frozen=True, slots=True, eq=False)
class KeepGap(Command):
    """Longitudinal: reach and hold a distance to another actor.

    Attributes:
        reference: The other actor.
        ahead: True if this actor is to be ahead of it.
        measure: Between facing ends ("gap"), fronts ("headway") or reference points.
        distance: Metres; exclusive with `time`.
        time: Seconds times the speed of the trailing one.
        spread: How much more (m or s) it may be.
        projected: The other one counts as if it went on as it does at the start.
    """

    reference: str
    ahead: bool
    measure: GapMeasure = "gap"
    distance: float | None = None
    time: float | None = None
    spread: float = 0.0
    projected: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Arrive(Command):
    """Longitudinal: be somewhere after a time, at a speed of its own if one is given.

    Attributes:
        duration: Seconds.
        way: Metres to cover until then; exclusive with `gap`.
        gap: Place relative to another actor.
        speed: Speed at the end: a number (m/s), or relative to an actor; None: any.
    """

    duration: float
    way: float | None = None
    gap: KeepGap | None = None
    speed: float | FollowSpeed | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Standstill(Command):
    """Longitudinal: brake as hard as the limits allow, then stand."""


@dataclass(frozen=True, slots=True, eq=False)
class KeepLane(Command):
    """Lateral: stay in the lane at the present offset."""


@dataclass(frozen=True, slots=True, eq=False)
class LaneChange(Command):
    """Lateral: end in another lane.

    Attributes:
        lanes: Drivable lanes to the left (negative: to the right) of the present one.
        offset: Metres left of the centre of the target lane at the end.
        profile: Shape of the lateral speed.
        rate_peak: Its peak (m/s).
        duration: Length of the change (s).
    """

    lanes: int
    offset: float = 0.0
    profile: DynamicProfile = "none"
    rate_peak: float | None = None
    duration: float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class LaneOffset(Command):
    """Lateral: reach and hold an offset (m, left positive) in the present lane."""

    offset: float
    profile: DynamicProfile = "none"
    rate_peak: float | None = None
    duration: float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Turn(Command):
    """Lateral, actors off the lanes only: take a heading (rad, world)."""

    heading: float


@dataclass(frozen=True, slots=True, eq=False)
class Sideways(Command):
    """Lateral: a constant speed (m/s) to the left across the lane."""

    speed: float


@dataclass(frozen=True, slots=True, eq=False)
class Slant(Command):
    """Lateral: a heading (rad) against the lane, counter-clockwise."""

    angle: float


@dataclass(frozen=True, slots=True, eq=False)
class Beside(Command):
    """Lateral: reach and hold a distance across the lane to another actor.

    Attributes:
        reference: The other actor.
        left: Metres that the own reference point is to be left of the other one.
        time: Instead: seconds in which the sides would meet at the lateral speed; the actor
            approaches the reference with the gap over this time.
        spread: How many metres more to the left it may be.
        projected: The other one counts as if it went on as it does at the start.
        duration: Seconds after which the distance is to be reached; None: as is comfortable.
    """

    reference: str
    left: float | None = None
    time: float | None = None
    spread: float = 0.0
    projected: bool = False
    duration: float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class FollowCourse(Command):
    """Lateral: leave the lanes and steer along a curve, as the limits allow.

    Attributes:
        curve: Where to.
        begin: Arc length on it at which to begin (m).
        end: Arc length at which the goal is reached (m).
    """

    curve: Curve
    begin: float
    end: float


@dataclass(frozen=True, slots=True, eq=False)
class FollowRoute(Command):
    """Lateral: stay in the lane, and take the branches that lead to a place.

    Attributes:
        goal: The place; any lane beside it will do.
    """

    goal: LanePosition


@dataclass(frozen=True, slots=True, eq=False)
class ReplayCourse(Command):
    """Lateral: be on a curve exactly, at the own speed; attributes as of `FollowCourse`."""

    curve: Curve
    begin: float
    end: float


@dataclass(frozen=True, slots=True, eq=False)
class ReplayTrajectory(Command):
    """Both slots: be on a curve over time exactly; attributes as of `KeepSchedule`."""

    curve: Curve
    begin: float
    end: float
