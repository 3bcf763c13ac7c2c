"""Behavioral models: what a car does while no action controls it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import (
    BehavioralModel,
    Behaviour,
    BmEngine,
    Call,
    Parallel,
    Person,
    Serial,
    Vehicle,
    Wait,
    elapsed,
)
from osc2tx_runtime.errors import ScenarioError, UnsupportedError
from osc2tx_runtime.modifiers import lane, position, speed
from tests.runtime.world.two_cars import TwoCars

Run = Callable[..., Any]

CAREFUL, STEADY = (BehavioralModel(BmEngine(f"{name}_driver")) for name in ("careful", "steady"))


class Closing(TwoCars):
    """Car `a` with 15 m/s comes up to car `b`, which is 40 m ahead of it and drives 8 m/s."""

    model = STEADY

    def declare(self) -> None:
        super().declare()
        self.a = Vehicle(initial_bm=self.model)

    def placement(self) -> None:
        self.place(self.a, lane(2), position(distance=50.0), speed(15.0))
        self.place(
            self.b, lane(same_as=self.a), position(distance=40.0, ahead_of=self.a), speed(8.0)
        )

    def behavior(self) -> Behaviour:
        return Wait(elapsed(20.0))


def closing(
    initial: BehavioralModel, body: Callable[[Closing], Behaviour] | None = None
) -> type[Closing]:
    class Made(Closing):
        model = initial

        def behavior(self) -> Behaviour:
            return super().behavior() if body is None else body(self)

    return Made


def test_a_steady_driver_runs_into_what_is_ahead(run: Run) -> None:
    done = run(closing(STEADY))
    assert {line["v"] for line in done.states("a")} == {15.0}
    assert done.result.collisions


def test_a_careful_driver_follows_with_distance(run: Run) -> None:
    done = run(closing(CAREFUL))
    assert not done.result.collisions
    a, b = done.states("a")[-1], done.states("b")[-1]
    assert a["v"] == pytest.approx(8.0, abs=0.1)
    assert 2.0 < b["s"] - a["s"] - 4.6 < 25.0  # metres between the bumpers


def test_an_action_takes_over_from_the_driver(run: Run) -> None:
    """While an action has the car it drives as it is told; then it is careful again."""
    done = run(
        closing(
            CAREFUL,
            lambda s: Serial("all", s.a.keep_speed(duration=2.0), Wait(elapsed(18.0))),
        )
    )
    assert {line["v"] for line in done.states("a") if line["t"] <= 2.0} == {15.0}
    assert not done.result.collisions
    assert done.states("a")[-1]["v"] == pytest.approx(8.0, abs=0.1)


def test_a_model_can_change_during_the_run(run: Run) -> None:
    done = run(
        closing(
            STEADY,
            lambda s: Serial(
                "all", Wait(elapsed(1.0)), Call(lambda: s.a.set_bm(CAREFUL)), Wait(elapsed(19.0))
            ),
        )
    )
    assert {line["v"] for line in done.states("a") if line["t"] <= 1.0} == {15.0}
    assert not done.result.collisions


def test_two_models_at_once_are_an_error(run: Run) -> None:
    def body(s: Closing) -> Behaviour:
        return Parallel(
            "all",
            Call(lambda: s.a.set_bm(CAREFUL)),
            Call(lambda: s.a.set_bm(STEADY)),
            Wait(elapsed(1.0)),
        )

    with pytest.raises(
        ScenarioError, match="a is assigned two behavioral models at once: careful_driver"
    ):
        run(closing(STEADY, body))


def test_equal_models_at_once_are_none(run: Run) -> None:
    def body(s: Closing) -> Behaviour:
        twice = [Call(lambda: s.a.set_bm(CAREFUL)) for _ in range(2)]
        return Parallel("all", *twice, Wait(elapsed(20.0)))

    assert not run(closing(STEADY, body)).result.collisions


def test_only_vehicles_have_careful_drivers(run: Run) -> None:
    class Walking(Closing):
        def declare(self) -> None:
            super().declare()
            self.walker = Person(initial_bm=CAREFUL)

    with pytest.raises(UnsupportedError, match="walker, a person, cannot be left to a careful"):
        run(Walking)
