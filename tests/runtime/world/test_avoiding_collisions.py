"""Movements that avoid collisions, and those that stay or jump."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import Behaviour, Parallel, Person, Serial
from osc2tx_runtime.domain.actors import Point
from osc2tx_runtime.modifiers import (
    avoid_collisions,
    keep_position,
    lane,
    orientation,
    physical_movement,
    position,
    speed,
    yaw,
)
from tests.runtime.world.two_cars import TwoCars, scenario

Run = Callable[..., Any]
LENGTH = 4.6


@pytest.mark.parametrize("v", [6.0, 9.0])
def test_the_gap_behind_a_slow_one_is_that_of_the_model(run: Run, v: float) -> None:
    """At rest relative to the leader g = g0 + v T with g0 = 2 m and T = 1.5 s."""

    def body(s: TwoCars) -> Behaviour:
        return Parallel(
            "both",
            s.a.drive(speed(20.0), avoid_collisions(True), duration=50.0),
            s.b.change_speed(target=v),
        )

    done = run(scenario(body))
    a, b = done.states("a")[-1], done.states("b")[-1]
    assert not done.result.collisions
    assert b["s"] - a["s"] - LENGTH == pytest.approx(2.0 + 1.5 * v, abs=0.1)
    assert a["v"] == pytest.approx(v, abs=0.02)


def test_it_stops_behind_one_that_stops(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        return Parallel(
            "both",
            s.a.drive(avoid_collisions(True), duration=30.0),
            s.b.remain_stationary(duration=30.0),
        )

    done = run(scenario(body))
    a, b = done.states("a")[-1], done.states("b")[-1]
    assert not done.result.collisions
    assert 1.9 < b["s"] - a["s"] - LENGTH < 2.6
    assert a["v"] == pytest.approx(0.0, abs=0.1)
    assert min(e["a"] for e in done.states("a")) > -8.0


def test_without_it_they_collide(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        return Parallel(
            "both",
            s.a.drive(speed(10.0), avoid_collisions(False), duration=12.0),
            s.b.remain_stationary(duration=12.0),
        )

    assert run(scenario(body)).result.collisions


def test_a_free_road_changes_nothing(run: Run) -> None:
    plain = run(scenario(lambda s: s.b.drive(speed(20.0), duration=6.0))).states("b")
    careful = run(scenario(lambda s: s.b.drive(speed(20.0), avoid_collisions(), duration=6.0)))
    assert careful.states("b") == plain


def test_the_lane_beside_is_free(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        return Serial(
            "all",
            s.a.change_lane(side="left"),
            Parallel(
                "both",
                s.a.drive(speed(15.0), avoid_collisions(), duration=15.0),
                s.b.remain_stationary(duration=15.0),
            ),
        )

    done = run(scenario(body))
    assert done.states("a")[-1]["v"] == 15.0
    assert done.states("a")[-1]["s"] > done.states("b")[-1]["s"]


def test_it_stops_for_a_person_in_the_lane(run: Run) -> None:
    class Crossing(TwoCars):
        def declare(self) -> None:
            super().declare()
            self.walker = Person()

        def placement(self) -> None:
            self.place(self.a, lane(2), position(distance=50.0), speed(10.0))
            self.place(self.b, lane(4), position(distance=50.0))
            point = Point(110.0, -8.0)
            self.place(self.walker, position(at_point=point, project_on_route=False), yaw(1.57))

        def behavior(self) -> Behaviour:
            return self.a.drive(avoid_collisions(), duration=20.0)

    done = run(Crossing)
    assert not done.result.collisions
    assert done.states("a")[-1]["v"] == pytest.approx(0.0, abs=0.1)
    assert done.states("a")[-1]["x"] + 0.8 * LENGTH < 110.0 - 0.25 - 1.0


def test_keep_position_brakes_or_stands_at_once(run: Run) -> None:
    states = run(scenario(lambda s: s.a.drive(keep_position(), duration=4.0))).states("a")
    assert states[-1]["v"] == 0.0
    assert states[-1]["s"] - states[0]["s"] == pytest.approx(10.25, abs=0.1)
    jump = physical_movement("prefer_non_physical")
    states = run(scenario(lambda s: s.a.drive(keep_position(), jump, duration=4.0))).states("a")
    assert states[1]["v"] == 0.0


def test_a_lane_may_be_jumped_to(run: Run) -> None:
    jump = physical_movement("prefer_non_physical")
    states = run(scenario(lambda s: s.a.drive(lane(4), jump, duration=1.0))).states("a")
    assert ({state["lane"] for state in states}, states[-1]["offset"]) == ({-1}, 0.0)


def test_a_lane_change_may_be_too_fast(run: Run) -> None:
    body = lambda s: s.a.drive(lane(3, at="end"), physical_movement(), duration=1.5)  # noqa: E731
    done = run(scenario(body))
    assert done.result.status == "failure"
    assert "3.5 m in 1.5 s requires more than 3 m/s^2" in done.result.reason


def test_a_lane_at_the_end_of_a_drive(run: Run) -> None:
    done = run(scenario(lambda s: s.a.drive(lane(3, at="end"), duration=4.0)))
    assert done.states("a")[-1]["y"] == pytest.approx(-5.25)
    assert done.states("a")[-2]["y"] < -5.25
    done = run(scenario(lambda s: s.a.drive(lane(3, at="end"))))
    assert done.result.time == pytest.approx(3.0, abs=0.051)


@pytest.mark.parametrize(
    ("modifier", "heading"),
    [
        (lambda s: yaw(0.3), 0.3),
        (lambda s: yaw(0.0, measure_by="relative_to_north"), 0.5 * math.pi),
        (lambda s: yaw(0.2, relative_to=s.b, measure_by="length_to_length"), 0.2),
        (lambda s: yaw(0.2, relative_to=s.b, measure_by="length_to_width"), 0.5 * math.pi + 0.2),
        (lambda s: yaw(0.2, relative_to=s.b, measure_by="width_to_length"), 0.2 - 0.5 * math.pi),
        (lambda s: orientation(yaw=1.0), 1.0),
        (lambda s: orientation(yaw=0.4, measure_by="relative_to_road"), 0.4),
        (lambda s: orientation(yaw=0.4, relative_to=s.b, measure_by="absolute"), 0.4),
        (lambda s: yaw(0.3, at="end"), 0.3),
    ],
)
def test_a_person_turns(run: Run, modifier: Callable[[TwoCars], Any], heading: float) -> None:
    class Turning(TwoCars):
        def declare(self) -> None:
            super().declare()
            self.walker = Person()

        def placement(self) -> None:
            super().placement()
            point = Point(200.0, -25.0)
            self.place(
                self.walker, position(at_point=point, project_on_route=False), orientation(3.0)
            )

        def behavior(self) -> Behaviour:
            return self.walker.walk(modifier(self), duration=3.0)

    states = run(Turning).states("walker")
    assert states[0]["h"] == 3.0
    assert math.cos(states[-1]["h"] - heading) == pytest.approx(1.0)
