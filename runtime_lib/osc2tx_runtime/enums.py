"""Enums of the standard library: a type for each, with its members as literals.

Made by tools/make_enums.py from the text of the library; the section of the standard stands below.
"""

from __future__ import annotations

from typing import Literal, TypeAlias

__all__ = [
    "At",
    "BulbColor",
    "BulbIcon",
    "BulbState",
    "Color",
    "ConnectRoutePoints",
    "CrossingElevation",
    "CrossingMarking",
    "CrossingUse",
    "Directionality",
    "DistanceDirection",
    "DistanceMode",
    "DrivingRule",
    "DynamicProfile",
    "GapDirection",
    "HeadwayDirection",
    "HitchType",
    "IntendedInfrastructure",
    "JunctionDirection",
    "LaneChangeSide",
    "LaneType",
    "LaneUse",
    "LatMeasureBy",
    "LateralOverlapKind",
    "LonLat",
    "MovementMode",
    "MovementOptions",
    "OnRouteType",
    "OrientationMeasuredBy",
    "PathInterpolation",
    "RelativeTransform",
    "RoadDistanceDirection",
    "RouteDistanceEnum",
    "RouteOverlapKind",
    "SemanticTrafficLightState",
    "SideLeftRight",
    "StopLineMarking",
    "Track",
    "TrafficParticipantRole",
    "TrailerCategory",
    "VehicleCategory",
    "YawMeasureBy",
]

Color: TypeAlias = Literal[
    "white",
    "silver",
    "gray",
    "black",
    "red",
    "maroon",
    "yellow",
    "olive",
    "lime",
    "green",
    "aqua",
    "teal",
    "blue",
    "navy",
    "fuchsia",
    "purple",
    "violet",
    "orange",
    "brown",
    "other",
]
"""`color` (§8.7.15)."""

VehicleCategory: TypeAlias = Literal[
    "car",
    "bus",
    "heavy_truck",
    "truck",
    "trailer",
    "micro_mobility_device",
    "vru_vehicle",
    "other",
    "van",
    "semi_tractor",
    "semi_trailer",
    "motorcycle",
    "bicycle",
    "stand_up_scooter",
    "wheelchair",
    "work_machine",
    "train",
    "tram",
    "watercraft",
    "aircraft",
    "land_vehicle",
]
"""`vehicle_category` (§8.7.16)."""

TrailerCategory: TypeAlias = Literal["semi_trailer", "full_trailer", "central_axle_trailer"]
"""`trailer_category` (§8.7.17)."""

HitchType: TypeAlias = Literal["ball", "pintle", "fifth_wheel", "other", "none"]
"""`hitch_type` (§8.7.18)."""

IntendedInfrastructure: TypeAlias = Literal[
    "driving",
    "sidewalk",
    "biking",
    "rail",
    "tram",
    "bus",
    "taxi",
    "hov",
]
"""`intended_infrastructure` (§8.7.19)."""

TrafficParticipantRole: TypeAlias = Literal[
    "civil",
    "ambulance",
    "fire_brigade",
    "fire",
    "military",
    "police",
    "public_transport",
    "roadside_assistance",
    "road_assistance",
    "garbage_collection",
    "construction",
    "road_construction",
    "other",
    "freight_transport",
    "special_transport",
    "dangerous_goods_transport",
    "agriculture",
    "traffic_control",
]
"""`traffic_participant_role` (§8.7.20)."""

DistanceDirection: TypeAlias = Literal["longitudinal", "lateral", "vertical", "euclidean"]
"""`distance_direction` (§8.7.21)."""

RoadDistanceDirection: TypeAlias = Literal["longitudinal", "lateral"]
"""`road_distance_direction` (§8.7.22)."""

DistanceMode: TypeAlias = Literal["reference_points", "bounding_boxes"]
"""`distance_mode` (§8.7.23)."""

OnRouteType: TypeAlias = Literal["on_road", "on_lane_section", "on_lane", "on_crossing"]
"""`on_route_type` (§8.7.24)."""

RouteDistanceEnum: TypeAlias = Literal["from_start", "from_end"]
"""`route_distance_enum` (§8.7.25)."""

DynamicProfile: TypeAlias = Literal["none", "constant", "smooth", "asap"]
"""`dynamic_profile` (§8.8.2.18)."""

LaneChangeSide: TypeAlias = Literal["left", "right", "inside", "outside", "same"]
"""`lane_change_side` (§8.8.3.14)."""

GapDirection: TypeAlias = Literal["ahead", "behind", "left", "right", "inside", "outside"]
"""`gap_direction` (§8.8.3.15)."""

HeadwayDirection: TypeAlias = Literal["ahead", "behind"]
"""`headway_direction` (§8.8.3.16)."""

At: TypeAlias = Literal["start", "end", "all"]
"""`at` (§8.9.19)."""

MovementMode: TypeAlias = Literal["monotonous", "other"]
"""`movement_mode` (§8.9.20)."""

Track: TypeAlias = Literal["actual", "projected"]
"""`track` (§8.9.21)."""

LatMeasureBy: TypeAlias = Literal[
    "left_to_left",
    "left_to_center",
    "left_to_right",
    "center_to_left",
    "center_to_center",
    "center_to_right",
    "right_to_left",
    "right_to_center",
    "right_to_right",
    "closest",
]
"""`lat_measure_by` (§8.9.22)."""

