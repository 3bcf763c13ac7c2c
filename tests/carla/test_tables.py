"""Frames, units and words, without a server."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import pytest

from osc2tx_runtime.errors import SimulatorError
from osc2tx_runtime.opendrive import LanePosition, Pose, read_map
from osc2tx_runtime.simulators.carla.blueprints import attributes_of, blueprint_for
from osc2tx_runtime.simulators.carla.capabilities import IN_CARLA
from osc2tx_runtime.simulators.carla.cast import CastMember, member_of
from osc2tx_runtime.simulators.carla.frames import measurement_from, pose_from, transform_of
from osc2tx_runtime.simulators.carla.gains import CAR
from osc2tx_runtime.simulators.carla.level import with_spawn_points
from osc2tx_runtime.simulators.carla.motion_lights import MotionLights
from osc2tx_runtime.simulators.carla.surroundings import (
    FLAGS,
    lamps_for,
    losses_of,
    same_ids,
    state_for,
    weather_of,
)
from osc2tx_runtime.simulators.carla.tracking import SpeedControl
from osc2tx_runtime.world.actor_dimensions import limits_of, shape_of
from osc2tx_runtime.world.protocol import ActorSpec
from osc2tx_runtime.world.surroundings.traffic_light_lamps import BOXES

from .conftest import OWN_MAPS
from .runs import modules

carla: Any = pytest.importorskip("carla", reason="the carla package is not installed")

ANGLE = math.radians(30.0)


def library_rotation(pose: list[float]) -> Any:
    _, _, _, pitch, yaw, roll = pose
    return carla.Transform(carla.Location(), carla.Rotation(pitch, yaw, roll))


def test_axes_are_those_of_the_library() -> None:
    """Heading, nose and right side of an actor point the same way in both frames."""
    ahead = library_rotation(transform_of(Pose(0.0, 0.0, 0.0, ANGLE))).get_forward_vector()
    assert (ahead.x, -ahead.y) == pytest.approx((math.cos(ANGLE), math.sin(ANGLE)), abs=1e-6)
    nose_down = library_rotation(transform_of(Pose(0.0, 0.0, 0.0, 0.0, pitch=ANGLE)))
    assert nose_down.get_forward_vector().z == pytest.approx(-math.sin(ANGLE), abs=1e-6)
    right_down = library_rotation(transform_of(Pose(0.0, 0.0, 0.0, 0.0, roll=ANGLE)))
    assert right_down.get_right_vector().z == pytest.approx(-math.sin(ANGLE), abs=1e-6)


@pytest.mark.parametrize("h", [-3.0, -1.0, 0.0, 2.0, 3.1])
def test_poses_there_and_back(h: float) -> None:
    pose = Pose(12.0, -7.0, 1.5, h, 0.1, -0.2)
    assert pose_from(transform_of(pose, 1.3, 0.9), 1.3, 0.9) == pytest.approx(pose)


def test_a_turning_actor_moves_aside_ahead_of_its_origin() -> None:
    """Rigid body: v at r is v0 + w x r; 0.5 rad/s to the left at 2 m ahead is 1 m/s to the left."""
    state = [0.0] * 6 + [10.0, 0.0, 0.0] + [0.0, 0.0, -math.degrees(0.5)] + [0.0] * 3
    found = measurement_from(state, ahead=2.0)
    assert found.velocity == pytest.approx((10.0, 1.0, 0.0))
    assert found.turning is not None and found.turning[2] == pytest.approx(0.5)


@pytest.mark.parametrize(("axis", "sign"), [(0, -1.0), (1, 1.0), (2, -1.0)])
def test_rates_are_those_of_the_poses(axis: int, sign: float) -> None:
    """A rotation by the library's own formula, in its frame, against ours in a right-handed one.

    `v = w x r` holds in both by components; with y to the other side only the rate about y keeps
    its sign.
    """
    w, r = [0.0, 0.0, 0.0], (1.0, 2.0, 3.0)
    w[axis] = 0.3
    there = cross(w, r)
    expected = (there[0], -there[1], there[2])
    state = [0.0] * 9 + [math.degrees(each) for each in w] + [0.0] * 3
    turning = measurement_from(state).turning
    assert turning is not None
    assert cross(turning, (r[0], -r[1], r[2])) == pytest.approx(expected)
    assert turning[axis] == pytest.approx(sign * 0.3)


def cross(a: Any, b: Any) -> tuple[float, float, float]:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def member(**given: Any) -> CastMember:
    found = {"id": 7, "type": "vehicle.any", "box": [0.0, 2.3, 0.9, 0.7], **given}
    return member_of(spec(), found, "driven")


def test_a_wheelbase_is_from_the_wheels_that_steer_to_the_others() -> None:
    truck = [[530.0, 90.0, 60.0], [530.0, -90.0, 60.0]]
    truck += [[130.0, 90.0, 0.0], [130.0, -90.0, 0.0], [0.0, 90.0, 0.0], [0.0, -90.0, 0.0]]
    assert member(wheels=truck, box=[0.0, 4.0, 1.3, 1.5]).steering.wheelbase == pytest.approx(
        5.3 - 0.65
    )
    usual = spec().shape.wheelbase
    for unknown in ([], [[0.0, 0.0, 70.0]] * 2 + [[0.0, 0.0, 0.0]] * 2, [[9e3, 0.0, 0.0]] * 4):
        assert member(wheels=unknown).steering.wheelbase == usual


def test_gains_of_a_run_replace_those_of_the_category() -> None:
    found = {"id": 7, "type": "vehicle.any", "box": [0.0, 2.3, 0.9, 0.7]}
    gains = member_of(spec(), found, "driven", {"brake": 0.3}).speed.gains
    assert gains == CAR._replace(brake=0.3)


def test_a_box_without_size_is_that_of_the_scenario() -> None:
    shape = spec().shape
    found = member(box=[0.0, 0.0, 0.0, 0.0])
    assert found.size == pytest.approx((shape.length, shape.width, shape.height))
    assert found.ahead == pytest.approx(shape.rear - 0.5 * shape.length)


def test_steering_makes_up_for_the_curve_of_the_simulator() -> None:
    """At 60 km/h half of the lock is left: the same angle takes twice the steering."""
    curve = [[0.0, 1.0], [60.0, 0.5], [120.0, 0.5]]
    steering = member(wheels=[[0.0, 0.0, 70.0]], steering_curve=curve).steering
    plain = member(wheels=[[0.0, 0.0, 70.0]]).steering
    state = [0.0] * 6 + [60.0 / 3.6, 0.0, 0.0] + [0.0] * 6
    wanted = SimpleNamespace(v=16.7)
    goal: Any = SimpleNamespace(state=wanted, ahead=lambda far: Pose(far, 1.0, 0.0, 0.0))
    now = measurement_from(state)
    assert steering.steer(goal, now) == pytest.approx(2.0 * plain.steer(goal, now))


def test_flags_are_those_of_the_library() -> None:
    light = carla.VehicleLightState
    assert FLAGS["high_beam"] == int(light.Position | light.LowBeam | light.HighBeam)
    assert FLAGS["low_beam"] == int(light.Position | light.LowBeam)
    assert (FLAGS["position"], FLAGS["off"]) == (int(light.Position), int(light.NONE))


def test_weather_has_fields_of_the_library() -> None:
    sky = {"sun_elevation": ANGLE, "sun_azimuth": -ANGLE, "cloudiness": 8.0, "wind_speed": 15.0}
    weather = weather_of({**sky, "rain_intensity": 25e-3 / 3600.0, "visual_range": 50.0})
    assert all(hasattr(carla.WeatherParameters(), name) for name in weather)
    assert weather["sun_altitude_angle"] == pytest.approx(30.0)
    assert weather["sun_azimuth_angle"] == pytest.approx(330.0)
    assert (weather["cloudiness"], weather["fog_density"]) == (100.0, 100.0)
    assert weather["precipitation"] == pytest.approx(50.0)
    assert weather_of({"snow_intensity": 1e-6, "temperature": 270.0}) == {}
    assert any("from a direction of CARLA's own" in each for each in losses_of(sky))


def test_default_places_are_the_spawn_points_of_the_level() -> None:
    """In its order, without those that are on no lane; half a metre above the ground is on it."""
    road_map = read_map(OWN_MAPS / "highway.xodr")
    places = [LanePosition("1", -2, 77.0), LanePosition("1", -3, 12.5)]
    points = [transform_of(road_map.pose(place), up=0.6) for place in places]
    level = {"spawn_points": [points[0], [0.0, 9e3, 0.0, 0.0, 0.0, 0.0], points[1]]}
    assert with_spawn_points(road_map, level).spawn_points() == tuple(places)
    assert len(road_map.spawn_points()) > len(places)  # it stays as it was


YELLOW = ("is_off", "is_on", "is_off")


def test_what_a_light_shows() -> None:
    lamps = BOXES["1000001"]
    cases = {
        "Red": ("is_on", "is_off", "is_off"),
        "Yellow": ("is_on", "is_on", "is_off"),  # yellow with red, too
        "Green": ("is_off", "is_off", "is_on"),
        "Off": ("is_off", "is_off", "is_off"),
    }
    for state, shown in cases.items():
        assert state_for(lamps, shown) == state
        assert state in carla.TrafficLightState.names
        assert lamps_for(lamps, state) == (shown if state != "Yellow" else YELLOW)
    assert lamps_for(lamps, "Unknown") is None


def test_long_ids_of_lights_arrive_without_their_end() -> None:
    """What two of the map begin with could be either one."""
    long, twin = "signal_of_the_northern_approach_to_the_bridge", "x" * 32
    cut = [long[:32], twin, "7", ""]
    assert same_ids([long, f"{twin}1", f"{twin}2", "7", "8"], cut) == {long: long[:32], "7": "7"}


LIBRARY = {
    "vehicle.tesla.model3": {"color": ["0,0,0"], "role_name": [], "number_of_wheels": ["4"]},
    "vehicle.carlamotors.european_hgv": {"role_name": [], "number_of_wheels": ["4"]},
    "vehicle.diamondback.century": {
        "role_name": [],
        "number_of_wheels": ["2"],
        "base_type": ["bicycle"],
    },
    "vehicle.yamaha.yzf": {
        "role_name": [],
        "number_of_wheels": ["2"],
        "base_type": ["motorcycle"],
    },
    "walker.pedestrian.0001": {"role_name": []},
    "static.prop.box01": {},
}


def spec(kind: str = "vehicle", category: str | None = None, **given: Any) -> ActorSpec:
    shape, limits = shape_of(kind, category), limits_of(kind, category)
    return ActorSpec("it", kind, shape, limits, **given)


@pytest.mark.parametrize(
    ("actor", "blueprint"),
    [
        (spec(), "vehicle.tesla.model3"),
        (spec(category="heavy_truck"), "vehicle.carlamotors.european_hgv"),
        (spec(category="bicycle"), "vehicle.diamondback.century"),
        (spec(category="motorcycle"), "vehicle.yamaha.yzf"),
        (spec("person"), "walker.pedestrian.0001"),
        (spec("stationary_object"), "static.prop.box01"),
        (spec(model="vehicle.carlamotors.european_hgv"), "vehicle.carlamotors.european_hgv"),
    ],
)
def test_blueprints(actor: ActorSpec, blueprint: str) -> None:
    assert blueprint_for(actor, LIBRARY) == blueprint


def test_an_unknown_blueprint_has_a_neighbor() -> None:
    with pytest.raises(SimulatorError, match=r"did you mean vehicle\.tesla\.model3"):
        blueprint_for(spec(model="vehicle.tesla.model_3"), LIBRARY)


@pytest.mark.parametrize(
    ("written", "color"),
    [
        ("0,128,0", "0,128,0"),
        ("#ff8000", "255,128,0"),
        ("red", "255,0,0"),
        ("brown", "165,42,42"),  # of CSS
        ("Grey", "128,128,128"),
    ],
)
def test_colors(written: str, color: str) -> None:
    attributes, problem = attributes_of(
        spec(color=written), LIBRARY["vehicle.tesla.model3"], "hero"
    )
    assert (attributes, problem) == ({"role_name": "hero", "color": color}, None)


def test_a_color_that_cannot_be() -> None:
    library = LIBRARY["vehicle.carlamotors.european_hgv"]
    attributes, problem = attributes_of(spec(color="red"), library, "npc")
    assert attributes == {"role_name": "npc"} and problem is not None


def test_pedals() -> None:
    """Closed loop on a point mass: the speed is reached and kept, brakes hold who stands."""
    control, speed = SpeedControl(CAR), 0.0
    for _ in range(400):
        throttle, brake, reverse = control.pedals(10.0, 0.0, speed, 0.05)
        speed += (5.0 * throttle - 8.0 * brake) * 0.05
    assert speed == pytest.approx(10.0, abs=0.05) and not reverse
    assert control.pedals(0.0, 0.0, 0.2, 0.05)[:2] == (0.0, 0.6)
    throttle, brake, reverse = control.pedals(-2.0, -1.0, 0.0, 0.05)
    assert throttle > 0.0 and brake == 0.0 and reverse
    for wanted, speed in ((-1.0, 8.0), (1.0, -8.0)):  # no gear is changed before it stands
        throttle, brake, reverse = control.pedals(wanted, 0.0, speed, 0.05)
        assert throttle == 0.0 and brake > 0.0 and not reverse


def test_each_row_says_how_it_does_in_carla() -> None:
    """Its scenarios are among those that `test_exact` and `test_driven` run."""
    assert list(IN_CARLA) == [f"C{number:02}" for number in range(1, 39)]
    run = {path.stem[:3] for path in modules()}
    assert set(IN_CARLA) - run <= {"C35"}  # its scenarios have mistakes, so they have no module


# --- lights by the motion --------------------------------------------------------------------


def shown(states: list[tuple[float, float, float, bool]]) -> list[int]:
    """Return the flags after each speed, acceleration, speed across, and whether lanes differ."""
    lights = MotionLights()
    return [
        lights.after(
            SimpleNamespace(  # type: ignore[arg-type]
                state=SimpleNamespace(v=v, a=a, lateral_speed=aside), changes_lane=changes
            )
        )
        for v, a, aside, changes in states
    ]


def test_brake_lights() -> None:
    """On above 1.3 m/s^2, off up to 0.7 m/s^2, and on while it stands after braking."""
    decelerations = [0.0, 1.0, 1.4, 1.0, 0.7, 1.0]
    assert shown([(10.0, -a, 0.0, False) for a in decelerations]) == [0, 0, 8, 8, 0, 0]
    stop = [(1.0, -3.0, 0.0, False), (0.0, -3.0, 0.0, False), (0.0, 0.0, 0.0, False)]
    assert shown([*stop, (0.1, 1.0, 0.0, False)]) == [8, 8, 8, 0]
    assert shown([(0.0, 0.0, 0.0, False)]) == [0]  # parked


def test_reversing_lights() -> None:
    """Backwards an acceleration forwards is a deceleration."""
    assert shown([(-1.0, 0.0, 0.0, False), (-1.0, 2.0, 0.0, False)]) == [64, 64 | 8]
    assert shown([(-1.0, -2.0, 0.0, False)]) == [64]


def test_turn_lights() -> None:
    """From the command to the middle of the new lane; not for another place within the lane."""
    change = [(9.0, 0.0, 0.05, True), (9.0, 0.0, 1.0, True), (9.0, 0.0, 1.0, False)]
    assert shown([*change, (9.0, 0.0, 0.05, False)]) == [0, 32, 32, 0]
    assert shown([(9.0, 0.0, -1.0, True), (9.0, 0.0, -1.0, False)]) == [16, 16]
    assert shown([(9.0, 0.0, 1.0, False)]) == [0]
