"""Modifiers: how an action is to be carried out, where an actor starts, what roads are like.

Each is a small value with the parameters of the DSL in their order. Numbers are SI floats, or
functions that are called when the action starts. `MODIFIERS` lists all that have an effect. The
names of the DSL (`speed`, `lane`, ...) are those that scenarios import.
"""

from __future__ import annotations

from .base import Modifier, MovementModifier, Value, value_of
from .conduct import (
    Along,
    AlongTrajectory,
    AvoidCollisions,
    OnPath,
    PhysicalMovement,
    TowTrailer,
)
from .lane import ChangeLane, KeepLane, Lane, Lateral
from .map_files import (
    MAP_MODIFIERS,
    CompoundLaneSide,
    CrossingConnects,
    EndLane,
    LaneSide,
    MapModifier,
    NumberOfLanes,
    RoadsFollowInJunction,
    RoutesAreInSequence,
    RoutesAreOpposite,
    RoutesOverlap,
    SetMapFile,
    SetTrafficLightsControlFile,
    StartLane,
)
from .orientation import Orient, Yaw
from .position import Distance, KeepPosition, Location, Position
from .speed import Acceleration, ChangeSpeed, KeepSpeed, Speed

acceleration = Acceleration
along = Along
along_trajectory = AlongTrajectory
avoid_collisions = AvoidCollisions
change_lane = ChangeLane
change_speed = ChangeSpeed
compound_lane_side = CompoundLaneSide
crossing_connects = CrossingConnects
distance = Distance
end_lane = EndLane
keep_lane = KeepLane
keep_position = KeepPosition
keep_speed = KeepSpeed
lane = Lane
lane_side = LaneSide
lateral = Lateral
location = Location
number_of_lanes = NumberOfLanes
on_path = OnPath
orientation = Orient
physical_movement = PhysicalMovement
position = Position
roads_follow_in_junction = RoadsFollowInJunction
routes_are_in_sequence = RoutesAreInSequence
routes_are_opposite = RoutesAreOpposite
routes_overlap = RoutesOverlap
set_map_file = SetMapFile
set_traffic_lights_control_file = SetTrafficLightsControlFile
speed = Speed
start_lane = StartLane
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
        OnPath,
    )
}
"""Modifiers that have an effect, by their name in the DSL."""

MODIFIERS |= {each.name: each for each in MAP_MODIFIERS}

__all__ = [
    "MAP_MODIFIERS",
    "MODIFIERS",
    "Acceleration",
    "Along",
    "AlongTrajectory",
    "AvoidCollisions",
    "ChangeLane",
    "ChangeSpeed",
    "CompoundLaneSide",
    "CrossingConnects",
    "Distance",
    "EndLane",
    "KeepLane",
    "KeepPosition",
    "KeepSpeed",
    "Lane",
    "LaneSide",
    "Lateral",
    "Location",
    "MapModifier",
    "Modifier",
    "MovementModifier",
    "NumberOfLanes",
    "OnPath",
    "Orient",
    "PhysicalMovement",
    "Position",
    "RoadsFollowInJunction",
    "RoutesAreInSequence",
    "RoutesAreOpposite",
    "RoutesOverlap",
    "SetMapFile",
    "SetTrafficLightsControlFile",
    "Speed",
    "StartLane",
    "TowTrailer",
    "Value",
    "Yaw",
    "acceleration",
    "along",
    "along_trajectory",
    "avoid_collisions",
    "change_lane",
    "change_speed",
    "compound_lane_side",
    "crossing_connects",
    "distance",
    "end_lane",
    "keep_lane",
    "keep_position",
    "keep_speed",
    "lane",
    "lane_side",
    "lateral",
    "location",
    "number_of_lanes",
    "on_path",
    "orientation",
    "physical_movement",
    "position",
    "roads_follow_in_junction",
    "routes_are_in_sequence",
    "routes_are_opposite",
    "routes_overlap",
    "set_map_file",
    "set_traffic_lights_control_file",
    "speed",
    "start_lane",
    "tow_trailer",
    "value_of",
    "yaw",
]
