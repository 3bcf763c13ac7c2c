"""What reaches the server: calls, their order and their units."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from osc2tx_runtime.simulators.carla.motion_lights import BRAKE, LEFT, RIGHT

from .runs import GENERATED, in_carla, run_all, settings_for
from .stand_in.process import StandInProcess

CAPABILITIES = GENERATED / "capabilities"
Calls = list[tuple[str, list[Any]]]


def calls_of(stand_in: StandInProcess, name: str, control: str = "exact", **options: Any) -> Calls:
    """Run a module and return the calls it made."""
    (module,) = GENERATED.rglob(f"{name}.py")
    stand_in.calls()
    results = run_all(
        module, in_carla(settings_for(module), stand_in.port, control={"": control}, **options)
    )
    assert not [each for each in results.values() if isinstance(each, str)]
    return stand_in.calls()


def named(calls: Calls, name: str) -> list[list[Any]]:
    """Return the arguments of the calls of a name."""
    return [arguments for each, arguments in calls if each == name]


def commands(calls: Calls, number: int) -> list[list[Any]]:
    """Return the fields of one kind of command in batches."""
    return [
        fields
        for batch, _ in named(calls, "apply_batch")
        for ((kind, fields),) in batch
        if kind == number
    ]


def test_a_life(stand_in: StandInProcess) -> None:
    """Synchronous, spawned, a batch before each step, destroyed, settings as they were."""
    calls = calls_of(stand_in, "cut_in")
    names = [name for name, _ in calls]
    begin, end = (i for i, name in enumerate(names) if name == "set_episode_settings")
    assert calls[begin][1][0][:3] == [True, False, [True, 0.05]]
    assert calls[end][1][0][:3] == [False, False, [False]]
    spawns = [i for i, name in enumerate(names) if name == "spawn_actor"]
    assert len(spawns) == 2 and begin < spawns[0]
    steps = names[spawns[-1] + 1 : end]
    ticks = [i for i, name in enumerate(steps) if name == "tick_cue"]
    batches = [i for i, name in enumerate(steps) if name == "apply_batch"]
    assert len(ticks) == 431 + 2  # one to begin with, one that destroys
    assert all(steps[i - 1] == "apply_batch" for i in ticks)
    assert len(commands(calls, 1)) == 2 and batches[-1] == ticks[-1] - 1


def test_places_are_left_handed(stand_in: StandInProcess) -> None:
    """The ego starts at x = 200 m, y = -8.75 m, its rear axle 0.92 m from its rear end."""
    calls = calls_of(stand_in, "cut_in")
    _, ((x, y, z), (pitch, yaw, roll)) = commands(calls, 6)[0]
    assert (x, y, z) == pytest.approx((200.0 + 0.5 * 4.514 - 0.92, 8.75, 0.0), abs=1e-3)
    assert (pitch, yaw, roll) == (0.0, 0.0, 0.0)
    _, (_, (_, turned, _)) = commands(calls, 6)[-1]
    assert abs(turned) < 1e-3


def test_physics_is_off_where_places_are_written(stand_in: StandInProcess) -> None:
    exact, driven = (calls_of(stand_in, "cut_in", control) for control in ("exact", "driven"))
    assert [enabled for _, enabled in commands(exact, 14)] == [False, False]
    assert commands(driven, 14) == [] and len(commands(driven, 2)) >= 2 * 431


def test_pedals_are_pressed_one_at_a_time(stand_in: StandInProcess) -> None:
    for _, (throttle, steer, brake, *_) in commands(calls_of(stand_in, "cut_in", "driven"), 2):
        assert 0.0 <= throttle <= 1.0 and 0.0 <= brake <= 1.0 and -1.0 <= steer <= 1.0
        assert not (throttle and brake)


def test_role_names_models_and_colors(stand_in: StandInProcess) -> None:
    calls = calls_of(stand_in, "cut_in")
    roles = []
    for (_, kind, attributes), _ in named(calls, "spawn_actor"):
        values = {name: value for name, _, value in attributes}
        roles.append(values["role_name"])
        assert values["ros_name"] == values["role_name"]
        assert kind.startswith("vehicle.")
    assert roles == ["ego", "other"]


def test_lights_of_vehicles(stand_in: StandInProcess) -> None:
    """Automatic lights: low beam (position 1 + low beam 2) at dusk, and off again."""
    flags = [light for _, light in commands(calls_of(stand_in, "C16_automatic_lights"), 18)]
    assert 3 in [each[0] if isinstance(each, list) else each for each in flags]


@pytest.mark.parametrize("name", ["cut_in", "cut_in_and_evade"])
def test_turn_lights_are_on_the_side_to_which_it_moves(stand_in: StandInProcess, name: str) -> None:
    """The side is told by the places alone: along the x axis y grows to the right."""
    at: dict[int, float] = {}
    sides, lit = set[tuple[int, bool]](), dict[int, int]()
    for batch, _ in named(calls_of(stand_in, name), "apply_batch"):
        given = [(kind, fields) for ((kind, fields),) in batch]
        lit |= {f[0]: flags_of(f[1]) & (RIGHT | LEFT) for kind, f in given if kind == 18}
        for actor, ((_, y, _), (_, yaw, _)) in [fields for kind, fields in given if kind == 6]:
            assert abs(yaw) < 45.0
            if lit.get(actor) and abs(y - at[actor]) > 0.004:  # 0.08 m/s
                sides.add((lit[actor], y > at[actor]))
            at[actor] = y
    assert sides and sides <= {(RIGHT, True), (LEFT, False)}
    assert not any(lit.values())  # off in the end


def flags_of(lights: Any) -> int:
    return int(lights[0] if isinstance(lights, list) else lights)


def test_brake_lights_while_it_brakes(stand_in: StandInProcess) -> None:
    for control in ("exact", "driven"):
        calls = calls_of(stand_in, "C08_stationary", control)
        assert any(flags_of(lights) & BRAKE for _, lights in commands(calls, 18)), control


def test_weather(stand_in: StandInProcess) -> None:
    sent = [
        weather for (weather,) in named(calls_of(stand_in, "C16_weather"), "set_weather_parameters")
    ]
    assert sent and all(0.0 <= value <= 100.0 for weather in sent for value in weather[:4])
    assert any(weather[1] > 0.0 for weather in sent)  # it rains


def test_what_carla_does_not_show_of_the_weather_is_said_once(stand_in: StandInProcess) -> None:
    (module,) = GENERATED.rglob("C16_weather.py")
    results = run_all(module, in_carla(settings_for(module), stand_in.port)).values()
    said = [each for one in results if not isinstance(one, str) for each in one.warnings]
    assert "rain is a percentage in CARLA: 50 mm/h are its most" in said
    assert len(said) == len(set(said)) * len(results)
    assert [one for one in results if isinstance(one, str)] == []


def test_lights_under_autopilot(stand_in: StandInProcess) -> None:
    """The Traffic Manager drives; the lights are the scenario's: position 1 + low beam 2."""
    module = CAPABILITIES / "C16_automatic_lights.py"
    settings = replace(settings_for(module), expect=True)
    results = run_all(module, in_carla(settings, stand_in.port, control={"": "autopilot"}))
    assert not [each for each in results.values() if isinstance(each, str)]
    calls = stand_in.calls()
    assert 3 in [light for _, light in commands(calls, 18)]
    assert commands(calls, 2)  # pedals, by the Traffic Manager


