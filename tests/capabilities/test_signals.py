"""C17: traffic lights, and drivers that keep to them and to who is on the road."""

import pytest

from tests.capabilities.kit import DT, ROUNDED, Perform


def test_c17_a_car_stops_at_a_red_light_and_goes_when_it_is_green(perform: Perform) -> None:
    run = perform("C17_traffic_signals")
    assert run.status == "success"
    signals = [(line["t"], line["signal"], line["state"]) for line in run.of_kind("signal")]
    # Controller 2 of the map has the lights 102 and 104.
    assert signals == [
        (0.0, "101", "stop"),
        (0.0, "102", "go"),
        (0.0, "104", "go"),
        (14.0, "101", "go"),
        (14.0, "102", "stop"),
        (14.0, "104", "stop"),
    ]
    states = run.states("ego")
    standing = [line for line in states if line["v"] == 0.0]
    assert {line["road"] for line in standing} == {"1"}
    # The light stands at s = 149 m; the front comes to a stand one metre before it.
    assert run.front("ego", standing[0]["t"]) == pytest.approx(149.0 - 1.0, abs=0.01)
    # With half of the 8 m/s^2 of a car, so 12 m/s take 18 m; a step of 0.6 m more at most.
    braking = [line for line in states if line["t"] < 14.0 and 0.0 < line["v"] < 12.0]
    begin = run.front("ego", braking[0]["t"] - DT)
    assert 0.0 <= 148.0 - 12.0**2 / (2 * 4.0) - begin <= 0.6 + ROUNDED
    assert min(line["a"] for line in braking) == pytest.approx(-4.0, rel=0.05)
    # Until it is green it stands, then it is through.
    assert 14.0 <= standing[-1]["t"] <= 14.0 + DT  # seen at one step, driven by the next
    assert run.last("ego")["road"] != "1"


def test_c17_lamps_boxes_and_groups(perform: Perform) -> None:
    run = perform("C17_signal_lamps")
    assert run.status == "success"
    on, off = "is_on", "is_off"
    shown = [(e["t"], e["signal"], e["bulbs"], e["state"]) for e in run.of_kind("signal")]
    # red, yellow, green from top to bottom; red with yellow announces green
    assert shown == [
        (0.0, "101", [on, off, off], "stop"),
        (1.0, "101", [on, on, off], "attention"),
        (2.0, "101", [off, off, on], "go"),
        (2.0, "103", [off, off, on], "go"),
    ]


def test_c17_cycles_run_by_themselves(perform: Perform) -> None:
    run = perform("C17_signal_cycles")
    assert run.status == "success"
    assert run.span("lights play_cycles").length == 12.0
    for signal in ("101", "103"):  # both boxes of the group
        changes = [(e["t"], e["state"]) for e in run.of_kind("signal") if e["signal"] == signal]
        # 3 s of green and 5 s of red, again and again
        assert changes == [(0.0, "go"), (3.0, "stop"), (8.0, "go"), (11.0, "stop")]


def test_c17_what_lights_show_triggers(perform: Perform) -> None:
    run = perform("C17_signal_conditions")
    assert run.status == "success"
    assert run.event("green") == 2.0
    assert run.event("all_red") == 3.0
    assert run.result["steps"] == round((3.0 + 1.0) / DT)


def test_c17_a_careful_driver_stops_for_a_person_and_drives_on(perform: Perform) -> None:
    run = perform("C17_careful_crossing")
    assert run.status == "success"
    assert run.of_kind("collision") == []
    onward, still = run.spans("walker walk")[1], run.spans("walker remain_stationary")[1]
    ego, walker = run.states("ego"), run.states("walker")
    # The person is in the way from 0.3 m beside the car's width on: half of both and that.
    reach = 0.5 * run.box("ego")["width"] + 0.5 * run.box("walker")["width"] + 0.3
    lane = ego[0]["y"]
    in_way = [w["t"] for w in walker if abs(w["y"] - lane) <= reach]
    free = next(w["t"] for w in walker if w["y"] > lane + reach)
    braking = [e["t"] for e in ego if e["a"] < 0.0]
    assert braking[0] == pytest.approx(in_way[0] + DT, abs=1e-9)
    assert still.start < in_way[-1]
    # It stands 2 m, the least gap of the model, before the person, within 5 cm, and does not back.
    stand = run.at("ego", onward.start)
    assert stand["v"] == pytest.approx(0.0, abs=0.01)
    near_side = walker[0]["x"] - 0.5 * run.box("walker")["length"]
    assert near_side - run.front("ego", onward.start) == pytest.approx(2.0, abs=0.05)
    assert min(e["v"] for e in ego) >= 0.0
    assert min(e["a"] for e in ego) > -8.0
    # Then with half of the 4 m/s^2 of a car up to the speed that it is to have.
    gain = [e for e in ego if e["a"] > 0.1]
    assert gain[0]["t"] == pytest.approx(free + DT, abs=1e-9)
    assert gain[5]["a"] == pytest.approx(2.0, abs=1e-4)
    assert run.last("ego")["v"] == pytest.approx(40.0 / 3.6, abs=ROUNDED)