YawMeasureBy: TypeAlias = Literal[
    "length_to_length",
    "length_to_width",
    "width_to_length",
    "width_to_width",
    "relative_to_north",
    "relative_to_road",
]
"""`yaw_measure_by` (§8.9.23)."""

OrientationMeasuredBy: TypeAlias = Literal["absolute", "relative_to_reference", "relative_to_road"]
"""`orientation_measured_by` (§8.9.24)."""

MovementOptions: TypeAlias = Literal["prefer_physical", "prefer_non_physical", "must_be_physical"]
"""`movement_options` (§8.9.25)."""

DrivingRule: TypeAlias = Literal["left_hand_traffic", "right_hand_traffic"]
"""`driving_rule` (§8.12.3)."""

Directionality: TypeAlias = Literal[
    "uni_direction",
    "bi_direction",
    "split",
    "free",
    "none",
    "other",
]
"""`directionality` (§8.12.6)."""

LaneType: TypeAlias = Literal["driving", "non_driving", "vru_vehicles", "pedestrian", "other"]
"""`lane_type` (§8.12.12)."""

LaneUse: TypeAlias = Literal[
    "normal",
    "exit",
    "entry",
    "on_ramp",
    "off_ramp",
    "connecting_ramp",
    "hov",
    "bus",
    "mixed_traffic_vru",
    "parking",
    "stop",
    "restricted",
    "border",
    "shoulder",
    "curb",
    "median",
    "bicycle",
    "motorcycle",
    "sidewalk",
    "protected_sidewalk",
    "none",
    "other",
]
"""`lane_use` (§8.12.13)."""

SideLeftRight: TypeAlias = Literal["left", "right"]
"""`side_left_right` (§8.12.14)."""

LonLat: TypeAlias = Literal["longitudinal", "lateral"]
"""`lon_lat` (§8.12.15)."""

CrossingMarking: TypeAlias = Literal["unmarked", "marked", "zebra", "other"]
"""`crossing_marking` (§8.12.17)."""

CrossingUse: TypeAlias = Literal["pedestrian", "animal", "bicycle", "rail_road", "other"]
"""`crossing_use` (§8.12.18)."""

CrossingElevation: TypeAlias = Literal["road_level", "curb_level", "refuge_island", "other"]
"""`crossing_elevation` (§8.12.19)."""

JunctionDirection: TypeAlias = Literal["straight", "right", "u_turn", "left", "other"]
"""`junction_direction` (§8.12.22)."""

RouteOverlapKind: TypeAlias = Literal["equal", "start", "end", "inside", "any", "other"]
"""`route_overlap_kind` (§8.12.23)."""

LateralOverlapKind: TypeAlias = Literal["never", "sometimes", "always"]
"""`lateral_overlap_kind` (§8.12.24)."""

ConnectRoutePoints: TypeAlias = Literal["road", "lane_section", "lane", "crossing", "waypoint"]
"""`connect_route_points` (§8.12.29)."""

PathInterpolation: TypeAlias = Literal["straight_line", "smooth"]
"""`path_interpolation` (§8.12.35)."""

RelativeTransform: TypeAlias = Literal[
    "world_relative",
    "object_relative",
    "road_relative",
    "lane_relative",
]
"""`relative_transform` (§8.12.36)."""

BulbIcon: TypeAlias = Literal[
    "unknown",
    "circle",
    "pedestrian_walking",
    "pedestrian_standing",
    "tram",
    "bus",
    "bicycle",
    "horse_rider",
    "person_bicycle",
    "bicycle_left",
    "bicycle_right",
    "arrow_left",
    "arrow_right",
    "arrow_straight",
    "arrow_left_straight",
    "arrow_right_straight",
    "arrow_diagonal_left",
    "arrow_diagonal_right",
    "arrow_u_turn_left",
    "arrow_u_turn_right",
    "arrow_left_right",
    "lane_arrow_down",
    "lane_arrow_down_right",
    "lane_arrow_down_left",
    "lane_cross",
    "txt_walk",
    "txt_dont_walk",
    "countdown",
    "pt_horizontal_bar",
    "pt_vertical_bar",
    "pt_slash_bar",
    "pt_backslash_bar",
    "pt_small_circle",
    "pt_triangle",
    "switch_x",
    "switch_v_flipped",
    "switch_v_left",
    "switch_v_right",
    "switch_t",
    "switch_a",
    "switch_bar_v",
    "switch_bar_v_flipped",
    "switch_bar_v_right",
    "switch_bar_v_left",
    "switch_dotted_circle",
]
"""`bulb_icon` (§8.15.2.1)."""

BulbColor: TypeAlias = Literal["unknown", "red", "yellow", "green", "blue", "white"]
"""`bulb_color` (§8.15.2.2)."""

BulbState: TypeAlias = Literal["unknown", "is_off", "is_on", "is_flashing"]
"""`bulb_state` (§8.15.2.3)."""

SemanticTrafficLightState: TypeAlias = Literal[
    "off",
    "stop",
    "attention",
    "caution",
    "stop_attention",
    "go",
    "go_exclusive",
    "non_functional",
]
"""`semantic_traffic_light_state` (§8.15.3.1)."""

StopLineMarking: TypeAlias = Literal["none", "solid", "broken"]
"""`stop_line_marking` (§8.15.5.1)."""
