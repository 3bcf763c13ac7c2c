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
from osc2tx_runtime.opendrive import Pose as WorldPose
from osc2tx_runtime.opendrive import RoadMap
from osc2tx_runtime.world import ActorSpec, ActorState, EmbeddedWorld
from osc2tx_runtime.world.actor_dimensions import Shape
from osc2tx_runtime.world.motion.towing import drawn
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


def follower(angle: float) -> ActorState:
    """A trailer whose bar of 4 m ends at the origin, at an angle to the x axis."""
    shape = Shape(5.0, 2.0, 2.0, 1.0, drawbar=4.0)
    x, y = -4.0 * math.cos(angle), -4.0 * math.sin(angle)
    return ActorState(x, y, 0.0, angle, 0.0, 0.0, None, 0.0, shape)


def tow_at(x: float, v: float = 5.0) -> ActorState:
    """A towing vehicle on the x axis with its hitch at x."""
    return ActorState(x, 0.0, 0.0, 0.0, v, 0.0, None, 0.0, Shape(4.0, 2.0, 1.5, 1.0, hitch=0.0))


@pytest.mark.parametrize("angle", [0.01, 0.5, -1.2, 3.0])
def test_a_straight_pull_is_a_tractrix(angle: float) -> None:
    """Where the axle is: x = hitch - sqrt(l^2 - y^2), and its way is l ln(y0 / y), y falling."""
    trailer, way = follower(angle), 6.0
    pose, _ = drawn(trailer, tow_at(way), tow_at(0.0), 1.0)
    assert way - pose.x == pytest.approx(
        math.copysign(math.sqrt(16.0 - pose.y * pose.y), math.cos(pose.h)), abs=1e-9
    )
    half = math.tan(0.5 * angle) * math.exp(-way / 4.0)
    assert pose.y == pytest.approx(-4.0 * 2.0 * half / (1.0 + half * half), abs=1e-9)


def test_a_straight_pull_in_one_step_or_in_many() -> None:
    once, _ = drawn(follower(0.8), tow_at(3.0), tow_at(0.0), 0.1)
    state = follower(0.8)
    for k in range(100):
        pose, _ = drawn(state, tow_at(0.03 * (k + 1)), tow_at(0.03 * k), 0.001)
        state = state._replace(x=pose.x, y=pose.y, h=pose.h)
    assert (state.x, state.y, state.h) == pytest.approx((once.x, once.y, once.h), abs=1e-12)


def test_a_trailer_that_is_pushed_folds(highway: RoadMap) -> None:
    """Going back it leaves the line by itself; beyond a right angle that is said, once."""
    world = EmbeddedWorld(highway, 0.05)
    for name, shape in (("a", tow_at(0.0).shape), ("t", follower(0.0).shape)):
        world.add(ActorSpec(name, "movable_object", shape, limits=None))  # type: ignore[arg-type]
    world.place("a", WorldPose(0.0, 100.0, 0.0, 0.0), -5.0)
    world.place("t", WorldPose(-4.0 * math.cos(0.1), 100.0 - 4.0 * math.sin(0.1), 0.0, 0.1))
    world.attach("a", "t")
    notes = []
    for _ in range(100):
        world.step()
        notes += world.take_notes()
    ((kind, values),) = notes
    assert kind == "jack_knife" and (values["actor"], values["tow"]) == ("t", "a")
    # The tangent of half the angle grows by e every 4 m.
    expected = 4.0 * math.log(1.0 / math.tan(0.05)) / 5.0
    (warning,) = world.warnings()
    said = float(warning.partition(" at ")[2].partition(" s:")[0])
    assert said == pytest.approx(expected, abs=0.051)
    assert warning.startswith("t jackknifes at ")


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
