"""How things move in the stand-in, against closed forms."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

carla: Any = pytest.importorskip("carla", reason="the carla package is not installed")

from tests.processes import forked

from .stand_in.blueprints import BLUEPRINTS, TYRE_FRICTION
from .stand_in.dynamics import BRAKING, MAX_STEER, THROTTLE
from .stand_in.process import StandInProcess
from .test_stand_in_wire import spawned

CAR = "vehicle.tesla.model3"


def steps(world: Any, number: int) -> None:
    for _ in range(number):
        world.tick()


def forwards(actor: Any, speed: float) -> Any:
    """Return a velocity along the axis of an actor."""
    axis = actor.get_transform().get_forward_vector()
    return carla.Vector3D(axis.x * speed, axis.y * speed, 0.0)


def test_full_throttle_and_full_brake(world: Any) -> None:
    actor = spawned(world, CAR)
    actor.apply_control(carla.VehicleControl(throttle=1.0))
    steps(world, 20)
    assert actor.get_velocity().length() == pytest.approx(THROTTLE["car"], rel=0.01)  # after 1 s
    begin, speed = actor.get_location(), actor.get_velocity().length()
    actor.apply_control(carla.VehicleControl(brake=1.0))
    steps(world, 40)
    assert actor.get_velocity().length() == 0.0
    way = actor.get_location().distance(begin)
    assert way == pytest.approx(speed**2 / (2.0 * BRAKING), rel=0.02)


@pytest.mark.parametrize("steer", (-0.1, 0.1))
def test_the_circle_of_a_steering_angle(world: Any, steer: float) -> None:
    """Yaw rate = v tan(angle) / wheelbase at the rear axle; to the right is clockwise.

    At 60 km/h the curve of the steering leaves three quarters of the lock: less with the speed.
    """
    actor = spawned(world, CAR)
    actor.apply_control(carla.VehicleControl(steer=steer))
    actor.set_target_velocity(forwards(actor, 5.0))
    steps(world, 40)
    turn, velocity = actor.get_angular_velocity().z, actor.get_velocity()
    axis = actor.get_transform().get_forward_vector()
    speed = velocity.x * axis.x + velocity.y * axis.y
    wheelbase = 2.0 * BLUEPRINTS[CAR].axle
    share = 1.0 - 0.25 * speed / (60.0 / 3.6)
    expected = math.degrees(speed * math.tan(steer * share * MAX_STEER) / wheelbase)
    assert turn == pytest.approx(expected, rel=0.01)
    assert math.copysign(1.0, turn) == math.copysign(1.0, steer)


def test_tyres_hold_no_more_than_the_friction_circle(world: Any) -> None:
    actor = spawned(world, CAR)
    actor.apply_control(carla.VehicleControl(steer=1.0))
    actor.set_target_velocity(forwards(actor, 20.0))
    for _ in range(60):
        world.tick()
        speed = actor.get_velocity().length()
        assert speed * math.radians(actor.get_angular_velocity().z) < 9.81 * 1.1


def test_a_trigger_of_friction_makes_brakes_weaker(world: Any) -> None:
    actor = spawned(world, CAR)
    blueprint = world.get_blueprint_library().find("static.trigger.friction")
    blueprint.set_attribute("friction", str(0.2 * TYRE_FRICTION))
    for axis in "xyz":
        blueprint.set_attribute(f"extent_{axis}", "100000")  # 1 km, in centimetres
    trigger = world.spawn_actor(blueprint, actor.get_transform())
    actor.set_target_velocity(forwards(actor, 10.0))
    actor.apply_control(carla.VehicleControl(brake=1.0))
    steps(world, 20)
    assert actor.get_velocity().length() == pytest.approx(10.0 - 0.2 * 9.81, abs=0.1)
    trigger.destroy()
    steps(world, 25)
    assert actor.get_velocity().length() == 0.0


def test_without_physics_a_place_is_exact_and_nothing_has_a_velocity(world: Any) -> None:
    actor = spawned(world, CAR)
    actor.set_simulate_physics(False)
    actor.set_transform(
        carla.Transform(carla.Location(1.0, 2.0, 3.0), carla.Rotation(4.0, 5.0, 6.0))
    )
    actor.set_target_velocity(carla.Vector3D(7.0, 0.0, 0.0))
    steps(world, 1)
    at = actor.get_transform()
    assert (at.location.x, at.location.y, at.location.z) == (1.0, 2.0, 3.0)
    assert (at.rotation.pitch, at.rotation.yaw, at.rotation.roll) == (4.0, 5.0, 6.0)
    assert actor.get_velocity().length() == 0.0


def test_a_walker_walks_where_it_is_told(world: Any) -> None:
    actor = spawned(world, "walker.pedestrian.0001")
    begin = actor.get_location()
    actor.apply_control(carla.WalkerControl(carla.Vector3D(0.0, 1.0, 0.0), 1.5, False))
    steps(world, 20)
    assert actor.get_location().y - begin.y == pytest.approx(1.5, abs=1e-3)
    assert actor.get_transform().rotation.yaw == pytest.approx(90.0)


def test_contacts_are_told_once(
    world: Any, stand_in: StandInProcess, wait: Callable[[Callable[[], bool]], None]
) -> None:
    one, other = spawned(world, CAR, 0), spawned(world, "vehicle.audi.tt", 1)
    blueprint = world.get_blueprint_library().find("sensor.other.collision")
    sensor, events = world.spawn_actor(blueprint, carla.Transform(), attach_to=one), []
    sensor.listen(events.append)
    wait(lambda: stand_in.ask("stand_in_listeners") == 1)
    other.set_transform(one.get_transform())
    steps(world, 3)
    wait(lambda: bool(events))
    sensor.stop()
    assert [(event.actor.id, event.other_actor.id) for event in events] == [(one.id, other.id)]


def test_the_traffic_manager_of_the_library_drives(world: Any, stand_in: StandInProcess) -> None:
    """In a process of its own: the library does not survive its manager and another level."""

    def drive() -> None:
        client = carla.Client("127.0.0.1", stand_in.port)
        manager = client.get_trafficmanager()
        manager.set_synchronous_mode(True)
        manager.set_random_device_seed(1)
        level = client.get_world()
        actor = spawned(level, CAR)
        actor.set_autopilot(True, manager.get_port())
        begin = actor.get_location()
        steps(level, 100)
        print(actor.get_location().distance(begin))

    ended = forked(drive)
    assert ended.code == 0, ended.err
    assert float(ended.out.split()[-1]) > 5.0


def test_the_same_run_twice(world: Any) -> None:
    def run() -> list[tuple[float, ...]]:
        actor = spawned(world, CAR)
        actor.apply_control(carla.VehicleControl(throttle=0.7, steer=0.02))
        places = []
        for _ in range(30):
            world.tick()
            at = actor.get_transform()
            places.append((at.location.x, at.location.y, at.rotation.yaw))
        actor.destroy()
        return places

    assert run() == run()
