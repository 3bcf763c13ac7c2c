"""The modifiers by their names in the DSL; made by tools/make_catalogue.py."""

from osc2tx_runtime.domain import modifiers

acceleration = modifiers.Acceleration
along = modifiers.Along
along_trajectory = modifiers.AlongTrajectory
avoid_collisions = modifiers.AvoidCollisions
change_lane = modifiers.ChangeLane
change_speed = modifiers.ChangeSpeed
compound_lane_side = modifiers.CompoundLaneSide
crossing_connects = modifiers.CrossingConnects
distance = modifiers.Distance
end_lane = modifiers.EndLane
keep_lane = modifiers.KeepLane
keep_position = modifiers.KeepPosition
keep_speed = modifiers.KeepSpeed
lane = modifiers.Lane
lane_side = modifiers.LaneSide
lateral = modifiers.Lateral
location = modifiers.Location
number_of_lanes = modifiers.NumberOfLanes
on_path = modifiers.OnPath
orientation = modifiers.Orient
physical_movement = modifiers.PhysicalMovement
position = modifiers.Position
roads_follow_in_junction = modifiers.RoadsFollowInJunction
routes_are_in_sequence = modifiers.RoutesAreInSequence
routes_are_opposite = modifiers.RoutesAreOpposite
routes_overlap = modifiers.RoutesOverlap
set_map_file = modifiers.SetMapFile
set_traffic_lights_control_file = modifiers.SetTrafficLightsControlFile
speed = modifiers.Speed
start_lane = modifiers.StartLane
tow_trailer = modifiers.TowTrailer
yaw = modifiers.Yaw

__all__ = [
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
    "yaw",
]
