"""What an action asks of a world: frozen values, one per slot.

A world takes a command over at the step it first sees the object and pursues it until another
one (or None) comes. Worlds that cannot pursue a command say so in `World.capabilities()`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from .profiles import DynamicProfile

__all__ = [
    "Accelerate",
    "Command",
    "FollowSpeed",
    "GapMeasure",
    "KeepGap",
    "KeepLane",
    "LaneChange",
    "LaneOffset",
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
    """

    target: float
    profile: DynamicProfile = "none"
    rate_peak: float | None = None
    duration: float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Accelerate(Command):
    """Longitudinal: a constant acceleration (m/s^2); ends at standstill."""

    acceleration: float


@dataclass(frozen=True, slots=True, eq=False)
class FollowSpeed(Command):
    """Longitudinal: speed of another actor times `factor` plus `difference` (m/s)."""

    reference: str
    factor: float = 1.0
    difference: float = 0.0


@dataclass(frozen=True, slots=True, eq=False)
class KeepGap(Command):
    """Longitudinal: reach and hold a distance to another actor.

    Attributes:
        reference: The other actor.
        ahead: True if this actor is to be ahead of it.
        measure: Between facing ends ("gap"), fronts ("headway") or reference points.
        distance: Metres; exclusive with `time`.
        time: Seconds times the speed of the trailing one.
    """

    reference: str
    ahead: bool
    measure: GapMeasure = "gap"
    distance: float | None = None
    time: float | None = None


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
