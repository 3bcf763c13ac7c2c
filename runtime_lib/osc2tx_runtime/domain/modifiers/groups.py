"""Groups of modifier classes, as types and as tuples: along the road, across it, turns, paths."""

from __future__ import annotations

from typing import TypeAlias, get_args

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

SpeedShaper: TypeAlias = Speed | ChangeSpeed | KeepSpeed | Acceleration | Position | AvoidCollisions
SpeedModifier: TypeAlias = SpeedShaper | PhysicalMovement
"""What actions on the lane or the pose take."""

LaneShaper: TypeAlias = Lane | Lateral | ChangeLane | KeepLane
TurnModifier: TypeAlias = Yaw | Orient
SideModifier: TypeAlias = LaneShaper | TurnModifier | Along | AvoidCollisions | PhysicalMovement
"""What actions on the speed take."""

PathModifier: TypeAlias = Along | AlongTrajectory
StartModifier: TypeAlias = Lane | Lateral | Yaw | Orient | Along | Position | Speed
"""What actions take `at: start` alone: all that can hold at an instant."""

SPEED_SHAPERS = get_args(SpeedShaper)
LANE_SHAPERS = get_args(LaneShaper)
TURN_SHAPERS = get_args(TurnModifier)
PATH_SHAPERS = get_args(PathModifier)
SPEED_FREE = get_args(SpeedModifier)
SIDE_FREE = get_args(SideModifier)

PLACES = (Position, Lane, Lateral, Yaw, Orient)
"""What says where an actor is."""
