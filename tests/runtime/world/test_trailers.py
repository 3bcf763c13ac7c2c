"""Trailers against the geometry of one axle behind a hitch."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import (
    Behaviour,
    HitchCoupler,
    HitchReceiver,
    Parallel,
    Serial,
    Vehicle,
    Wait,
    elapsed,
)
from osc2tx_runtime.domain.actors import Point, Pose, Trailer
from osc2tx_runtime.domain.paths.path_values import Path
from osc2tx_runtime.enums import HitchType
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.modifiers import lane, position, speed, tow_trailer
from tests.runtime.world.two_cars import TwoCars

Run = Callable[..., Any]


class Towing(TwoCars):
    """Car `a` tows trailer `t` from the start."""

    coupled = True

    def declare(self) -> None:
        super().declare()
        self.t = Trailer(vehicle_category="trailer")

    def placement(self) -> None:
        self.place(self.b, lane(4), position(distance=50.0), speed(12.0))
        if self.coupled:
            self.place(self.a, lane(2), position(distance=50.0), speed(10.0), tow_trailer(self.t))
        else:
            self.place(self.a, lane(2), position(distance=50.0))
            self.place(self.t, position(at_point=Point(43.5, -8.75)))


def towing(body: Callable[[Towing], Behaviour], *, is_coupled: bool = True) -> type[Towing]:
    class Made(Towing):
        coupled = is_coupled

        def behavior(self) -> Behaviour:
            return body(self)

    return Made


BAR = 6.0 - 1.2 + 0.5  # front of a trailer of 6 m, and the drawbar
REAR = 0.92  # of the car


def bar_length(a: dict[str, Any], t: dict[str, Any]) -> float:
    x, y = a["x"] - REAR * math.cos(a["h"]), a["y"] - REAR * math.sin(a["h"])
    return math.hypot(x - t["x"], y - t["y"])


def test_the_bar_keeps_its_length(run: Run) -> None:
    done = run(
        towing(
            lambda s: Parallel(
                "all", s.a.change_lane(side="left"), s.a.change_speed(target=15.0, duration=5.0)
            )
        )
    )
    for a, t in zip(done.states("a"), done.states("t"), strict=True):
        assert bar_length(a, t) == pytest.approx(BAR, abs=1e-5)
    assert done.states("t")[-1]["v"] == pytest.approx(15.0, abs=0.01)
    assert done.states("t")[-1]["a"] == pytest.approx(done.states("a")[-1]["a"], abs=0.1)
    assert not done.result.collisions


def test_on_a_circle_it_cuts_the_corner(run: Run) -> None:
    radius = 20.0
    angles = [-0.5 * math.pi + 0.1 * i for i in range(60)]
    circle = Path(
        tuple(
            Pose(50.0 + radius * math.cos(a), -8.75 + radius + radius * math.sin(a)) for a in angles
        ),
        "smooth",
    )
    done = run(towing(lambda s: s.a.replay_path(absolute=circle)))
    t = done.states("t")[-1]
    hitch = math.hypot(radius, REAR)
    steady = math.sqrt(hitch * hitch - BAR * BAR)
    assert math.hypot(t["x"] - 50.0, t["y"] + 8.75 - radius) == pytest.approx(steady, abs=0.1)
    assert t["v"] == pytest.approx(10.0 * steady / radius, rel=0.02)


def test_couple_and_uncouple(run: Run) -> None:
    def body(s: Towing) -> Behaviour:
        return Serial(
            "all",
            s.a.connect_trailer(trailer=s.t),
            s.a.change_speed(target=8.0, duration=4.0),
            s.a.disconnect_trailer(),
            Wait(elapsed(6.0)),
        )

    done = run(towing(body, is_coupled=False))
    assert done.result.status == "success"
    assert bar_length(done.at("a", 3.0), done.at("t", 3.0)) == pytest.approx(BAR, abs=1e-5)
    assert done.at("t", 4.0)["v"] == pytest.approx(8.0, abs=0.2)
    assert (done.states("a")[-1]["v"], done.states("t")[-1]["v"]) == (8.0, 0.0)


@pytest.mark.parametrize(
    ("body", "is_coupled", "reason"),
    [
        (lambda s: s.b.connect_trailer(trailer=s.t), True, "t is towed already"),
        (lambda s: s.a.connect_trailer(trailer=s.t), True, "a tows t already"),
        (lambda s: s.b.connect_trailer(trailer=s.t), False, "m from the hitch of b"),
        (lambda s: s.b.disconnect_trailer(), True, "b tows no trailer"),
    ],
)
def test_what_cannot_be_coupled(
    run: Run, body: Callable[[Towing], Behaviour], is_coupled: bool, reason: str
) -> None:
    done = run(towing(body, is_coupled=is_coupled))
    assert done.result.status == "failure"
    assert reason in done.result.reason


class Hitches(Towing):
    """The same with hitches as the scenario has them."""

    receiver = HitchReceiver()
    coupler = HitchCoupler()

    def declare(self) -> None:
        super().declare()
        self.a = Vehicle(trailer_receiver=self.receiver)
        self.t = Trailer(vehicle_category="trailer", coupler=self.coupler)


@pytest.mark.parametrize(
    ("receives", "couples", "fits"),
    [
        ("ball", "ball", True),
        ("none", "pintle", True),
        ("ball", None, True),
        ("ball", "pintle", False),
    ],
    ids=["same", "receiver not said", "coupler not said", "different"],
)
def test_halves_of_a_hitch_must_be_of_one_type(
    run: Run, receives: str, couples: HitchType | None, fits: bool
) -> None:
    class Made(Hitches):
        receiver, coupler = HitchReceiver(receives), HitchCoupler(couples)

        def behavior(self) -> Behaviour:
            return self.a.drive(duration=1.0)

    class Later(Made):
        coupled = False

        def behavior(self) -> Behaviour:
            return self.a.connect_trailer(trailer=self.t)

    if fits:
        assert run(Made).result.status == run(Later).result.status == "success"
        return
    reason = "a cannot tow t: a pintle coupler does not fit a ball receiver"
    with pytest.raises(ScenarioError, match=reason):
        run(Made)
    assert reason in run(Later).result.reason


def test_a_hitch_is_where_the_scenario_has_it(run: Run) -> None:
    """Here 0.6 m behind the rear axle of the car and 4 m before that of the trailer."""

    class Made(Hitches):
        receiver, coupler = HitchReceiver(position_x=-0.6), HitchCoupler(position_x=4.0)

        def behavior(self) -> Behaviour:
            watched = Serial(
                "watched",
                Wait(lambda: self.t.coupler.is_towed and self.a.trailer_receiver.is_towing),
            )
            return Serial("all", self.a.change_lane(side="left"), watched)

    done = run(Made)
    assert done.result.status == "success"
    for a, t in zip(done.states("a"), done.states("t"), strict=True):
        x, y = a["x"] - 0.6 * math.cos(a["h"]), a["y"] - 0.6 * math.sin(a["h"])
        assert math.hypot(x - t["x"], y - t["y"]) == pytest.approx(4.0, abs=1e-5)


def test_a_towed_trailer_does_not_drive(run: Run) -> None:
    with pytest.raises(ScenarioError, match="t is towed, so it cannot move by itself"):
        run(towing(lambda s: s.t.drive(speed(5.0), duration=1.0)))
