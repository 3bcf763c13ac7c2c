"""Parts of actors: what a scenario says of them, and what the catalogue knows."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from osc2tx_runtime import (
    Axle,
    BehavioralModel,
    BmEngine,
    BoundingBox,
    Environment,
    HitchCoupler,
    HitchReceiver,
    Person,
    Point,
    Pose,
    StationaryObject,
    Trailer,
    Vehicle,
)
from osc2tx_runtime.domain.actors import Actor
from osc2tx_runtime.domain.points_and_poses import Orientation
from osc2tx_runtime.errors import ScenarioError, UnsupportedError
from osc2tx_runtime.opendrive import Pose as MapPose
from osc2tx_runtime.world import EmbeddedWorld
from osc2tx_runtime.world.commands import FollowCourse
from osc2tx_runtime.world.geometry.curve import Curve, Knot


def test_the_box_of_a_car_reaches_over_its_rear_axle() -> None:
    """The origin is the rear axle: the middle lies half a length before the rear end."""
    box = Vehicle(length=5.0, width=2.0, height=1.6, rear_overhang=1.0).bounding_box
    assert box == BoundingBox(Point(1.5, 0.0, 0.8), 5.0, 2.0, 1.6)
    assert Person().bounding_box.center == Point(0.0, 0.0, 0.5 * 1.75)


def test_a_box_can_be_said_as_a_whole() -> None:
    whole = BoundingBox(length=5.0, width=2.0, height=1.6)
    car = Vehicle(bounding_box=whole)
    assert (car.bounding_box.length, car.bounding_box.width) == (5.0, 2.0)
    assert car.size_from == "scenario"
    # A part of it, the rest is of the category.
    assert Vehicle(bounding_box=BoundingBox(width=1.7)).bounding_box.length == 4.6
    assert Vehicle(bounding_box=whole, length=5.0).bounding_box.length == 5.0
    with pytest.raises(ScenarioError, match="two values of its length: 5, 4"):
        Vehicle(bounding_box=whole, length=4.0)


def test_the_middle_of_the_box_says_where_the_rear_axle_is() -> None:
    car = Vehicle(length=5.0, center=Point(x=1.2))
    assert car.rear_overhang == pytest.approx(1.3)
    assert car.shape.rear == pytest.approx(1.3)
    assert car.bounding_box.center.x == pytest.approx(1.2)


@pytest.mark.parametrize(
    ("actor", "message"),
    [
        (Vehicle(center=Point(x=1.0, y=0.3)), "the y of the middle .* is 0 m.* not 0.3 m"),
        (Vehicle(center=Point(x=1.0, z=2.0)), "the z of the middle .* is 0.75 m"),
        (Vehicle(rear_overhang=1.0, center=Point(x=1.0)), "the x of the middle .* is 1.3 m"),
        (StationaryObject(center=Point(x=1.0)), "the x of the middle .* is 0 m"),
    ],
    ids=["aside", "above", "contradiction", "no vehicle"],
)
def test_a_box_that_is_elsewhere_is_refused(actor: Vehicle, message: str) -> None:
    with pytest.raises(UnsupportedError, match=message):
        actor.spec()


def test_the_centre_of_gravity_is_that_of_the_box_unless_said() -> None:
    car = Vehicle()
    assert car.center_of_gravity == car.bounding_box.center
    assert Vehicle(center_of_gravity=Point(1.0, 0.0, 0.5)).center_of_gravity.z == 0.5


def test_axles_of_the_category() -> None:
    front, rear = Vehicle().axles
    assert (front.position_x, rear.position_x) == (Vehicle().shape.wheelbase, 0.0)
    assert (front.number_of_wheels, rear.max_steering) == (2, 0.0)
    assert rear.position_z == 0.5 * rear.wheel_diameter
    assert [axle.number_of_wheels for axle in Vehicle(vehicle_category="bicycle").axles] == [1, 1]
    assert len(Trailer(vehicle_category="trailer").axles) == 1


def axles(wheelbase: float = 2.5, steering: float = 0.3) -> list[Axle]:
    return [
        Axle(max_steering=steering, position_x=wheelbase),
        Axle(max_steering=0.0, position_x=0.0),
    ]


def test_axles_of_the_scenario_say_how_it_turns() -> None:
    car = Vehicle(axles=axles())
    assert (car.shape.wheelbase, car.shape.steering) == (2.5, 0.3)
    # What they leave open is that of the category.
    assert car.axles[0].wheel_diameter == Vehicle().axles[0].wheel_diameter
    with pytest.raises(ScenarioError, match=r"the rear axle of .* is its origin"):
        Vehicle(axles=[Axle(position_x=1.0)]).spec()
    with pytest.raises(ScenarioError, match="has no axle"):
        Vehicle(axles=[]).spec()


def test_steering_limits_the_circle(car_world: Callable[..., EmbeddedWorld]) -> None:
    """A bicycle of wheelbase L and steering angle d turns with radius L / tan d."""
    world = car_world()
    car = Vehicle(axles=axles())
    car.id = "b"
    world.add(car.spec())
    world.place("b", MapPose(0.0, 100.0, 0.0, 0.0), 2.0)
    back = Curve([Knot(0.0, 0.0, 101.0, 0.0), Knot(20.0, -20.0, 101.0, 0.0)], smooth=False)
    world.command("b", "lateral", FollowCourse(back, 0.0, 20.0))
    for _ in range(10):
        world.step()
    radius = 2.5 / math.tan(0.3)
    assert world.motion("b").velocity.angular.yaw == pytest.approx(2.0 / radius)


def test_hitches_are_where_the_scenario_or_the_category_has_them() -> None:
    car = Vehicle()
    assert car.trailer_receiver.position_x == pytest.approx(-car.rear_overhang)
    assert car.trailer_receiver.hitch_type == "none"
    load = Trailer(vehicle_category="trailer")
    assert load.coupler.position_x == pytest.approx(6.0 - 1.2 + 0.5)
    assert load.coupler.hitch_type == "ball"
    assert Trailer(vehicle_category="semi_trailer").coupler.hitch_type == "fifth_wheel"
    said = Vehicle(trailer_receiver=HitchReceiver("pintle", position_x=-1.1, max_rotation=1.0))
    assert (said.trailer_receiver.position_x, said.shape.hitch) == (-1.1, 1.1)
    assert said.trailer_receiver.max_rotation == 1.0
    assert math.isnan(car.trailer_receiver.max_rotation)
    drawn = Trailer(coupler=HitchCoupler(position_x=4.0))
    assert (drawn.coupler.position_x, drawn.shape.drawbar) == (4.0, 4.0)


def test_what_something_is_for() -> None:
    assert Vehicle().intended_infrastructure == ["driving"]
    assert Vehicle(vehicle_category="tram").intended_infrastructure == ["tram"]
    assert Person().intended_infrastructure == ["sidewalk"]
    assert Vehicle(intended_infrastructure=["bus"]).intended_infrastructure == ["bus"]
    assert Vehicle(model="vehicle.dodge.charger_police").role == "police"
    assert Vehicle(role="military").role == "military"
    assert Vehicle(model="vehicle.ford.ambulance").vehicle_category == "van"
    assert Trailer(vehicle_category="semi_trailer").trailer_category == "semi_trailer"


@pytest.mark.parametrize(
    ("actor", "member"),
    [
        (Vehicle(), "color"),
        (Vehicle(), "geometry_reference"),
        (Vehicle(), "role"),
        (Vehicle(), "vehicle_category"),
        (Trailer(), "trailer_category"),
        (Environment(), "datetime"),
        (Environment(), "geodetic_position"),
    ],
)
def test_what_nobody_knows_is_an_error(actor: Actor, member: str) -> None:
    actor.id = "thing"
    with pytest.raises(ScenarioError, match=f"the {member} of thing is not stated"):
        getattr(actor, member)


def test_a_pose_of_point_and_orientation() -> None:
    pose = Pose(position=Point(1.0, 2.0, 3.0), orientation=Orientation(yaw=0.5, pitch=0.1))
    assert pose == Pose(1.0, 2.0, 3.0, pitch=0.1, yaw=0.5)
    assert (pose.position, pose.orientation.yaw) == (Point(1.0, 2.0, 3.0), 0.5)
    assert Pose(position=Point(1.0), yaw=0.2) == Pose(1.0, yaw=0.2)


def test_models_that_the_world_does_not_have_are_refused() -> None:
    with pytest.raises(UnsupportedError, match="no behavioral model `racer`; known: steady_driver"):
        BmEngine("racer")

    class Pilot(BmEngine):
        pass

    with pytest.raises(UnsupportedError, match="the content of Pilot means nothing"):
        Pilot()
    assert Vehicle().initial_bm == BehavioralModel(BmEngine("steady_driver"))


def test_single_places_of_lists() -> None:
    car = Vehicle(axles={0: Axle(max_steering=0.3)}, intended_infrastructure={1: "hov"})
    front, rear = car.axles
    assert (front.max_steering, front.position_x) == (0.3, Vehicle().shape.wheelbase)
    assert rear == Vehicle().axles[1]
    assert car.shape.steering == 0.3
    assert car.intended_infrastructure == ["driving", "hov"]
    with pytest.raises(ScenarioError, match="has 2 axles; to say something of another one, list"):
        Vehicle(axles={2: Axle()}).spec()
    with pytest.raises(ScenarioError, match=r"intended_infrastructure\[1\] of"):
        _ = Vehicle(intended_infrastructure={2: "hov"}).intended_infrastructure
