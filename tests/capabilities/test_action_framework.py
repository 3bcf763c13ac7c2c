"""C01 to C04: how actions start, end, fail, whom they move, how they are put together."""

import pytest

from tests.capabilities.kit import DT, ROUNDED, Perform, cosine


def test_c01_actions_start_end_and_fail(perform: Perform) -> None:
    run = perform("C01_action_lifecycle")
    assert run.status == "success"
    speed_up = run.span("ego change_speed")
    assert (speed_up.start, speed_up.length) == (0.0, 2.0)  # 4 m/s at 2 m/s^2
    cruise = run.span("ego keep_speed")
    assert (cruise.start, cruise.length) == (2.0, 3.0)
    assert {line["v"] for line in run.during("ego", cruise)} == {14.0}
    impossible = run.span("ego change_lane")
    assert impossible.line["status"] == "fail"
    assert "9 driving lanes to the right" in impossible.line["reason"]
    # The world refuses at the first step after the start.
    assert impossible.length == DT
    assert {line["lane"] for line in run.states("ego")} == {-3}
    assert run.result["steps"] == round(6.0 / DT)  # 2 s, 3 s and the wait of 1 s


def test_c02_an_action_moves_the_actor_it_is_invoked_on(perform: Perform) -> None:
    run = perform("C02_actor_binding")
    assert run.status == "success"
    for actor, target in (("first", 16.0), ("second", 20.0)):
        span = run.span(f"{actor} change_speed")
        assert span.line["actor"] == actor
        assert (span.start, span.length) == (1.0, (target - 10.0) / 2.0)
        for line in run.states(actor):
            v = min(10.0 + 2.0 * max(line["t"] - 1.0, 0.0), target)
            assert line["v"] == pytest.approx(v, abs=ROUNDED)
    assert {line["v"] for line in run.states("third")} == {10.0}
    assert run.spans("third change_speed") == []


def test_c02_parts_of_actors_are_values(perform: Perform) -> None:
    run = perform("C02_actor_parts")
    assert run.status == "success"
    box = {"length": 5.0, "width": 2.0, "height": 1.6, "rear": 1.0}
    assert {name: run.box("ego")[name] for name in box} == box
    # Two lengths behind the van, at the speed of the police
    behind = run.at("van", 0.0)["s"] - run.at("ego", 0.0)["s"]
    assert behind == pytest.approx(2 * 5.0, abs=ROUNDED)
    assert run.at("ego", 0.0)["v"] == 11.0
    # Near when the gap is less than the wheelbase of 3 m
    close = run.event("close")

    def gap(t: float) -> float:
        return run.rear("van", t) - run.front("ego", t)

    assert gap(close) <= 3.0 + ROUNDED < gap(close - DT)
    noted = {line["name"]: line["value"] for line in run.of_kind("variable")}
    assert noted["middle"] == pytest.approx(0.5 * 5.0 - 1.0)
    assert noted["weight"] == pytest.approx(0.5 * 1.6)
    # The coupler is half a metre before the box of the trailer, the hitch at the end of the truck.
    load, van = run.box("load"), run.box("van")
    assert noted["hitch"] == pytest.approx(load["length"] - load["rear"] + 0.5 + van["rear"])


def test_c03_serials_in_a_parallel(perform: Perform) -> None:
    run = perform("C03_composition")
    assert run.status == "success"
    faster, slower = run.spans("ego change_speed")
    assert (faster.start, faster.end) == (0.0, 2.0)
    assert (slower.start, slower.end) == (2.0, 4.0)  # 14 to 8 m/s at 3 m/s^2
    assert run.span("other drive").end == 1.0
    swerve = run.span("other change_lane")
    assert (swerve.start, swerve.end) == (1.0, 6.0)
    assert run.result["steps"] == round(6.0 / DT)  # the longer branch
    # Each branch moves its own car only: way of two ramps, then 2 s at 8 m/s.
    way = 0.5 * (10 + 14) * 2 + 0.5 * (14 + 8) * 2 + 8 * 2
    assert run.last("ego")["s"] == pytest.approx(50.0 + way, abs=ROUNDED)
    assert (run.last("ego")["lane"], run.last("other")["lane"]) == (-4, -2)


def test_c04_durations_end_stretch_and_limit(perform: Perform) -> None:
    run = perform("C04_duration")
    assert run.status == "success"
    assert run.span("ego drive").length == 3.0
    faster, slower = run.spans("ego change_speed")
    assert (faster.start, faster.length) == (3.0, 4.0)
    for line in run.during("ego", faster):
        v = cosine(10.0, 20.0, 4.0, line["t"] - 3.0)
        assert line["v"] == pytest.approx(v, abs=ROUNDED)
    # 7 s + wait of 1 s; the block's 2 s are over at 9 s, when 10 m/s are 4 s away.
    assert (slower.start, slower.end) == (8.0, 9.0)
    assert slower.line["reason"] == "stopped"
    assert run.last("ego")["v"] == pytest.approx(18.0, abs=ROUNDED)
    assert run.result["steps"] == round(13.0 / DT)
