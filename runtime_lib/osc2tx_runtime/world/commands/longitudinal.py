"""Commands of the longitudinal slot."""

from __future__ import annotations

from typing import Literal

from osc2tx_runtime.enums import DynamicProfile
from osc2tx_runtime.world.geometry.curve import Curve
from osc2tx_runtime.world.geometry.profiles import Profile
from osc2tx_shared.classes import dataclass

from .base import Command

GapMeasure = Literal["gap", "headway", "reference"]


@dataclass(frozen=True, slots=True, eq=False)
class SpeedChange(Command):
    """Longitudinal: reach a speed, then hold it.

    Attributes:
        target: Speed (m/s).
        profile: Shape of the acceleration.
        rate_peak: Its peak (m/s^2); None: from the duration or the limits of the actor.
        duration: Length of the change (s); None: from the peak.
        start: Initial speed (m/s), set instantly; None: the present one.
        course: Instead of profile, peak and duration: the speed over time since the start.
        exact: With a course: whether the speed may jump.
    """

    target: float
    profile: DynamicProfile = "none"
    rate_peak: float | None = None
    duration: float | None = None
    start: float | None = None
    course: Profile | None = None
    exact: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Accelerate(Command):
    """Longitudinal: a constant acceleration (m/s^2); ends at standstill.

    Attributes:
        acceleration: m/s^2; None: the present one.
        start: Initial speed (m/s), set instantly; None: the present one.
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
        start: Initial acceleration (m/s^2); None: the present one.
        course: Instead of all these: the acceleration over time since the start.
    """

    target: float
    profile: DynamicProfile = "none"
    rate_peak: float | None = None
    duration: float | None = None
    start: float | None = None
    course: Profile | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Careful(Command):
    """Longitudinal: another command, slowed down to avoid obstacles ahead.

    Attributes:
        course: Command on a free road; None: hold the speed.
        headway: Time gap (s) to an obstacle.
        gap: Gap (m) to it at standstill.
    """

    course: Command | None
    headway: float = 1.5
    gap: float = 2.0


@dataclass(frozen=True, slots=True, eq=False)
class KeepSchedule(Command):
    """Longitudinal: follow a curve over time as the limits allow.

    Attributes:
        curve: Its parameter is the time (s).
        begin: Time of the start (s).
        end: Time of the end (s).
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
        spread: Allowed surplus (m/s) of the difference.
        course: Instead of a difference: its profile over time since the start.
        due: Seconds in which the speed has to be reached, infinite if open. The approach uses
            comfortable limits if they suffice; the acceleration of the reference is added. None:
            comfortable limits for all.
    """

    reference: str
    factor: float = 1.0
    difference: float = 0.0
    spread: float = 0.0
    course: Profile | None = None
    due: float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class KeepGap(Command):
    """Longitudinal: reach and hold a distance to another actor.

    Attributes:
        reference: The other actor.
        ahead: Whether this actor has to be ahead of it.
        measure: Between facing ends ("gap"), fronts ("headway") or reference points.
        distance: Metres; exclusive with `time`.
        time: Seconds times the speed of the follower.
        spread: Allowed surplus (m or s).
        projected: Whether the motion of the reference is extrapolated from the start.
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
    """Longitudinal: reach a position after a time, at a speed if one is given.

    Attributes:
        duration: Seconds.
        way: Metres to cover until then; exclusive with `gap`.
        gap: Position relative to another actor.
        speed: Speed at the end: a number (m/s), or relative to an actor; None: any.
    """

    duration: float
    way: float | None = None
    gap: KeepGap | None = None
    speed: float | FollowSpeed | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Cover(Command):
    """Longitudinal: cover a distance over time since the start, then stop.

    Attributes:
        course: The distance (m).
        exact: Whether the speed may jump.
    """

    course: Profile
    exact: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class GapCourse(Command):
    """Longitudinal: follow a distance to another actor over time since the start, then hold it.

    Attributes:
        reference: The other actor.
        course: Metres between the reference points; negative: behind it.
        projected: Whether the motion of the reference is extrapolated from the start.
        exact: Whether the speed may jump.
    """

    reference: str
    course: Profile
    projected: bool = False
    exact: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Standstill(Command):
    """Longitudinal: brake to standstill with the greatest deceleration."""
