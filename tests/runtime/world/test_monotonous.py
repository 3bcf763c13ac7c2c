"""`movement_mode: monotonous`: within the limits of the actor, and without detours (DSL 8.9.20)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import Behaviour, Parallel, Serial
from osc2tx_runtime.domain.shapes import (
    AnyPositionShape,
    OwnShape,
)
from osc2tx_runtime.errors import UnsupportedError
from osc2tx_runtime.modifiers import distance, lateral, physical_movement, position, speed
from tests.runtime.world.two_cars import TwoCars, scenario

Run = Callable[..., Any]
JUMP = physical_movement("prefer_non_physical")
MONOTONOUS = "monotonous"


def own(compute: Callable[[float], float], duration: float | None = None) -> OwnShape[Any]:
    """A shape of a scenario with these methods."""
    length = None if duration is None else (lambda _shape: duration)
    return OwnShape(AnyPositionShape(), lambda _shape, t: compute(t), length)


def both(s: TwoCars, *modifiers: Any, time: float = 8.0, lead: Any = None) -> Behaviour:
    """Car `a` by its modifiers, while `b` goes on or does something else."""
    other = s.b.drive() if lead is None else lead(s)
    return Parallel("both", s.a.drive(*modifiers), other, duration=time)


def test_no_way_back_where_it_is_monotonous(run: Run) -> None:
    """It would stop after 5 s and come back."""
    back = own(lambda t: 10.0 * t - t * t, 8.0)
    done = run(scenario(lambda s: s.a.drive(distance(16.0, shape=back, movement_mode=MONOTONOUS))))
    assert "distance: it would have to reverse after 5.0 s" in done.result.reason
    with pytest.raises(UnsupportedError, match="`monotonous` and `prefer_non_physical` exclude"):
        run(scenario(lambda s: s.a.drive(distance(16.0, movement_mode=MONOTONOUS), JUMP)))


def test_monotonous_means_within_the_limits(run: Run) -> None:
    """9 m/s in 2 s take 4.5 m/s^2 and more: tyres can do it, this car cannot."""
    target = 19.0
    done = run(scenario(lambda s: s.a.drive(speed(target, at="end"), duration=2.0)))
    assert done.result.status == "success"
    wish = speed(target, at="end", movement_mode=MONOTONOUS)
    done = run(scenario(lambda s: s.a.drive(wish, duration=2.0)))
    assert "requires more than 4 m/s^2" in done.result.reason


@pytest.mark.parametrize(("wanted", "time"), [(36.0, 4.0), (44.0, 8.0)])
def test_a_gap_does_not_turn_back_where_it_is_monotonous(
    run: Run, wanted: float, time: float
) -> None:
    """It grows by 2 m/s: it cannot shrink at once, nor take 8 s for 4 m (3 * 4 m / 2 m/s = 6 s)."""

    def body(mode: Any, seconds: float) -> Callable[[TwoCars], Behaviour]:
        def made(s: TwoCars) -> Behaviour:
            wish = position(wanted, behind=s.b, at="end", movement_mode=mode)
            return both(s, wish, time=seconds)

        return made

    done = run(scenario(body(MONOTONOUS, time)))
    assert "position: it would have to reverse" in done.result.reason
    assert run(scenario(body("other", time))).result.status == "success"
    if wanted > 40.0:
        assert run(scenario(body(MONOTONOUS, 5.5))).result.status == "success"


@pytest.mark.parametrize("mode", ["monotonous", "other"])
def test_a_place_across_does_not_overshoot(run: Run, mode: Any) -> None:
    """At 0.8 m/s to the left, 0.1 m further left is a way out and back."""

    def body(s: TwoCars) -> Behaviour:
        return Serial(
            "drift",
            s.a.drive(speed(0.8, direction="lateral"), duration=1.0),
            s.a.drive(lateral(0.9, movement_mode=mode), duration=3.0),
        )

    done = run(scenario(body))
    if mode == "other":
        assert max(state["offset"] for state in done.states("a")) > 0.95
        assert done.states("a")[-1]["offset"] == pytest.approx(0.9)
    else:
        assert "lateral: it would have to reverse" in done.result.reason
