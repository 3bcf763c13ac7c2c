"""What users may write by mistake, and what the run says of it.

What is found before the run is in the tests of the diagnostics; these mistakes need the map, the
places of the others, or time.
"""

from __future__ import annotations

from textwrap import indent
from typing import NamedTuple

HEAD = """import osc.standard.all

namespace null use std, stdtypes

scenario failing:
    road: map with:
        keep(it.map_file == "{map}")
    env: environment
    ego: vehicle
    npc: vehicle
    walker: person
"""

CRUISE = """ego.drive(duration: 1s) with:
    lane(1, at: start)
    position(50m, at: start)
    speed(10mps)
"""


class Case(NamedTuple):
    """A mistake.

    Attributes:
        name: What it is.
        body: Members of a serial, after one second of driving unless they place `ego` themselves.
        at: Time of the failure (s).
        line: Its line, counted in the body from 1; None: in the members before it.
        reason: The end of the message.
        members: Of the scenario.
        map: Where.
        beside: The body goes on beside the driving, from the start.
    """

    name: str
    body: str
    at: float
    line: int
    reason: str
    members: str = ""
    map: str = "highway.xodr"
    beside: bool = False


POINT = """{0}: position_3d with:
    keep(it.x == {1}m)
    keep(it.y == {2}m)
    keep(it.z == 0m)
"""
POSE = """{0}: pose_3d with:
    keep(it.position.x == {1}m)
    keep(it.position.y == {2}m)
"""
PATH = "way: path\nkeep(way == road.create_path([a, b], straight_line))\n"

