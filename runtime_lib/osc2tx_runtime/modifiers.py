"""The modifiers by their names in the DSL; made by tools/make_catalogue.py."""

from osc2tx_runtime.domain.modifiers.map.crossings import CrossingConnects as crossing_connects
from osc2tx_runtime.domain.modifiers.map.files import SetMapFile as set_map_file
from osc2tx_runtime.domain.modifiers.map.files import (
    SetTrafficLightsControlFile as set_traffic_lights_control_file,
)
from osc2tx_runtime.domain.modifiers.map.lanes import CompoundLaneSide as compound_lane_side
from osc2tx_runtime.domain.modifiers.map.lanes import EndLane as end_lane
from osc2tx_runtime.domain.modifiers.map.lanes import LaneSide as lane_side
from osc2tx_runtime.domain.modifiers.map.lanes import NumberOfLanes as number_of_lanes
from osc2tx_runtime.domain.modifiers.map.lanes import StartLane as start_lane
from osc2tx_runtime.domain.modifiers.map.routes import (
    RoadsFollowInJunction as roads_follow_in_junction,
)
from osc2tx_runtime.domain.modifiers.map.routes import RoutesAreInSequence as routes_are_in_sequence
from osc2tx_runtime.domain.modifiers.map.routes import RoutesAreOpposite as routes_are_opposite
from osc2tx_runtime.domain.modifiers.map.routes import RoutesOverlap as routes_overlap
from osc2tx_runtime.domain.modifiers.movement.conduct import Along as along
from osc2tx_runtime.domain.modifiers.movement.conduct import AlongTrajectory as along_trajectory
from osc2tx_runtime.domain.modifiers.movement.conduct import AvoidCollisions as avoid_collisions
from osc2tx_runtime.domain.modifiers.movement.conduct import OnPath as on_path
from osc2tx_runtime.domain.modifiers.movement.conduct import PhysicalMovement as physical_movement
from osc2tx_runtime.domain.modifiers.movement.conduct import TowTrailer as tow_trailer
from osc2tx_runtime.domain.modifiers.movement.lane import ChangeLane as change_lane
from osc2tx_runtime.domain.modifiers.movement.lane import KeepLane as keep_lane
from osc2tx_runtime.domain.modifiers.movement.lane import Lane as lane
from osc2tx_runtime.domain.modifiers.movement.lane import Lateral as lateral
from osc2tx_runtime.domain.modifiers.movement.orientation import Orient as orientation
from osc2tx_runtime.domain.modifiers.movement.orientation import Yaw as yaw
from osc2tx_runtime.domain.modifiers.movement.position import Distance as distance
from osc2tx_runtime.domain.modifiers.movement.position import KeepPosition as keep_position
from osc2tx_runtime.domain.modifiers.movement.position import Location as location
from osc2tx_runtime.domain.modifiers.movement.position import Position as position
from osc2tx_runtime.domain.modifiers.movement.speed import Acceleration as acceleration
from osc2tx_runtime.domain.modifiers.movement.speed import ChangeSpeed as change_speed
from osc2tx_runtime.domain.modifiers.movement.speed import KeepSpeed as keep_speed
from osc2tx_runtime.domain.modifiers.movement.speed import Speed as speed

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
