"""Commands of the lateral slot."""

from __future__ import annotations

from osc2tx_runtime.enums import DynamicProfile
from osc2tx_runtime.opendrive import LanePosition
from osc2tx_runtime.world.geometry.curve import Curve
from osc2tx_runtime.world.geometry.profiles import Profile
from osc2tx_shared.classes import dataclass

from .base import Command


@dataclass(frozen=True, slots=True, eq=False)
class KeepLane(Command):
    """Lateral: stay in the lane at the present offset."""


@dataclass(frozen=True, slots=True, eq=False)
class LaneChange(Command):
    """Lateral: end in another lane.

    Attributes:
        lanes: Drivable lanes to the left (negative: to the right) of the present one.
        offset: Metres to the left of the target lane centre at the end.
        profile: Shape of the lateral speed.
        rate_peak: Its peak (m/s).
        duration: Length of the change (s).
        course: Instead of these three: the offset from the target lane over time.
    """

    lanes: int
    offset: float = 0.0
    profile: DynamicProfile = "none"
    rate_peak: float | None = None
    duration: float | None = None
    course: Profile | None = None


@dataclass(frozen=True, slots=True, eq=False)
class LaneOffset(Command):
    """Lateral: reach and hold an offset (m, left positive) in the present lane."""

    offset: float
    profile: DynamicProfile = "none"
    rate_peak: float | None = None
    duration: float | None = None
    course: Profile | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Turn(Command):
    """Lateral, actors off the lanes only: take a heading (rad, world).

    Attributes:
        heading: None: the present one.
        course: Instead of a heading: its profile over time since the start.
        pitch: rad; None: that of the road, or as set before.
        roll: Likewise.
    """

    heading: float | None
    course: Profile | None = None
    pitch: float | None = None
    roll: float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Sideways(Command):
    """Lateral: reach and hold a lateral speed (m/s, to the left).

    Attributes:
        speed: The speed, or the difference to the speed of the reference.
        reference: Another actor whose lateral speed counts.
        factor: Multiplies its lateral speed.
        course: How the speed is reached; None: instantly.
    """

    speed: float
    reference: str | None = None
    factor: float = 1.0
    course: Profile | None = None


@dataclass(frozen=True, slots=True, eq=False)
class RunOut(Command):
    """Lateral: set a lateral speed (m/s, to the left) instantly, and let it decay."""

    speed: float


@dataclass(frozen=True, slots=True, eq=False)
class Slant(Command):
    """Lateral: a heading (rad) relative to the lane, counter-clockwise.

    Attributes:
        angle: The heading.
        course: Instead of the heading: its profile over time since the start.
    """

    angle: float
    course: Profile | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Beside(Command):
    """Lateral: reach and hold a lateral distance to another actor.

    Attributes:
        reference: The other actor.
        left: Required distance (m) of the own reference point to the left of that of the reference.
        time: Instead: the lateral time gap (s); the actor approaches the reference at the gap
            divided by this time.
        spread: Allowed range (m) to the left of that.
        projected: Whether the motion of the reference is extrapolated from the start.
        duration: Seconds after which the distance has to be reached; None: comfortable motion.
        course: Instead of a distance: its profile over time since the start.
    """

    reference: str
    left: float | None = None
    time: float | None = None
    spread: float = 0.0
    projected: bool = False
    duration: float | None = None
    course: Profile | None = None


@dataclass(frozen=True, slots=True, eq=False)
class FollowCourse(Command):
    """Lateral: leave the lanes and steer along a curve, as the limits allow.

    Attributes:
        curve: The curve.
        begin: Arc length of the start (m).
        end: Arc length of the goal (m).
    """

    curve: Curve
    begin: float
    end: float


@dataclass(frozen=True, slots=True, eq=False)
class FollowRoute(Command):
    """Lateral: take the branches that lead to a position, and stay in the lane except for `side`.

    Attributes:
        goal: The position; any adjacent lane counts.
        side: Lateral command meanwhile.
        ends: Whether it is done at the position, and not with `side`.
    """

    goal: LanePosition
    side: Command | None = None
    ends: bool = True


@dataclass(frozen=True, slots=True, eq=False)
class ReplayCourse(Command):
    """Lateral: follow a curve exactly, at the own speed; attributes as of `FollowCourse`."""

    curve: Curve
    begin: float
    end: float


@dataclass(frozen=True, slots=True, eq=False)
class ReplayTrajectory(Command):
    """Both slots: follow a curve over time exactly; attributes as of `KeepSchedule`."""

    curve: Curve
    begin: float
    end: float
