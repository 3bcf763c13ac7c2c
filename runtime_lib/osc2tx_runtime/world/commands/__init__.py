"""All commands: frozen values, one per slot.

A world takes a command over at the step it first sees the object and pursues it until another
one (or None) comes. Worlds that cannot pursue a command say so in `World.capabilities()`.
"""

from __future__ import annotations

from .base import Command
from .lateral import (
    Beside,
    FollowCourse,
    FollowRoute,
    KeepLane,
    LaneChange,
    LaneOffset,
    ReplayCourse,
    ReplayTrajectory,
    RunOut,
    Sideways,
    Slant,
    Turn,
)
from .longitudinal import (
    Accelerate,
    AccelerationChange,
    Arrive,
    Careful,
    Cover,
    FollowSpeed,
    GapCourse,
    GapMeasure,
    KeepGap,
    KeepSchedule,
    SpeedChange,
    Standstill,
)

__all__ = [
    "Accelerate",
    "AccelerationChange",
    "Arrive",
    "Beside",
    "Careful",
    "Command",
    "Cover",
    "FollowCourse",
    "FollowRoute",
    "FollowSpeed",
    "GapCourse",
    "GapMeasure",
    "KeepGap",
    "KeepLane",
    "KeepSchedule",
    "LaneChange",
    "LaneOffset",
    "ReplayCourse",
    "ReplayTrajectory",
    "RunOut",
    "Sideways",
    "Slant",
    "SpeedChange",
    "Standstill",
    "Turn",
]
