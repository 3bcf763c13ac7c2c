"""Actions in whole scenarios: their effect, measured in the trace."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import (
    Behaviour,
    Map,
    Parallel,
    Person,
    Point,
    Scenario,
    Serial,
    Wait,
    elapsed,
)
from osc2tx_runtime.errors import ScenarioError, SlotConflict, UnsupportedError
from osc2tx_runtime.modifiers import (
    acceleration,
    keep_lane,
    lane,
    lateral,
    physical_movement,
    position,
    speed,
    yaw,
)
from tests.runtime.world.two_cars import TwoCars, scenario

Run = Callable[..., Any]


@pytest.mark.parametrize(
    ("options", "end", "peak"),
    [
        ({"rate_profile": "constant", "rate_peak": 2.0}, 5.0, 2.0),
        ({"rate_profile": "constant", "duration": 4.0}, 4.0, 2.5),
        ({"rate_profile": "smooth", "rate_peak": 3.0}, math.pi / 2 * 10 / 3, 3.0),
        ({"rate_profile": "smooth", "duration": 5.0}, 5.0, math.pi / 2 * 10 / 5),
        ({"rate_profile": "asap"}, 2.9, 4.0),
        ({}, 5.2, 2.0),
    ],
)
def test_change_speed_takes_its_time(
    run: Run, options: dict[str, Any], end: float, peak: float
) -> None:
    done = run(scenario(lambda s: s.a.change_speed(target=20.0, **options)))
    assert done.result.status == "success"
    assert done.result.time == pytest.approx(end, abs=0.05)
    states = done.states("a")
    assert states[-1]["v"] == 20.0
    assert max(e["a"] for e in states) == pytest.approx(peak, rel=0.01)


def test_change_to_the_present_speed_takes_no_time(run: Run) -> None:
    assert run(scenario(lambda s: s.a.change_speed(target=10.0))).result.steps == 0


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        ({"rate_peak": 20.0}, "rate_peak 20 m/s^2 is not between 0 and 12 m/s^2"),
        (
            {"rate_profile": "constant", "rate_peak": 2.0, "duration": 3.0},
            "with rate_peak 2 m/s^2 it takes 5.00 s, not 3 s",
        ),
    ],
)
def test_change_speed_that_cannot_be(run: Run, options: dict[str, Any], reason: str) -> None:
    done = run(scenario(lambda s: s.a.change_speed(target=20.0, **options)))
    assert done.result.status == "failure"
    assert reason in done.result.reason


def test_lane_and_speed_change_side_by_side(run: Run) -> None:
    done = run(
        scenario(
            lambda s: Serial(
                "all",
                Parallel(
                    "both",
                    s.a.change_lane(side="left"),
                    s.a.change_speed(target=15.0, rate_profile="smooth"),
                ),
                Wait(elapsed(2.0)),
            )
        )
    )
    last = done.states("a")[-1]
    assert (last["lane"], last["offset"], last["v"]) == (-2, 0.0, 15.0)
    assert last["s"] - done.states("a")[-2]["s"] == pytest.approx(0.75, abs=1e-5)


def test_change_lane_beside_a_reference(run: Run) -> None:
    done = run(scenario(lambda s: s.a.change_lane(num_of_lanes=2, side="left", reference=s.b)))
    assert done.states("a")[-1]["lane"] == -1


def test_impossible_lane_change_fails_with_a_reason(run: Run) -> None:
    done = run(scenario(lambda s: s.a.change_lane(num_of_lanes=2, side="right")))
    assert done.result.status == "failure"
    assert "there are not 2 driving lanes to the right of lane -3" in done.result.reason


def test_lane_change_in_a_given_time(run: Run) -> None:
    done = run(scenario(lambda s: s.a.change_lane(side="right", duration=5.0)))
    assert done.result.status == "success"
    assert done.result.steps == 100


def test_follow_lane_holds_an_offset(run: Run) -> None:
    done = run(scenario(lambda s: s.a.follow_lane(offset=0.5, duration=4.0)))
    assert done.states("a")[-1]["offset"] == 0.5


@pytest.mark.parametrize(
    ("modifiers", "v"),
    [
        ([speed(16.0)], 16.0),
        ([speed(3.0, faster_than="b")], 15.0),
        ([speed(3.0, slower_than="b")], 9.0),
        ([speed(same_as="b", factor=1.5)], 18.0),
        ([speed(14.0), acceleration(1.0)], 14.0),
        ([acceleration(-1.0)], 4.0),
    ],
)
def test_drive_at_a_speed(run: Run, modifiers: list[Any], v: float) -> None:
    def body(s: TwoCars) -> Behaviour:
        return s.a.drive(*(named(each, s) for each in modifiers), duration=6.0)

    done = run(scenario(body))
    assert done.states("a")[-1]["v"] == pytest.approx(v, abs=1e-6)


def named(modifier: Any, s: TwoCars) -> Any:
    values = {f.name: getattr(modifier, f.name) for f in dataclasses.fields(modifier)}
    return type(modifier)(**{n: s.b if v == "b" else v for n, v in values.items()})


def test_drive_jumps_where_it_may(run: Run) -> None:
    jump = physical_movement("prefer_non_physical")
    done = run(scenario(lambda s: s.a.drive(speed(30.0), jump, duration=1.0)))
    assert done.states("a")[1]["v"] == 30.0


def test_drive_in_a_lane_with_an_offset(run: Run) -> None:
    done = run(scenario(lambda s: s.a.drive(lane(3), lateral(0.4, side="right"), duration=6.0)))
    last = done.states("a")[-1]
    assert (last["lane"], last["offset"]) == (-2, pytest.approx(-0.4))


def test_drive_behind_another(run: Run) -> None:
    done = run(scenario(lambda s: s.a.drive(position(20.0, behind=s.b), duration=20.0)))
    assert done.states("b")[-1]["s"] - done.states("a")[-1]["s"] == pytest.approx(20.0, abs=0.2)


def test_change_and_keep_a_gap(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        return Serial(
            "follow",
            s.a.change_space_gap(target=20.0, direction="behind", reference=s.b),
            Parallel(
                "brake",
                s.b.change_speed(target=6.0, rate_profile="smooth", rate_peak=1.0),
                s.a.keep_space_gap(reference=s.b, direction="longitudinal", duration=15.0),
            ),
        )

    done = run(scenario(body))
    assert done.result.status == "success"
    a, b = done.states("a")[-1], done.states("b")[-1]
    assert b["s"] - a["s"] - 4.6 == pytest.approx(20.0, abs=0.2)
    assert a["v"] == pytest.approx(6.0, abs=0.1)
    assert not done.result.collisions


def test_time_headway(run: Run) -> None:
    done = run(
        scenario(lambda s: s.a.change_time_headway(target=1.5, direction="behind", reference=s.b))
    )
    a, b = done.states("a")[-1], done.states("b")[-1]
    assert (b["s"] - a["s"]) / a["v"] == pytest.approx(1.5, abs=0.05)


def test_assign_speed_and_position(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        return Serial(
            "jumps",
            s.a.assign_speed(speed=3.0),
            s.a.assign_position(position=Point(600.0, -2.0)),
            Wait(elapsed(0.5)),
        )

    states = run(scenario(body)).states("a")
    assert {e["v"] for e in states} == {3.0}
    assert (states[0]["x"], states[0]["y"], states[0]["lane"]) == (600.0, -2.0, -1)


def test_remain_stationary_somewhere(run: Run) -> None:
    """It is at once where it has to stand, without physics; else it must be there."""
    jump = physical_movement("prefer_non_physical")
    there = (position(distance=90.0), lane(3))
    done = run(scenario(lambda s: s.a.remain_stationary(*there, jump, duration=2.0)))
    for state in done.states("a"):
        assert (state["s"], state["lane"], state["v"]) == pytest.approx((90.0, -2, 0.0))
    done = run(scenario(lambda s: s.a.remain_stationary(*there, duration=2.0)))
    assert "its position along its road is 50.00 m, not 90.00 m" in done.result.reason


def test_remain_stationary_brakes_first(run: Run) -> None:
    done = run(scenario(lambda s: s.a.remain_stationary(duration=5.0)))
    states = done.states("a")
    assert states[-1]["v"] == 0.0
    assert states[-1]["s"] - states[0]["s"] == pytest.approx(10.25, abs=0.1)  # 8 m/s^2, 10 m/s^3


def test_lights_follow_the_sun(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        return Serial(
            "dusk",
            s.a.set_lights(mode="auto"),
            s.sky.assign_celestial_position(
                light_source=s.sky.sun, azimuth=1.0, elevation=math.radians(30)
            ),
            Wait(elapsed(1.0)),
            s.sky.assign_celestial_position(elevation=math.radians(12)),
            Wait(elapsed(1.0)),
            s.a.set_lights(mode="high_beam"),
        )

    done = run(scenario(body))
    lights = [(e["t"], e["mode"], e["lit"]) for e in done.lines if e["kind"] == "lights"]
    assert lights == [
        (0.0, "auto", "off"),
        (1.0, "auto", "low_beam"),
        (2.0, "high_beam", "high_beam"),
    ]
    skies = [e for e in done.lines if e["kind"] == "environment"]
    assert {k for e in skies for k in e} >= {"sun_azimuth", "sun_elevation"}


def test_person_walks_across(run: Run) -> None:
    class Crossing(Scenario):
        name = source = "crossing"

        def declare(self) -> None:
            self.road = Map(map_file="crossing")
            self.walker = Person()

        def placement(self) -> None:
            self.place(
                self.walker,
                position(at_point=Point(250.0, -6.0), project_on_route=False),
                yaw(math.pi / 2),
            )

        def behavior(self) -> Behaviour:
            return self.walker.walk(speed(1.4), duration=8.0)

    states = run(Crossing).states("walker")
    assert states[-1]["v"] == 1.4
    assert states[-1]["y"] - states[0]["y"] == pytest.approx(8.0 * 1.4 - 0.5 * 1.4 * 2.05, abs=0.1)
    assert states[-1]["x"] == pytest.approx(250.0)


@pytest.mark.parametrize(
    ("body", "message"),
    [
        (lambda s: s.a.change_lane(side="up"), "side `up` is not one of left, right"),
        (lambda s: s.a.set_lights(mode="disco"), "mode `disco` is not one of off, auto"),
        (lambda s: s.a.change_speed(target=1.0, rate_profile="fast"), "`fast` is not one of none"),
        (lambda s: s.a.change_speed(speed(9.0), target=5.0), "does not take the modifier Speed"),
        (lambda s: s.a.drive(lane(1), keep_lane()), "lane and keep_lane constrain the same motion"),
        (
            lambda s: s.a.change_space_gap(target=1.0, direction="up", reference=s.b),
            "direction `up` is not one of ahead, behind, left",
        ),
    ],
)
def test_misuse(run: Run, body: Callable[[TwoCars], Behaviour], message: str) -> None:
    with pytest.raises((ScenarioError, UnsupportedError), match=message):
        run(scenario(body))


def test_two_actions_on_one_slot_are_a_conflict(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        return Parallel("both", s.a.change_lane(side="left"), s.a.follow_lane(duration=3.0))

    with pytest.raises(SlotConflict, match="lateral slot of a"):
        run(scenario(body))


def test_dead_end_fails_the_action(run: Run) -> None:
    settings = {"spawn": {"a": ("1", -3, 1960.0)}}

    class End(TwoCars):
        def placement(self) -> None:
            self.place(self.a, lane(2), speed(10.0))
            self.place(self.b, lane(1))

        def behavior(self) -> Behaviour:
            return self.a.drive(speed(10.0), duration=20.0)

    done = run(End, **settings)
    assert done.result.status == "failure"
    assert "a has reached the end of lane -3 of road 1" in done.result.reason
