"""Sensor stacks: names, axes, order of calls, and the topics that will be there."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from osc2tx_runtime import RunSettings
from osc2tx_runtime.errors import InputError, SettingsError
from osc2tx_runtime.simulators.carla.sensors import SensorStacks, read_stack, topics_of

from .runs import GENERATED, in_carla, run_all
from .stand_in.process import StandInProcess

STACK = [
    {
        "id": "imu_sensor",
        "type": "sensor.other.imu",
        "spawn_point": {"x": 0.5, "y": 1.0, "z": 2.0, "roll": 1.0, "pitch": 5.0, "yaw": 90.0},
    },
    {
        "id": "front",
        "type": "sensor.camera.rgb",
        "spawn_point": {"x": 2.0, "z": 1.5},
        "attributes": {"image_size_x": 640, "fov": 70.0},
    },
]


@pytest.fixture
def stack(tmp_path: Path) -> Path:
    file = tmp_path / "stack.json"
    file.write_text(json.dumps({"sensors": STACK}), encoding="utf-8")
    return file


def test_they_are_attached_and_published(stand_in: StandInProcess, stack: Path) -> None:
    """Attributes, spawn, then ROS; y, pitch and yaw of ROS have the other sign in CARLA."""
    stand_in.calls()
    options: dict[str, Any] = {"sensors": {"ego": stack}}
    settings = in_carla(RunSettings(max_time=1.0), stand_in.port, **options)
    run_all(GENERATED / "cut_in.py", settings)
    calls = stand_in.calls()
    names = [name for name, _ in calls]
    imu, camera = (given for name, given in calls if name == "spawn_actor_with_parent")
    (_, kind, attributes), (place, turn), parent, *_ = imu
    values = {name: value for name, _, value in attributes}
    assert kind == "sensor.other.imu"
    assert (values["role_name"], values["ros_name"]) == ("imu_sensor", "imu_sensor")
    assert (place, turn) == ([0.5, -1.0, 2.0], [-5.0, -90.0, 1.0])
    values = {name: value for name, _, value in camera[0][2]}
    assert (values["image_size_x"], float(values["fov"])) == ("640", 70.0)
    assert parent == camera[2]
    assert names.count("enable_sensor_for_ros") == 2
    order = [n for n in names if n in ("spawn_actor_with_parent", "enable_sensor_for_ros")]
    assert order == ["spawn_actor_with_parent", "enable_sensor_for_ros"] * 2
    assert stand_in.ask("stand_in_actors") == {}


def test_topics_are_those_of_the_native_ros_2(stack: Path) -> None:
    imu, camera = read_stack(stack)
    assert topics_of("hero", imu) == ("/carla/hero/imu_sensor",)
    assert topics_of("hero", camera) == ("/carla/hero/front/image", "/carla/hero/front/camera_info")


def test_the_table_says_what_is_missing(stack: Path) -> None:
    lines = list(SensorStacks({"ego": stack}).table({"ego": "hero"}))
    assert lines[0].startswith("/carla/hero/imu_sensor")
    assert any("vehicle_control_cmd" in line for line in lines)
    assert "not in CARLA 0.9.16: /carla/hero/odometry" in lines[-1]


@pytest.mark.parametrize(
    ("content", "problem"),
    [
        ("{", "cannot be read"),
        ("{}", "a list of sensors is missing"),
        ('[{"id": "a"}]', "needs id, type"),
        ('[{"id": "a", "type": "vehicle.tesla.model3"}]', "not a blueprint of a sensor"),
        (
            '[{"id": "a", "type": "sensor.other.imu"}, {"id": "a", "type": "sensor.other.gnss"}]',
            "two",
        ),
    ],
)
def test_stacks_that_are_none(tmp_path: Path, content: str, problem: str) -> None:
    file = tmp_path / "stack.json"
    file.write_text(content, encoding="utf-8")
    with pytest.raises(InputError, match=problem):
        read_stack(file)


def test_the_run_prints_the_topics(
    stand_in: StandInProcess, stack: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    options: dict[str, Any] = {"sensors": {"ego": stack}}
    settings = in_carla(RunSettings(max_time=0.5), stand_in.port, **options)
    run_all(GENERATED / "cut_in.py", settings)
    assert "/carla/ego/imu_sensor  (sensor.other.imu, expected)\n" in capsys.readouterr().out


def test_sensors_of_nobody(stand_in: StandInProcess, stack: Path) -> None:
    options: dict[str, Any] = {"sensors": {"nobody": stack}}
    found = run_all(GENERATED / "cut_in.py", in_carla(RunSettings(), stand_in.port, **options))
    assert "the scenario has no such actor" in str(found["cut_in"])
    assert SettingsError.exit_code == 2
