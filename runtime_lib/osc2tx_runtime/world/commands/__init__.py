"""All commands: frozen values, one per slot.

A world executes a command from the step at which it receives the object, until another command (or
None) follows. `World.capabilities()` states the commands that a world can execute.
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
