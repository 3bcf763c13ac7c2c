"""Gaps and headways in a given time (DSL 8.8.3.4 to 8.8.3.10)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import Behaviour, Parallel, Serial
from tests.runtime.world.two_cars import TwoCars, scenario

Run = Callable[..., Any]
LENGTH = 4.6  # m, of a car


def gap(done: Any, t: float) -> float:
    """Metres from the rear of `b` to the front of `a`."""
    return float(done.at("b", t)["s"] - done.at("a", t)["s"] - LENGTH)


def act(make: Callable[[TwoCars], Behaviour], dt: float = 0.05) -> Any:
    """An action of `a`, while `b` goes on at 12 m/s."""
    return scenario(lambda s: Parallel("both", make(s), s.b.drive(duration=20.0), overlap="any"))


@pytest.mark.parametrize("dt", [0.05, 0.01])
def test_a_gap_takes_all_of_its_time(run: Run, dt: float) -> None:
    """35.4 m to 20 m in 8 s: on the course of least effort, a cubic in time."""
    done = run(
        act(
            lambda s: s.a.change_space_gap(
                target=20.0, direction="behind", reference=s.b, duration=8.0
            )
        ),
        dt=dt,
    )
    end = done.actions("a change_space_gap", "end")[0]
    assert end["t"] == pytest.approx(8.0)
    assert gap(done, 8.0) == pytest.approx(20.0, abs=0.01)
    assert done.at("a", 8.0)["v"] == pytest.approx(12.0, abs=0.01)
    # With g(0) = 35.4, g'(0) = 2, g(8) = 20, g'(8) = 0 (Hermite), at half of the time:
    assert gap(done, 4.0) == pytest.approx(0.5 * (35.4 + 20.0) + 2.0 * 8.0 / 8.0, abs=0.02)


@pytest.mark.parametrize(
    ("make", "measure", "wanted"),
    [
        (
            lambda s: s.a.change_time_gap(
                target=1.5, direction="behind", reference=s.b, duration=9.0
            ),
            lambda done: gap(done, 9.0) / done.at("a", 9.0)["v"],
            1.5,
        ),
        (
            lambda s: s.a.change_space_headway(
                target=30.0, direction="behind", reference=s.b, duration=9.0
            ),
            lambda done: gap(done, 9.0) + LENGTH,
            30.0,
        ),
        (
            lambda s: s.a.change_time_headway(
                target=2.0, direction="behind", reference=s.b, duration=9.0
            ),
            lambda done: (gap(done, 9.0) + LENGTH) / done.at("a", 9.0)["v"],
            2.0,
        ),
    ],
)
def test_all_of_them(run: Run, make: Any, measure: Any, wanted: float) -> None:
    done = run(act(make))
    (end,) = [e for e in done.lines if e.get("status") == "end" and e["name"].startswith("a ")]
    assert end["t"] == pytest.approx(9.0)
    assert measure(done) == pytest.approx(wanted, abs=0.01)


def test_a_range_leaves_a_choice(run: Run) -> None:
    """The shortest comfortable time in it: 2 m/s^2 at most, half of what a car can do.

    15.4 m are to be gained, at -2 m/s at first: a(0) = (6 * 15.4 + 4 * 2 T) / T^2 = 2 m/s^2 for
    T^2 - 4 T - 46.2 = 0, T = 9.08 s.
    """
    done = run(
        act(
            lambda s: s.a.change_space_gap(
                target=20.0, direction="behind", reference=s.b, duration=(4.0, 15.0)
            )
        )
    )
    end = done.actions("a change_space_gap", "end")[0]
    assert end["t"] == pytest.approx(9.08, abs=0.11)
    assert max(state["a"] for state in done.states("a")) == pytest.approx(2.0, abs=0.05)


def test_too_short_a_time(run: Run) -> None:
    done = run(
        act(
            lambda s: s.a.change_space_gap(
                target=5.0, direction="behind", reference=s.b, duration=2.0
            )
        )
    )
    assert "at the end of its duration it is" in done.result.reason


def test_across_the_road(run: Run) -> None:
    """From 1.6 m between the sides to 1.2 m in 5 s."""

    def body(s: TwoCars) -> Behaviour:
        beside = s.a.change_space_gap(target=1.2, direction="right", reference=s.b, duration=5.0)
        return Serial("beside", s.b.change_lane(side="left", duration=3.0), beside)

    done = run(scenario(body))
    assert done.result.time == pytest.approx(8.0)
    mine, other = done.states("a")[-1], done.states("b")[-1]
    assert other["y"] - mine["y"] - 1.9 == pytest.approx(1.2, abs=0.01)
    early = done.at("b", 6.0)["y"] - done.at("a", 6.0)["y"] - 1.9
    assert early > 1.25
