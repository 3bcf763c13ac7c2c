"""Groups of modifier classes: along the road, across it, orientation, paths."""

from __future__ import annotations

from osc2tx_runtime.domain.modifiers import (
    Acceleration,
    Along,
    AlongTrajectory,
    AvoidCollisions,
    ChangeLane,
    ChangeSpeed,
    KeepLane,
    KeepSpeed,
    Lane,
    Lateral,
    Orient,
    PhysicalMovement,
    Position,
    Speed,
    Yaw,
)

__all__ = [
    "LANE_SHAPERS",
    "PATH_SHAPERS",
    "PLACES",
    "SIDE_FREE",
    "SPEED_FREE",
    "SPEED_SHAPERS",
    "TURN_SHAPERS",
]

SPEED_SHAPERS = (Speed, ChangeSpeed, KeepSpeed, Acceleration, Position, AvoidCollisions)
LANE_SHAPERS = (Lane, Lateral, ChangeLane, KeepLane)
TURN_SHAPERS = (Yaw, Orient)
PATH_SHAPERS = (Along, AlongTrajectory)

PLACES = (Position, Lane, Lateral, Yaw, Orient)
"""What says where an actor is."""

SPEED_FREE: tuple[type, ...] = (*SPEED_SHAPERS, PhysicalMovement)
"""What actions on the lane or the pose take."""

SIDE_FREE: tuple[type, ...] = (
    *LANE_SHAPERS,
    *TURN_SHAPERS,
    *(Along, AvoidCollisions, PhysicalMovement),
)
"""What actions on the speed take."""
