# ruff: noqa: E501 (a row is easier to read as one line)
"""Every argument of the actions and modifiers of motion, in a line of a scenario that runs.

A row has the action or modifier, the arguments that it tries, and the statement. Modifiers stand
below a `drive` of 2 s where nothing else is written. Values are constants, ranges of which one is
drawn, and what other actors do at that moment.
"""

from __future__ import annotations

DRIVE = "ego.drive(duration: 2s) with: "
WALK = "walker.walk(duration: 2s) with: "
MOVE = "ball.move(duration: 2s) with: "
PLACE = "ego.drive(duration: 50ms) with: "

PREAMBLE = """import osc.standard.all

namespace null use std, stdtypes

struct ramp inherits any_speed_shape:
    first: speed
    def duration() -> time is only expression 2s
    def compute(time: time) -> speed is only expression first + 1mpss * time

struct push inherits any_acceleration_shape:
    most: acceleration
    def compute(time: time) -> acceleration is only expression most * (time / 2s)

struct going inherits any_position_shape:
    pace: speed
    def duration() -> time is only expression 2s
    def compute(time: time) -> length is only expression pace * time

struct shifting inherits any_lateral_shape:
    pace: speed
    def duration() -> time is only expression 2s
    def compute(time: time) -> length is only expression pace * time

struct turning inherits any_shape:
    rate: angular_rate
    def duration() -> time is only expression 2s
    def compute(time: time) -> angle is expression rate * time
"""

CAST = """
scenario {name}:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego, other, beside: vehicle
    walker: person
    ball: movable_object
    # Places and ways
    start, target: position_3d
    keep(start.x == 60m)
    keep(start.y == 30m)
    keep(target.x == 90m)
    keep(target.y == -8.75m)
    askew: orientation_3d with:
        keep(it.yaw == 20deg)
        keep(it.pitch == 5deg)
        keep(it.roll == -5deg)
    first, second: pose_3d
    keep(first.position.x == 61m)
    keep(first.position.y == -8.75m)
    keep(second.position.x == 75m)
    keep(second.position.y == -8.75m)
    way: path with:
        keep(it.points == [first, second])
        keep(it.interpolation == straight_line)
    flight: trajectory with:
        keep(it.points == [first, second])
        keep(it.time_stamps == [0.1s, 1.5s])
        keep(it.interpolation == straight_line)
    near, far: pose_3d
    keep(near.position.x == 1m)
    keep(near.position.y == 0m)
    keep(far.position.x == 12m)
    keep(far.position.y == 0m)
    on: relative_path_pose_3d with:
        keep(it.points == [near, far])
        keep(it.interpolation == straight_line)
    hop: relative_trajectory_pose_3d with:
        keep(it.points == [near, far])
        keep(it.time_stamps == [0.1s, 1.2s])
        keep(it.interpolation == straight_line)
    third: lane
    road.number_of_lanes(stretch, 3)
    stretch: lane_section
    # Shapes
    even: common_speed_shape with:
        keep(it.rate_profile == constant)
        keep(it.rate_peak == 2mpss)
    jerky: common_acceleration_shape with:
        keep(it.rate_profile == smooth)
    gentle: common_lateral_shape with:
        keep(it.rate_profile == smooth)
    calm: common_position_shape with:
        keep(it.rate_profile == smooth)
    own_speed: ramp with:
        keep(it.first == 10mps)
    own_push: push with:
        keep(it.most == 2mpss)
    own_way: going with:
        keep(it.pace == 10mps)
    own_shift: shifting with:
        keep(it.pace == 0.3mps)
    own_turn: turning with:
        keep(it.rate == 5degps)

    do parallel(overlap: start):
        serial:
            ego.drive(duration: 100ms) with:
                lane(2, at: start)
                position(60m, at: start)
                speed(10mps, at: start)
            {statement}
        other.drive(duration: 3s) with:
            lane(2, at: start)
            position(100m, at: start)
            speed(12mps)
        beside.drive(duration: 3s) with:
            lane(3, at: start)
            position(60m, at: start)
            speed(10mps)
        walker.walk(duration: 50ms) with:
            position(at_point: start, project_on_route: false, at: start)
"""

