"""What travels: fields keep their places both ways, and calls reach the server."""

from __future__ import annotations

import contextlib
from pathlib import Path
from typing import Any

import pytest

carla: Any = pytest.importorskip("carla", reason="the carla package is not installed")

from .conftest import OWN_MAPS
from .stand_in.process import StandInProcess

WEATHER = (
    *("cloudiness", "precipitation", "precipitation_deposits", "wind_intensity"),
    *("sun_azimuth_angle", "sun_altitude_angle", "fog_density", "fog_distance", "fog_falloff"),
    *("wetness", "scattering_intensity", "mie_scattering_scale", "rayleigh_scattering_scale"),
    "dust_storm",
)


def spawned(world: Any, name: str, index: int = 0, **attributes: str) -> Any:
    """Spawn an actor at a point of the level and go on by a step."""
    blueprint = world.get_blueprint_library().find(name)
    for key, value in attributes.items():
        blueprint.set_attribute(key, value)
    actor = world.spawn_actor(blueprint, world.get_map().get_spawn_points()[index])
    world.tick()
    return actor


def test_versions_are_those_of_the_client(client: Any) -> None:
    assert client.get_server_version() == client.get_client_version() == "0.9.16"


def test_weather_keeps_all_values(world: Any) -> None:
    sent = carla.WeatherParameters(**{name: i + 0.5 for i, name in enumerate(WEATHER)})
    world.set_weather(sent)
    got = world.get_weather()
    assert [getattr(got, name) for name in WEATHER] == [i + 0.5 for i in range(14)]


def test_settings_keep_all_values(world: Any) -> None:
    settings = world.get_settings()
    settings.max_substeps, settings.max_substep_delta_time = 16, 0.005
    settings.no_rendering_mode, settings.tile_stream_distance = True, 1234.0
    world.apply_settings(settings)
    got = world.get_settings()
    assert (got.max_substeps, got.max_substep_delta_time) == (16, 0.005)
    assert (got.synchronous_mode, got.fixed_delta_seconds) == (True, 0.05)
    assert (got.no_rendering_mode, got.tile_stream_distance) == (True, 1234.0)


def test_attributes_and_places_come_back(world: Any) -> None:
    actor = spawned(world, "vehicle.tesla.model3", role_name="hero", color="255,255,255")
    found = world.get_actors().filter("vehicle.*")[0]
    assert (found.id, found.type_id) == (actor.id, "vehicle.tesla.model3")
    assert (found.attributes["role_name"], found.attributes["color"]) == ("hero", "255,255,255")
    point = world.get_map().get_spawn_points()[0]
    assert found.get_location().distance(point.location) < 1.0  # it fell on the road
    turn, wanted = found.get_transform().rotation, point.rotation
    assert (turn.pitch, turn.yaw) == pytest.approx((wanted.pitch, wanted.yaw), abs=1e-3)


def test_an_occupied_place_is_refused(world: Any) -> None:
    spawned(world, "vehicle.tesla.model3")
    blueprint = world.get_blueprint_library().find("vehicle.audi.tt")
    point = world.get_map().get_spawn_points()[0]
    with pytest.raises(RuntimeError, match="collision at spawn position"):
        world.spawn_actor(blueprint, point)


def test_a_control_is_seen_as_it_was_sent(world: Any) -> None:
    actor = spawned(world, "vehicle.tesla.model3")
    actor.apply_control(
        carla.VehicleControl(
            throttle=0.25,
            steer=-0.5,
            brake=0.125,
            hand_brake=True,
            reverse=True,
            manual_gear_shift=True,
            gear=3,
        )
    )
    world.tick()
    seen = actor.get_control()
    assert (seen.throttle, seen.steer, seen.brake) == (0.25, -0.5, 0.125)
    assert (seen.hand_brake, seen.reverse, seen.manual_gear_shift, seen.gear) == (
        True,
        True,
        True,
        3,
    )


def test_lights_of_a_vehicle(world: Any) -> None:
    actor, light = spawned(world, "vehicle.tesla.model3"), carla.VehicleLightState
    actor.set_light_state(light(light.LowBeam | light.Fog))
    assert int(actor.get_light_state()) == int(light.LowBeam | light.Fog) == 130


def test_traffic_lights_by_their_sign(world: Any) -> None:
    light = world.get_actors().filter("traffic.traffic_light*")[0]
    assert world.get_traffic_light_from_opendrive_id(light.get_opendrive_id()).id == light.id
    light.set_red_time(1.0)
    light.set_yellow_time(2.0)
    light.set_green_time(4.0)
    light.set_state(carla.TrafficLightState.Green)
    world.tick()
    assert (light.get_red_time(), light.get_yellow_time(), light.get_green_time()) == (
        1.0,
        2.0,
        4.0,
    )
    assert light.state == carla.TrafficLightState.Green
    for _ in range(80):
        world.tick()
    assert light.state == carla.TrafficLightState.Yellow
    light.freeze(True)
    for _ in range(80):
        world.tick()
    assert light.is_frozen() and light.state == carla.TrafficLightState.Yellow


def test_a_batch_spawns_and_drives_at_once(world: Any, client: Any) -> None:
    blueprint = world.get_blueprint_library().find("vehicle.audi.tt")
    points = world.get_map().get_spawn_points()
    command = carla.command
    spawn = command.SpawnActor(blueprint, points[0]).then(
        command.ApplyVehicleControl(command.FutureActor, carla.VehicleControl(throttle=1.0))
    )
    made, refused = client.apply_batch_sync([spawn, command.DestroyActor(4711)], True)
    assert "unable to find actor 4711" in refused.error and not made.error
    assert world.get_actor(made.actor_id).get_control().throttle == 1.0


def test_children_go_with_their_parent(world: Any, stand_in: StandInProcess) -> None:
    actor = spawned(world, "vehicle.tesla.model3")
    blueprint = world.get_blueprint_library().find("sensor.other.imu")
    world.spawn_actor(blueprint, carla.Transform(), attach_to=actor)
    assert actor.destroy()
    assert stand_in.ask("stand_in_actors") == {}


def test_maps_are_loaded_and_generated(client: Any, stand_in: StandInProcess) -> None:
    assert client.load_world("curve").get_map().name.endswith("curve")
    text = (OWN_MAPS / "merge.xodr").read_text(encoding="utf-8")
    generated = client.generate_opendrive_world(text, carla.OpendriveGenerationParameters())
    assert generated.get_map().to_opendrive() == text
    with pytest.raises(RuntimeError, match="not found"):
        client.load_world("Atlantis")


def test_what_nobody_knows_is_an_error_and_counted(tmp_path: Path) -> None:
    with StandInProcess([OWN_MAPS], "highway", "--version", "0.9.15") as process:
        client = carla.Client("127.0.0.1", process.port)
        assert client.get_server_version() == "0.9.15"
        with contextlib.suppress(RuntimeError):
            client.show_recorder_file_info(str(tmp_path), False)
        assert process.ask("stand_in_unknown") == {"show_recorder_file_info": 1}
        assert process.calls()[-1][0] == "show_recorder_file_info"
