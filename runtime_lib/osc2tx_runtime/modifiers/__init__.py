"""Movement modifiers: how an action is to be carried out, or where an actor starts.

Each is a small value with the parameters of the DSL in their order. Numbers are SI floats, or
functions that are called when the action starts. `MODIFIERS` lists all that have an effect. The
names of the DSL (`speed`, `lane`, ...) are those that scenarios import.
"""

from __future__ import annotations

from .base import At, Modifier, Side, Value, value_of
from .conduct import Along, AlongTrajectory, AvoidCollisions, PhysicalMovement, TowTrailer
from .lanes import ChangeLane, KeepLane, Lane, Lateral, LatMeasure
from .places import Distance, KeepPosition, Location, Position
from .speeds import Acceleration, ChangeSpeed, KeepSpeed, Speed
from .turns import Orient, Yaw

acceleration = Acceleration
along = Along
along_trajectory = AlongTrajectory
avoid_collisions = AvoidCollisions
change_lane = ChangeLane
change_speed = ChangeSpeed
distance = Distance
keep_lane = KeepLane
keep_position = KeepPosition
keep_speed = KeepSpeed
lane = Lane
lateral = Lateral
location = Location
orientation = Orient
physical_movement = PhysicalMovement
position = Position
speed = Speed
tow_trailer = TowTrailer
yaw = Yaw

MODIFIERS: dict[str, type[Modifier]] = {
    each.name: each
    for each in (
        Speed,
        ChangeSpeed,
        KeepSpeed,
        Acceleration,
        Position,
        KeepPosition,
        Distance,
        Lane,
        Lateral,
        ChangeLane,
        KeepLane,
        Yaw,
        Orient,
        Location,
        Along,
        AlongTrajectory,
        PhysicalMovement,
        AvoidCollisions,
        TowTrailer,
    )
}
"""Modifiers that have an effect, by their name in the DSL."""

__all__ = [
    "MODIFIERS",
    "Acceleration",
    "Along",
    "AlongTrajectory",
    "At",
    "AvoidCollisions",
    "ChangeLane",
    "ChangeSpeed",
    "Distance",
    "KeepLane",
    "KeepPosition",
    "KeepSpeed",
    "Lane",
    "LatMeasure",
    "Lateral",
    "Location",
    "Modifier",
    "Orient",
    "PhysicalMovement",
    "Position",
    "Side",
    "Speed",
    "TowTrailer",
    "Value",
    "Yaw",
    "acceleration",
    "along",
    "along_trajectory",
    "avoid_collisions",
    "change_lane",
    "change_speed",
    "distance",
    "keep_lane",
    "keep_position",
    "keep_speed",
    "lane",
    "lateral",
    "location",
    "orientation",
    "physical_movement",
    "position",
    "speed",
    "tow_trailer",
    "value_of",
    "yaw",
]