FAILURES = [
    Case(
        "a lane that the road does not have",
        "ego.drive(duration: 3s) with:\n    lane(9)",
        1.0,
        1,
        "road 1 has no lane 9 from the right at s = 60.0 m",
    ),
    Case(
        "a lane change beyond the lanes of a road",
        "ego.change_lane(num_of_lanes: 2, side: left)",
        1.05,
        1,
        "there are not 2 driving lanes to the left of lane -1 of road 1 at s = 60.0 m",
        map="crossing.xodr",
    ),
    Case(
        "a lane change off the edge of the road",
        "ego.change_lane(num_of_lanes: 1, side: right)",
        1.05,
        1,
        "there is no driving lane to the right of lane -4 of road 1 at s = 60.0 m",
    ),
    Case(
        "more speed than time for it",
        "ego.change_speed(target: 50mps, rate_profile: constant, duration: 2s)",
        1.0,
        1,
        "a change from 10.0 to 50.0 m/s in 2 s requires more than 12 m/s^2",
    ),
    Case(
        "a speed that nothing has",
        "ego.change_speed(target: 400kph)",
        1.0,
        1,
        "111.1 m/s exceeds its maximum speed of 69 m/s",
    ),
    Case(
        "an acceleration that no tyre can transmit",
        "ego.change_speed(target: 20mps, rate_profile: constant, rate_peak: 40mpss)",
        1.0,
        1,
        "rate_peak 40 m/s^2 is not between 0 and 12 m/s^2",
    ),
    Case(
        "braking harder than ice allows",
        "env.air(temperature: -5celsius)\n"
        "env.rain(intensity: 2mmph)\n"
        "ego.drive(duration: 1s)\n"
        "ego.change_speed(target: 0mps, rate_profile: constant, rate_peak: 6mpss)",
        2.0,
        4,
        "rate_peak 6 m/s^2 is not between 0 and 0.9807 m/s^2 on ice",
    ),
    Case(
        "a gap to itself",
        "ego.change_space_gap(target: 10m, direction: behind, reference: ego)",
        1.0,
        1,
        "ego cannot be its own reference; name another actor",
    ),
    Case(
        "faster than itself",
        "ego.drive(duration: 3s) with:\n    speed(2mps, faster_than: ego)",
        1.0,
        1,
        "ego cannot be its own reference; name another actor",
    ),
    Case(
        "a speed at the end that takes longer",
        "ego.drive(duration: 1s) with:\n    speed(30mps, at: end)",
        1.0,
        1,
        "a change from 10.0 to 30.0 m/s in 1 s requires more than 12 m/s^2",
    ),
    Case(
        "a lane at the end that takes longer",
        "ego.drive(duration: 1s) with:\n    lane(2, at: end)",
        2.0,
        1,
        "its duration ends before `lane(at: end)` is reached; state a longer one, or none",
    ),
    Case(
        "a place at the end that is too far",
        "ego.drive(duration: 2s) with:\n    position(500m, at: end)",
        1.0,
        1,
        "an acceleration of 210.00 m/s^2 exceeds its limit of 12 m/s^2",
    ),
    Case(
        "a path that begins far away",
        "ego.follow_path(absolute: way)",
        1.0,
        1,
        "the path is 984 m away, too far to get there",
        POSE.format("a", 900, 500) + POSE.format("b", 990, 500) + PATH,
    ),
    Case(
        "times of a trajectory that go back",
        "ego.replay_trajectory(absolute: course)",
        1.0,
        1,
        "the time stamps of a trajectory start at 0 s or later, and ascend",
        POSE.format("a", 60, -12.25)
        + POSE.format("b", 90, -12.25)
        + "course: trajectory\n"
        + "keep(course == road.create_trajectory([a, b], [3s, 1s], straight_line))",
    ),
    Case(
        "a target where no road is",
        "ego.change_position(target_xyz: there)",
        1.0,
        1,
        "there is no driving lane at (60, 300)",
        POINT.format("there", 60, 300),
    ),
    Case(
        "a road of another map",
        "ego.assign_position("
        'odr_point: road.create_odr_point(road_id: "77", lane_id: "-1", s: 10m, t: 0m))',
        1.0,
        1,
        "there is no road `77`; road ids differ between maps",
    ),
    Case(
        "a lane of another road",
        "ego.assign_position("
        'odr_point: road.create_odr_point(road_id: "1", lane_id: "-9", s: 10m, t: 0m))',
        1.0,
        1,
        "road `1` has no lane -9 at s = 10.000 m; it has -5, -4, -3, -2, -1, 1, 2, 3, 4",
    ),
    Case(
        "a place behind the end of the road",
        "ego.assign_position("
        'odr_point: road.create_odr_point(road_id: "1", lane_id: "-2", s: 99km, t: 0m))',
        1.0,
        1,
        "road 1 is 2000.0 m long, so there is no s = 99000 m",
    ),
    Case(
        "no trailer to uncouple",
        "ego.disconnect_trailer()",
        1.0,
        1,
        "ego tows no trailer",
    ),
    Case(
        "a trailer that is elsewhere",
        "ego.connect_trailer(trailer: caravan)",
        1.0,
        1,
        "the coupler of caravan is 16.2 m from the hitch of ego; couple within 1 m",
        "caravan: trailer",
    ),
    Case(
        "colder than can be",
        "env.air(temperature: -5K * (ego.speed / 1mps))",
        1.0,
        1,
        "`temperature` must not be less than 0",
    ),
    Case(
        "less than no rain",
        "env.rain(intensity: -0.001 * ego.speed)",
        1.0,
        1,
        "`intensity` must not be less than 0",
    ),
    Case(
        "air that is wetter than water",
        "env.air(relative_humidity: 3.0 * (ego.speed / 1mps))",
        1.0,
        1,
        "`relative_humidity` must not be more than 1",
    ),
    Case(
        "too little time for what is inside",
        "serial(duration: 2s):\n    ego.change_speed(target: 30mps, rate_peak: 2mpss)",
        3.0,
        1,
        "not finished within 2 s; still running: ego.change_speed(target=30 * mps,"
        " rate_peak=2 * mpss)",
    ),
    Case(
        "a change that is too much for the time that is left",
        "serial(duration: 1s):\n    ego.change_speed(target: 30mps, rate_profile: smooth)",
        1.0,
        2,
        "a change from 10.0 to 30.0 m/s in 1 s requires more than 12 m/s^2",
    ),
    Case(
        "a road that ends",
        "ego.drive(duration: 60s)",
        45.05,
        1,
        "ego has reached the end of lane -1 of road 1",
        map="crossing.xodr",
    ),
    Case(
        "a gap that takes longer",
        "npc.assign_position("
        'odr_point: road.create_odr_point(road_id: "1", lane_id: "-4", s: 110m, t: 0m))\n'
        "npc.change_space_gap(target: 400m, direction: behind, reference: ego, duration: 3s)",
        4.0,
        2,
        "at the end of its duration it is",
    ),
]
"""What fails as an action does: the run ends with a verdict."""


def source_of(case: Case) -> tuple[str, int]:
    """The scenario, and the number of the line before its body."""
    text = HEAD.format(map=case.map) + indent(case.members, "    ").rstrip() + "\n"
    text += f"    do {'parallel' if case.beside else 'serial'}:\n"
    text += indent(CRUISE, "        ")
    return text + indent(case.body, "        ") + "\n", text.count("\n")
