"""Pitch and roll: of the road, and as an actor is told (DSL 8.3, 8.8.2.5, 8.9.10)."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from typing import Any

import pytest

from osc2tx_runtime import (
    Behaviour,
    Environment,
    Map,
    MovableObject,
    Parallel,
    Person,
    Point,
    Pose,
    Scenario,
    Serial,
    StationaryObject,
    Vehicle,
)
from osc2tx_runtime.domain.points_and_poses import Orientation
from osc2tx_runtime.modifiers import (
    lane,
    location,
    orientation,
    physical_movement,
    position,
    speed,
    yaw,
)
from osc2tx_runtime.opendrive import Pose as MapPose
from osc2tx_runtime.world.geometry.attitude import tilt_on

Run = Callable[..., Any]
JUMP = physical_movement("prefer_non_physical")


class Hill(Scenario):
    """The map `curve`: it climbs from s = 80 m to 300 m and is banked to the right in the bend."""

    name = "hill"
    source = "hill.osc"

    def declare(self) -> None:
        self.road = Map(map_file="curve")
        self.sky = Environment()
        self.car = Vehicle()
        self.box = MovableObject()
        self.person = Person()
        self.sign = StationaryObject()

    def placement(self) -> None:
        self.place(self.car, lane(1), position(distance=200.0), speed(10.0))
        off = {"project_on_route": False}
        self.place(self.box, position(at_point=Point(5.0, 30.0), **off))
        self.place(
            self.person,
            position(at_point=Point(20.0, 30.0), **off),
            orientation(0.3, 0.1, measure_by="absolute"),
        )
        self.place(self.sign, location(Pose(9.0, 40.0, 0.0, roll=-0.2, pitch=0.1, yaw=0.5)))


def hill(body: Callable[[Hill], Behaviour]) -> type[Scenario]:
    class Made(Hill):
        def behavior(self) -> Behaviour:
            return body(self)

    return Made


def elevation(s: float) -> tuple[float, float]:
    """Height (m) and slope of the reference line between s = 80 m and 300 m, from the file."""
    d = s - 80.0
    height = 0.0003719008 * d**2 - 0.000001127 * d**3
    return height, 2 * 0.0003719008 * d - 3 * 0.000001127 * d**2


# --- the road ---------------------------------------------------------------------------------


def test_a_car_is_tilted_as_the_road(run: Run) -> None:
    """In s = 150..270 m the road is banked by 0.05 rad, its left side down."""
    states = run(hill(lambda s: s.car.drive(duration=4.0))).states("car")
    for state in states:
        height, slope = elevation(state["s"])
        assert state["roll"] == pytest.approx(-0.05, abs=1e-6) or state["s"] > 270.0
        assert abs(state["z"] - height) < 0.5  # off the reference line, on a banked road
        assert state["pitch"] < 0.0  # nose up
        assert math.tan(-state["pitch"]) == pytest.approx(slope, rel=0.06)


def test_the_height_changes_with_the_pitch(run: Run) -> None:
    """dz over the way is the slope that the pitch tells, within the length of a step."""
    states = run(hill(lambda s: s.car.drive(duration=4.0))).states("car")
    for before, after in pairwise(states):
        way = math.hypot(after["x"] - before["x"], after["y"] - before["y"])
        rise = (after["z"] - before["z"]) / way
        mean = 0.5 * (math.tan(-before["pitch"]) + math.tan(-after["pitch"]))
        assert rise == pytest.approx(mean, abs=2e-4)


def test_level_roads_say_nothing(run: Run) -> None:
    states = run(hill(lambda s: s.car.drive(duration=1.0))).states("box")
    assert all("pitch" not in state and "roll" not in state for state in states)


def rotation(h: float, pitch: float, roll: float) -> list[list[float]]:
    """Axes of a body in the world, as columns: yaw, pitch, roll in this order."""
    ch, sh, cp, sp, cr, sr = (f(x) for x in (h, pitch, roll) for f in (math.cos, math.sin))
    return [
        [ch * cp, ch * sp * sr - sh * cr, ch * sp * cr + sh * sr],
        [sh * cp, sh * sp * sr + ch * cr, sh * sp * cr - ch * sr],
        [-sp, cp * sr, cp * cr],
    ]


@pytest.mark.parametrize("turn", [0.0, 0.4, -1.2, math.pi / 2, math.pi, -2.5])
@pytest.mark.parametrize(("pitch", "roll"), [(0.1, 0.0), (0.0, -0.05), (-0.2, 0.15)])
def test_on_a_slope_the_heading_decides(pitch: float, roll: float, turn: float) -> None:
    """What lies on a surface has the same axis upwards, whatever its heading."""
    surface = MapPose(0.0, 0.0, 0.0, 0.7, pitch, roll)
    found = tilt_on(surface, 0.7 + turn)
    up, wanted = (
        [row[2] for row in rotation(*angles)]
        for angles in ((0.7 + turn, *found), (0.7, pitch, roll))
    )
    assert up == pytest.approx(wanted, abs=1e-12)


# --- as it is told ----------------------------------------------------------------------------


def test_who_is_placed_so(run: Run) -> None:
    done = run(hill(lambda s: s.car.drive(duration=1.0)))
    person, sign = done.states("person")[0], done.states("sign")[0]
    assert (person["h"], person["pitch"]) == pytest.approx((0.3, 0.1))
    assert (sign["h"], sign["pitch"], sign["roll"]) == pytest.approx((0.5, 0.1, -0.2))


def test_an_orientation_is_assigned(run: Run) -> None:
    """A box keeps what it was told while it moves on."""

    def body(s: Hill) -> Behaviour:
        return Serial(
            "turn",
            s.box.assign_orientation(orientation=Orientation(roll=0.2, pitch=-0.1, yaw=1.0)),
            s.box.move(speed(1.0), duration=2.0),
        )

    done = run(hill(body))
    for t in (0.05, 2.0):
        state = done.at("box", t)
        assert (state["h"], state["pitch"], state["roll"]) == pytest.approx((1.0, -0.1, 0.2))


def test_a_car_is_turned_by_force_and_goes_back(run: Run) -> None:
    """It has the orientation at once, and drives back into its lane from there."""

    def body(s: Hill) -> Behaviour:
        wild = Orientation(roll=0.3, yaw=heading + 0.4)
        return Serial("skid", s.car.assign_orientation(orientation=wild), s.car.drive(duration=6.0))

    heading = run(hill(lambda s: s.car.drive(duration=0.1))).states("car")[0]["h"]
    done = run(hill(body))
    first, last = done.states("car")[0], done.states("car")[-1]
    assert (first["h"], first["roll"]) == pytest.approx((heading + 0.4, 0.3), abs=1e-6)
    assert last["offset"] == pytest.approx(0.0, abs=1e-6)
    assert abs(last["roll"]) < 0.06  # on its wheels again


def test_it_turns_as_fast_as_it_can(run: Run) -> None:
    """Half a turn per second: 0.5 rad are 0.16 s; without physics it is there at once."""
    wish = orientation(pitch=0.5, at="end")
    done = run(hill(lambda s: s.box.move(wish)))
    assert done.result.time == pytest.approx(0.2)
    assert done.states("box")[-1]["pitch"] == pytest.approx(0.5)
    done = run(hill(lambda s: s.box.move(wish, JUMP)))
    assert done.result.time == pytest.approx(0.05)


def test_relative_to_another_one(run: Run) -> None:
    wish = {"pitch": 0.2, "roll": 0.1, "at": "end"}
    done = run(hill(lambda s: s.box.move(orientation(**wish, relative_to=s.sign))))
    last = done.states("box")[-1]
    assert (last["pitch"], last["roll"]) == pytest.approx((0.3, -0.1))


def test_a_car_lies_on_the_road(run: Run) -> None:
    """Its pitch is that of the road; what asks for another one fails, unless it may jump."""
    on_road = orientation(pitch=0.0, roll=0.0, measure_by="relative_to_road")
    assert run(hill(lambda s: s.car.drive(on_road, duration=2.0))).result.status == "success"
    level = orientation(pitch=0.0, measure_by="absolute")
    done = run(hill(lambda s: s.car.drive(level, duration=2.0)))
    assert "car has a pitch of -" in done.result.reason
    done = run(hill(lambda s: s.car.drive(level, JUMP, duration=2.0)))
    last = done.states("car")[-1]
    assert last["pitch"] == 0.0
    assert last["roll"] == pytest.approx(-0.05, abs=1e-6)


def test_until_the_road_is_so(run: Run) -> None:
    """The reference line climbs by less than 0.01 from s = 80 m + 205.6 m on."""
    wish = orientation(pitch=0.0, measure_by="absolute", at="end")
    last = run(hill(lambda s: s.car.drive(wish))).states("car")[-1]
    assert abs(last["pitch"]) <= 0.01
    assert elevation(285.6)[1] == pytest.approx(0.01, abs=1e-4)
    assert last["s"] == pytest.approx(285.6, abs=6.0)  # the lane is longer than the line there


def test_it_has_to_hold_at_the_start(run: Run) -> None:
    wish = orientation(pitch=0.3, at="start")
    done = run(hill(lambda s: Serial("late", s.sky.clouds(cloudiness=4), s.car.drive(wish))))
    assert "car has a pitch of" in done.result.reason


def test_a_car_starts_at_an_angle(run: Run) -> None:
    """It heads 0.3 rad off its lane, and comes back to it."""

    class Askew(Hill):
        def placement(self) -> None:
            self.place(self.car, lane(1), position(distance=20.0), speed(5.0), yaw(0.3))

        def behavior(self) -> Behaviour:
            return Parallel("on", self.car.drive(), duration=8.0)

    states = run(Askew).states("car")
    assert states[0]["h"] == pytest.approx(0.3, abs=1e-6)
    assert states[-1]["offset"] == pytest.approx(0.0, abs=1e-6)


def test_without_a_word_it_counts_from_the_road(run: Run) -> None:
    """A box on the banked road: 0.1 rad more than the road has."""

    class OnRoad(Hill):
        def placement(self) -> None:
            self.place(self.car, lane(1), position(distance=200.0))
            self.place(self.box, lane(1), position(distance=240.0), orientation(0.2, roll=0.1))

        def behavior(self) -> Behaviour:
            return Parallel("stand", self.car.drive(), duration=0.5)

    done = run(OnRoad)
    car, box = done.states("car")[0], done.states("box")[0]
    assert car["roll"] == pytest.approx(-0.05, abs=1e-6)
    # Turned by 0.2 rad on a slope the road under it is tilted a little otherwise.
    assert box["roll"] == pytest.approx(0.05, abs=0.01)


class Straight(Scenario):
    """A car at 10 m/s on a straight road, at an angle to its lane from the first instant on."""

    name = "straight"
    source = "straight.osc"
    angle = math.radians(3.0)

    def declare(self) -> None:
        self.road = Map(map_file="highway")
        self.car = Vehicle()

    def placement(self) -> None:
        self.place(self.car, lane(2), position(150.0), speed(10.0), yaw(self.angle))


@pytest.mark.parametrize("degrees", [3.0, -5.0, 20.0])
def test_a_heading_is_held_from_the_start(run: Run, degrees: float) -> None:
    class Held(Straight):
        angle = math.radians(degrees)

        def behavior(self) -> Behaviour:
            return Parallel("on", self.car.drive(speed(10.0), yaw(self.angle)), duration=0.5)

    done = run(Held)
    assert done.result.status == "success"
    states = done.states("car")
    assert all(each["h"] == pytest.approx(math.radians(degrees), abs=1e-5) for each in states)
    aside = states[-1]["y"] - states[0]["y"]
    assert aside == pytest.approx(10.0 * 0.5 * math.sin(math.radians(degrees)), abs=1e-3)


def test_a_turned_car_changes_lanes(run: Run) -> None:
    class Changes(Straight):
        def behavior(self) -> Behaviour:
            return Serial("on", self.car.change_lane(num_of_lanes=1, side="left"))

    states = run(Changes).states("car")
    assert states[-1]["y"] - states[0]["y"] == pytest.approx(3.5, abs=0.01)


def test_a_car_across_its_lane_cannot_change_it(run: Run) -> None:
    class Across(Straight):
        angle = math.radians(40.0)

        def behavior(self) -> Behaviour:
            return Serial("on", self.car.change_lane(num_of_lanes=1, side="left"))

    assert "in no lane yet" in run(Across).result.reason