# (action or modifier, arguments, statement). More lines of one statement are parted by `; `.
ROWS: tuple[tuple[str, str, str], ...] = (
    # --- actions that put something somewhere ---
    ("assign_position", "position", "ego.assign_position(target)"),
    (
        "assign_position",
        "odr_point",
        'ego.assign_position(odr_point: road.create_odr_point(road_id: "1", lane_id: "-3", s: 80m, t: 0m))',
    ),
    (
        "assign_position",
        "route_point",
        "ego.assign_position(route_point: road.xyz_to_route_point(90m, -8.75m, 0m))",
    ),
    ("assign_orientation", "orientation", "ball.assign_orientation(askew)"),
    ("assign_orientation", "orientation", "ego.assign_orientation(askew)"),
    ("assign_speed", "speed", "ego.assign_speed(14mps)"),
    ("assign_speed", "speed", "ego.assign_speed([11mps..14mps])"),
    ("assign_speed", "speed", "ego.assign_speed(other.speed - 1mps)"),
    ("assign_acceleration", "acceleration", "ego.assign_acceleration(1mpss)"),
    ("assign_acceleration", "acceleration", "ego.assign_acceleration(other.speed / 10s)"),
    (
        "remain_stationary",
        "",
        "ego.remain_stationary(duration: 1s) with: position(90m); lane(3); physical_movement(prefer_non_physical)",
    ),
    # --- speed ---
    ("change_speed", "target", "ego.change_speed(other.speed)"),
    ("change_speed", "target", "ego.change_speed([11mps..13mps])"),
    (
        "change_speed",
        "rate_profile rate_peak",
        "ego.change_speed(14mps, rate_profile: smooth, rate_peak: 3mpss)",
    ),
    (
        "change_speed",
        "rate_peak",
        "ego.change_speed(14mps, rate_profile: constant, rate_peak: other.speed / 6s)",
    ),
    (
        "change_speed",
        "rate_peak",
        "ego.change_speed(14mps, rate_profile: asap, rate_peak: [2mpss..3mpss])",
    ),
    ("change_acceleration", "target", "ego.change_acceleration(other.speed / 10s)"),
    (
        "change_acceleration",
        "target rate_profile rate_peak",
        "ego.change_acceleration(1.5mpss, rate_profile: smooth, rate_peak: 4mpspsps)",
    ),
    (
        "change_acceleration",
        "rate_peak",
        "ego.change_acceleration(1.5mpss, rate_profile: constant, rate_peak: 1mpspsps + 0.1mpspsps * (other.speed / 1mps))",
    ),
    # --- lanes ---
    ("follow_lane", "offset", "ego.follow_lane(0.5m, duration: 2s)"),
    ("follow_lane", "offset", "ego.follow_lane(other.speed * 40ms, duration: 2s)"),
    (
        "follow_lane",
        "rate_profile rate_peak",
        "ego.follow_lane(0.5m, rate_profile: smooth, rate_peak: other.speed / 20.0, duration: 2s)",
    ),
    ("follow_lane", "offset_range", "ego.follow_lane(offset_range: [0.3m..0.6m], duration: 2s)"),
    ("follow_lane", "target", "ego.follow_lane(target: third, duration: 3s)"),
    ("change_lane", "num_of_lanes side", "ego.change_lane(1, left)"),
    ("change_lane", "side", "ego.change_lane(side: inside)"),
    ("change_lane", "side reference", "ego.change_lane(side: same, reference: beside)"),
    ("change_lane", "num_of_lanes side reference", "ego.change_lane(1, right, other)"),
    ("change_lane", "offset", "ego.change_lane(side: left, offset: other.speed * 20ms)"),
    ("change_lane", "num_of_lanes", "ego.change_lane([1..1], left)"),
    (
        "change_lane",
        "rate_profile rate_peak",
        "ego.change_lane(side: left, rate_profile: constant, rate_peak: other.speed / 8.0)",
    ),
    ("change_lane", "target", "ego.change_lane(target: third)"),
    # --- gaps ---
    (
        "change_time_gap",
        "target direction reference",
        "ego.change_time_gap(3s, behind, other, duration: 4s)",
    ),
    (
        "change_time_gap",
        "target",
        "ego.change_time_gap(3s * (other.speed / 12mps), behind, other, duration: 4s)",
    ),
    (
        "keep_time_gap",
        "reference direction",
        "ego.keep_time_gap(other, longitudinal, duration: 2s)",
    ),
    (
        "change_space_gap",
        "target direction reference",
        "ego.change_space_gap(33m, behind, other, duration: [2s..6s])",
    ),
    ("change_space_gap", "target", "ego.change_space_gap([33m..34m], behind, other, duration: 4s)"),
    ("change_space_gap", "direction", "ego.change_space_gap(1.2m, right, beside, duration: 3s)"),
    ("keep_space_gap", "reference direction", "ego.keep_space_gap(beside, lateral, duration: 2s)"),
    (
        "change_time_headway",
        "target direction reference",
        "ego.change_time_headway(3.2s, behind, other, duration: 4s)",
    ),
    ("keep_time_headway", "reference", "ego.keep_time_headway(other, duration: 2s)"),
    (
        "change_space_headway",
        "target direction reference",
        "ego.change_space_headway(37m, behind, other, duration: 4s)",
    ),
    ("keep_space_headway", "reference", "ego.keep_space_headway(other, duration: 2s)"),
    # --- ways ---
    ("replay_path", "absolute", "ego.replay_path(way)"),
    (
        "replay_path",
        "relative reference transform",
        "ego.replay_path(relative: on, reference: beside, transform: object_relative)",
    ),
    (
        "replay_path",
        "start_offset end_offset",
        "ego.replay_path(way, start_offset: 2m, end_offset: other.speed * 100ms)",
    ),
    ("follow_path", "absolute", "ego.follow_path(way)"),
    (
        "follow_path",
        "relative reference transform",
        "ego.follow_path(relative: on, reference: ego, transform: lane_relative)",
    ),
    (
        "follow_path",
        "start_offset end_offset",
        "ego.follow_path(way, start_offset: other.speed * 100ms, end_offset: 1m)",
    ),
    ("replay_trajectory", "absolute", "ego.replay_trajectory(flight)"),
    (
        "replay_trajectory",
        "relative reference transform",
        "ego.replay_trajectory(relative: hop, reference: ego, transform: world_relative)",
    ),
    (
        "replay_trajectory",
        "start_offset end_offset",
        "ego.replay_trajectory(flight, start_offset: 1m, end_offset: 1m)",
    ),
    ("follow_trajectory", "absolute", "ego.follow_trajectory(flight)"),
    (
        "follow_trajectory",
        "relative reference transform",
        "ego.follow_trajectory(relative: hop, reference: ego, transform: lane_relative)",
    ),
    (
        "follow_trajectory",
        "start_offset end_offset",
        "ego.follow_trajectory(flight, start_offset: other.speed * 10ms, end_offset: 1m)",
    ),
    ("change_position", "target_xyz", "ego.change_position(target_xyz: target)"),
    (
        "change_position",
        "target_st on_road_network",
        "ego.change_position(target_st: road.xyz_to_route_point(90m, -8.75m, 0m), on_road_network: true)",
    ),
    (
        "change_position",
        "target_odr",
        'ego.change_position(target_odr: road.create_odr_point(road_id: "1", lane_id: "-3", s: 85m, t: 0m))',
    ),
    (
        "change_position",
        "target_position interpolation",
        "ego.change_position(target_position: target, interpolation: smooth, on_road_network: false)",
    ),
    # --- modifier position ---
    (
        "position",
        "distance",
        PLACE + "position(80m, at: start); physical_movement(prefer_non_physical)",
    ),
    ("position", "distance behind at", DRIVE + "position(38m, behind: other, at: end)"),
    ("position", "distance", DRIVE + "position(other.speed * 3200ms, behind: other, at: end)"),
    (
        "position",
        "time ahead_of",
        "other.drive(duration: 50ms); ego.drive(duration: 2s) with: position(time: -3.4s, ahead_of: other, at: end)",
    ),
    (
        "position",
        "distance_range track",
        DRIVE + "position(distance_range: [36m..45m], behind: other, track: projected)",
    ),
    ("position", "time_range", DRIVE + "position(time_range: [2s..5s], behind: other)"),
    ("position", "ahead_of_point", DRIVE + "position(-10m, ahead_of_point: target, at: end)"),
    ("position", "behind_point", DRIVE + "position(10m, behind_point: target, at: end)"),
    (
        "position",
        "at_point project_on_route",
        PLACE
        + "position(at_point: start, project_on_route: false, at: start); physical_movement(prefer_non_physical)",
    ),
    (
        "position",
        "movement_mode",
        DRIVE + "position(44m, behind: other, at: end, movement_mode: monotonous)",
    ),
    ("position", "shape", DRIVE + "position(39m, behind: other, at: end, shape: calm)"),
    # --- modifier speed ---
    ("speed", "speed at", DRIVE + "speed(12mps, at: end)"),
    ("speed", "speed", DRIVE + "speed([11mps..12mps])"),
    ("speed", "speed", DRIVE + "speed(other.speed - 1mps, at: end)"),
    ("speed", "speed_range", DRIVE + "speed(speed_range: [11mps..13mps])"),
    ("speed", "faster_than track", DRIVE + "speed(1mps, faster_than: beside, track: projected)"),
    ("speed", "slower_than", DRIVE + "speed(1mps, slower_than: other)"),
    ("speed", "same_as factor", DRIVE + "speed(same_as: other, factor: other.speed / 13mps)"),
    ("speed", "direction", DRIVE + "speed(0.4mps, direction: lateral, at: end)"),
    ("speed", "shape", DRIVE + "speed(13mps, shape: even)"),
    ("speed", "shape", DRIVE + "speed(shape: own_speed)"),
    ("speed", "movement_mode", DRIVE + "speed(12mps, at: end, movement_mode: monotonous)"),
    ("change_speed", "speed speed_range shape", DRIVE + "change_speed(2mps, shape: even)"),
    ("change_speed", "speed", DRIVE + "change_speed(other.speed / 10.0)"),
    ("change_speed", "speed_range at", DRIVE + "change_speed(speed_range: [1mps..2mps], at: end)"),
    (
        "change_speed",
        "movement_mode track",
        DRIVE + "change_speed(1mps, movement_mode: monotonous, track: actual)",
    ),
    ("acceleration", "acceleration at", DRIVE + "acceleration(1mpss, at: end)"),
    ("acceleration", "acceleration", DRIVE + "acceleration(other.speed / 12s)"),
    (
        "acceleration",
        "acceleration_range",
        DRIVE + "acceleration(acceleration_range: [0.5mpss..1mpss])",
    ),
    ("acceleration", "shape", DRIVE + "acceleration(1mpss, shape: jerky)"),
    ("acceleration", "shape", DRIVE + "acceleration(shape: own_push)"),
    (
        "acceleration",
        "movement_mode track",
        DRIVE + "acceleration(1mpss, movement_mode: monotonous, track: actual)",
    ),
    # --- modifiers across ---
    ("lateral", "distance side", DRIVE + "lateral(0.4m, side: right)"),
    (
        "lateral",
        "distance measure_by",
        DRIVE + "lateral(0.8m, side: left, measure_by: left_to_left)",
    ),
    ("lateral", "distance", DRIVE + "lateral(other.speed * 30ms)"),
    (
        "lateral",
        "distance_range at",
        "ego.drive(duration: 3s) with: lateral(distance_range: [0.2m..0.4m], at: end)",
    ),
    (
        "lateral",
        "side_of track",
        "ego.drive(duration: 3s) with: lateral(3.2m, side_of: beside, side: right, at: end, track: projected)",
    ),
    ("lateral", "shape", DRIVE + "lateral(0.4m, shape: gentle)"),
    ("lateral", "shape", DRIVE + "lateral(shape: own_shift)"),
    ("lateral", "movement_mode", DRIVE + "lateral(0.4m, movement_mode: monotonous)"),
    ("lane", "lane at", "ego.drive(duration: 4s) with: lane(3, at: end)"),
    ("lane", "lane from", "ego.drive(duration: 4s) with: lane(1, from: left, at: end)"),
    ("lane", "same_as", "ego.drive(duration: 4s) with: lane(same_as: beside, at: end)"),
    (
        "lane",
        "side_of side track",
        "ego.drive(duration: 4s) with: lane(1, side_of: other, side: left, at: end, track: projected)",
    ),
    (
        "lane",
        "shape movement_mode",
        "ego.drive(duration: 4s) with: lane(3, shape: gentle, movement_mode: monotonous)",
    ),
    ("change_lane", "lane side at", "ego.drive(duration: 4s) with: change_lane(1, left, at: end)"),
    (
        "change_lane",
        "shape movement_mode track",
        "ego.drive(duration: 4s) with: change_lane(side: left, shape: gentle, movement_mode: monotonous, track: actual)",
    ),
    ("keep_lane", "", DRIVE + "keep_lane()"),
    # --- modifiers of the heading ---
    ("yaw", "angle", DRIVE + "yaw(5deg)"),
    ("yaw", "angle", WALK + "yaw(other.speed * 1s / 1m * 1deg)"),
    ("yaw", "angle_range", WALK + "yaw(angle_range: [5deg..20deg])"),
    (
        "yaw",
        "relative_to measure_by",
        WALK + "yaw(90deg, relative_to: other, measure_by: length_to_length)",
    ),
    ("yaw", "measure_by at", WALK + "yaw(0deg, measure_by: relative_to_north, at: end)"),
    ("yaw", "shape", MOVE + "yaw(shape: own_turn)"),
    (
        "yaw",
        "movement_mode track",
        DRIVE + "yaw(3deg, movement_mode: monotonous, track: projected)",
    ),
    ("orientation", "yaw pitch roll", MOVE + "orientation(10deg, 5deg, 3deg)"),
    ("orientation", "pitch", MOVE + "orientation(pitch: other.speed * 1s / 1m * 1deg)"),
    (
        "orientation",
        "roll measure_by",
        DRIVE + "orientation(roll: 0deg, measure_by: relative_to_road)",
    ),
    ("orientation", "yaw relative_to", MOVE + "orientation(yaw: 10deg, relative_to: walker)"),
    ("orientation", "at", MOVE + "orientation(yaw: 10deg, measure_by: absolute, at: end)"),
    (
        "orientation",
        "shape movement_mode track",
        MOVE + "orientation(yaw: 10deg, shape: own_turn, movement_mode: monotonous, track: actual)",
    ),
    # --- modifiers of ways ---
    ("along", "route", "ego.drive() with: along(way)"),
    (
        "along",
        "start_offset end_offset",
        "ego.drive() with: along(way, start_offset: 1m, end_offset: other.speed * 100ms)",
    ),
    ("along", "shape", "ego.drive() with: along(way, shape: calm)"),
    (
        "along",
        "at movement_mode track",
        "ego.drive() with: along(way, at: end, movement_mode: monotonous, track: actual)",
    ),
    ("along_trajectory", "trajectory", "ego.drive() with: along_trajectory(flight)"),
    (
        "along_trajectory",
        "start_offset end_offset at",
        "ego.drive() with: along_trajectory(flight, start_offset: 1m, end_offset: other.speed * 100ms, at: end)",
    ),
    (
        "along_trajectory",
        "movement_mode track",
        "ego.drive() with: along_trajectory(flight, movement_mode: monotonous, track: actual)",
    ),
    ("distance", "distance", "ego.drive() with: distance(20m)"),
    ("distance", "distance", DRIVE + "distance(other.speed * 1750ms)"),
    ("distance", "shape", "ego.drive() with: distance(20m, shape: own_way)"),
    (
        "distance",
        "at movement_mode track",
        "ego.drive() with: distance([20m..22m], at: end, movement_mode: monotonous, track: actual)",
    ),
    ("keep_position", "", "ego.change_speed(0mps); ego.drive(duration: 1s) with: keep_position()"),
    ("keep_speed", "", DRIVE + "keep_speed()"),
    # --- how ---
    ("physical_movement", "option", DRIVE + "speed(20mps); physical_movement(prefer_non_physical)"),
    ("avoid_collisions", "avoid", DRIVE + "avoid_collisions(true)"),
)

REFUSED: tuple[tuple[str, str, str, str], ...] = (
    # A trajectory says itself when one is where.
    (
        "along_trajectory",
        "shape",
        "ego.drive() with: along_trajectory(flight, shape: calm)",
        "OSC509",
    ),
)
"""Rows as above, with the code of the report."""
