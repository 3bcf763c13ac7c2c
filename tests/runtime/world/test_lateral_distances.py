"""Distances across the road, measured between sides."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import Behaviour, Call, Map, Parallel, Serial
from osc2tx_runtime.errors import ScenarioError, UnsupportedError
from osc2tx_runtime.modifiers import keep_lane, lane, lateral, position, speed
from tests.runtime.world.two_cars import TwoCars, scenario

Run = Callable[..., Any]
WIDTH = 1.9  # of both cars


@pytest.mark.parametrize(
    ("direction", "target", "side"),
    [
        ("left", 1.0, 1),
        ("right", 0.8, -1),
        ("inside", 1.0, 1),  # right-hand traffic: opposing traffic is to the left
        ("outside", 0.5, -1),
        ("left", -0.7, -1),
    ],
)
def test_change_space_gap_across(run: Run, direction: Any, target: float, side: int) -> None:
    def body(s: TwoCars) -> Behaviour:
        return s.a.change_space_gap(target=target, direction=direction, reference=s.b)

    done = run(scenario(body))
    assert done.result.status == "success"
    a, b = done.states("a")[-1], done.states("b")[-1]
    assert a["y"] - b["y"] == pytest.approx(side * (abs(target) + WIDTH), abs=0.05)
    assert a["v"] == 10.0


def test_keep_space_gap_across(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        return Serial(
            "all",
            s.a.change_lane(side="left"),
            Parallel(
                "both",
                s.a.keep_space_gap(reference=s.b, direction="lateral", duration=8.0),
                s.b.change_lane(side="right", duration=4.0),
            ),
        )

    done = run(scenario(body))
    a, b = done.states("a")[-1], done.states("b")[-1]
    assert (b["lane"], b["y"]) == (-4, pytest.approx(-12.25))
    assert a["y"] - b["y"] == pytest.approx(3.5, abs=0.05)
    assert (a["lane"], a["offset"]) == (-3, pytest.approx(0.0, abs=0.05))


def test_time_gap_across(run: Run) -> None:
    """The gap over the approach speed stays 4 s: the gap decays as exp(-t / 4 s)."""

    def body(s: TwoCars) -> Behaviour:
        return Serial(
            "all",
            s.a.change_lane(side="left"),
            s.a.change_time_gap(target=4.0, direction="left", reference=s.b),
            s.a.keep_time_gap(reference=s.b, direction="lateral", duration=3.0),
        )

    done = run(scenario(body))
    end = done.states("a")[-1]["t"]
    gap = {t: done.at("a", t)["y"] - done.at("b", t)["y"] - WIDTH for t in (end - 3.0, end)}
    assert gap[end] == pytest.approx(gap[end - 3.0] * math.exp(-3.0 / 4.0), rel=0.03)


@pytest.mark.parametrize(
    ("modifier", "left"),
    [
        (lambda s: lateral(3.0, side_of=s.b), 3.0),
        (lambda s: lateral(3.0, side_of=s.b, side="right"), -3.0),
        (lambda s: lateral(1.0, side_of=s.b, measure_by="closest"), 1.0 + WIDTH),
        (lambda s: lateral(1.0, side_of=s.b, side="right", measure_by="closest"), -1.0 - WIDTH),
        (lambda s: lateral(1.0, side_of=s.b, measure_by="right_to_left"), 1.0 + WIDTH),
        (lambda s: lateral(2.0, side_of=s.b, measure_by="left_to_left"), 2.0),
        (lambda s: lateral(2.0, side_of=s.b, measure_by="left_to_center"), 2.0 - 0.5 * WIDTH),
    ],
)
def test_lateral_beside_another(run: Run, modifier: Callable[[TwoCars], Any], left: float) -> None:
    done = run(scenario(lambda s: s.a.drive(modifier(s), duration=9.0)))
    a, b = done.states("a")[-1], done.states("b")[-1]
    assert a["y"] - b["y"] == pytest.approx(left, abs=0.05)


def test_lateral_to_the_edge_of_the_lane(run: Run) -> None:
    edge = lateral(-0.3, measure_by="left_to_left", at="end")
    done = run(scenario(lambda s: s.a.drive(edge, duration=4.0)))
    assert done.states("a")[-1]["offset"] == pytest.approx(0.5 * 3.5 - 0.3 - 0.5 * WIDTH)


def test_lateral_speed(run: Run) -> None:
    def body(s: TwoCars) -> Behaviour:
        return Serial(
            "all",
            s.a.drive(speed(0.5, direction="lateral"), duration=4.0),
            s.a.keep_speed(duration=2.0),
        )

    states = run(scenario(body)).states("a")
    assert states[80]["y"] - states[0]["y"] == pytest.approx(2.0)
    assert states[-1]["y"] - states[0]["y"] == pytest.approx(2.2)  # the rest runs out
    assert states[-1]["h"] == 0.0


def test_what_cannot_be(run: Run) -> None:
    with pytest.raises(ScenarioError, match="`measure_by: closest` needs `side_of`"):
        run(scenario(lambda s: s.a.drive(lateral(1.0, measure_by="closest"))))
    with pytest.raises(UnsupportedError, match="lateral and keep_lane constrain the same motion"):
        run(scenario(lambda s: s.a.drive(lateral(1.0, side_of=s.b), keep_lane())))
    done = run(scenario(lambda s: s.a.keep_space_gap(reference=s.b, direction="lateral")))
    assert "a is in the lane of b, so there is no gap to keep" in done.result.reason
    done = run(
        scenario(lambda s: s.a.change_time_gap(target=2.0, direction="right", reference=s.b))
    )
    assert "it is not to the right of b" in done.result.reason


def test_inside_is_right_where_traffic_keeps_left(run: Run) -> None:
    class LeftHand(TwoCars):
        def declare(self) -> None:
            super().declare()
            self.road = Map(map_file="left_hand")

        def placement(self) -> None:
            self.place(self.a, lane(1, from_="left"), position(distance=20.0), speed(8.0))
            self.place(self.b, lane(same_as=self.a), position(30.0, ahead_of=self.a), speed(8.0))

        def behavior(self) -> Behaviour:
            return Serial(
                "all",
                Call(lambda: sides.append((self.road.inner_side(), self.road.outer_side()))),
                self.a.change_space_gap(target=0.5, direction="inside", reference=self.b),
            )

    sides: list[tuple[str, str]] = []
    done = run(LeftHand)
    assert sides == [("right", "left")]
    a, b = done.states("a")[-1], done.states("b")[-1]
    left = (a["y"] - b["y"]) * math.cos(b["h"]) - (a["x"] - b["x"]) * math.sin(b["h"])
    assert left == pytest.approx(-0.5 - WIDTH, abs=0.06)
