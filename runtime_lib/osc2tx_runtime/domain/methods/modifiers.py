"""Modifiers that actions take together; made by tools/make_actor_methods.py."""

from __future__ import annotations

from typing import TypeAlias

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

__all__ = ["PathModifier", "SideModifier", "SpeedModifier", "StartModifier", "TurnModifier"]

SpeedModifier: TypeAlias = (
    Speed | ChangeSpeed | KeepSpeed | Acceleration | Position | AvoidCollisions | PhysicalMovement
)
SideModifier: TypeAlias = (
    Lane
    | Lateral
    | ChangeLane
    | KeepLane
    | Yaw
    | Orient
    | Along
    | AvoidCollisions
    | PhysicalMovement
)
TurnModifier: TypeAlias = Yaw | Orient
PathModifier: TypeAlias = Along | AlongTrajectory
StartModifier: TypeAlias = Lane | Lateral | Yaw | Orient | Position | Speed
