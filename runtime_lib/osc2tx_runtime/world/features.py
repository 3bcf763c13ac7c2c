"""Names of the commands and features of the embedded world."""

from __future__ import annotations

__all__ = ["FEATURES"]

FEATURES = frozenset(
    {
        "Accelerate",
        "AccelerationChange",
        "Arrive",
        "Beside",
        "Careful",
        "Cover",
        "FollowCourse",
        "FollowRoute",
        "FollowSpeed",
        "GapCourse",
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
        "assign_orientation",
        "assign_position",
        "assign_speed",
        "collisions",
        "environment",
        "lights",
        "signals",
        "trailers",
    }
)