def test_slippery_roads_are_a_trigger(stand_in: StandInProcess) -> None:
    """Its friction is the tyres' 3.5 times the road's, its size in centimetres."""
    calls = calls_of(stand_in, "C18_road_conditions", "driven")
    triggers = [
        {name: value for name, _, value in attributes}
        for (_, kind, attributes), _ in named(calls, "spawn_actor")
        if kind == "static.trigger.friction"
    ]
    assert triggers
    assert {round(float(each["friction"]), 3) for each in triggers} <= {2.1, 0.7, 0.35}
    assert all(float(each["extent_x"]) == 1e6 for each in triggers)


def test_traffic_lights_are_stopped_once_and_switched(stand_in: StandInProcess) -> None:
    calls = calls_of(stand_in, "C17_traffic_signals")
    names = [name for name, _ in calls]
    assert named(calls, "freeze_all_traffic_lights") == [[True], [False]]
    assert names.index("freeze_all_traffic_lights") < names.index("set_traffic_light_state")
    red, green = 0, 2
    states = [state for _, state in named(calls, "set_traffic_light_state")]
    assert red in states and green in states


def test_cycles_begin_with_the_run(stand_in: StandInProcess) -> None:
    """Whatever the lights showed before; another client that makes the steps has them its way."""
    calls = calls_of(stand_in, "C17_traffic_signals")
    names = [name for name, _ in calls]
    assert names.count("reset_all_traffic_lights") == 1
    settings = next(arguments[0] for name, arguments in calls if name == "set_episode_settings")
    assert settings[3]  # substeps


def test_people_walk(stand_in: StandInProcess) -> None:
    walks = commands(calls_of(stand_in, "pedestrian_crossing", "driven"), 4)
    assert walks
    for _, ((x, y, z), speed, jump) in walks:
        assert x**2 + y**2 == pytest.approx(1.0, abs=1e-5) and z == 0.0 and not jump
        assert 0.0 <= speed < 4.0
