"""Groups of modifier classes, as types and as tuples."""

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
"""Modifiers of actions on the lane or the pose."""

LaneShaper: TypeAlias = Lane | Lateral | ChangeLane | KeepLane
TurnModifier: TypeAlias = Yaw | Orient
SideModifier: TypeAlias = LaneShaper | TurnModifier | Along | AvoidCollisions | PhysicalMovement
"""Modifiers of actions on the speed."""

PathModifier: TypeAlias = Along | AlongTrajectory
StartModifier: TypeAlias = Lane | Lateral | Yaw | Orient | Along | Position | Speed
"""Modifiers that actions only accept `at: start`: all that can hold at an instant."""

SPEED_SHAPERS = get_args(SpeedShaper)
LANE_SHAPERS = get_args(LaneShaper)
TURN_SHAPERS = get_args(TurnModifier)
PATH_SHAPERS = get_args(PathModifier)
SPEED_FREE = get_args(SpeedModifier)
SIDE_FREE = get_args(SideModifier)

PLACES = (Position, Lane, Lateral, Yaw, Orient)
"""Modifiers that state the position of an actor."""
