"""`one_of` whose alternatives control one actor: exactly one of them is invoked (§7.3.13.3)."""

from __future__ import annotations

import json
from collections import Counter

import pytest

from osc2tx_runtime import Behaviour, OneOf, Parallel, RunSettings, Serial, run_scenario
from osc2tx_runtime.modifiers import speed
from tests.runtime.world.two_cars import TwoCars, scenario


def slow(s: TwoCars) -> Behaviour:
    return s.a.drive("slow", speed(9.0, at="end"), duration=1.0)


def quick(s: TwoCars) -> Behaviour:
    return s.a.drive("quick", speed(13.0, at="end"), duration=2.0)


def lines(made: type[TwoCars], seed: int) -> list[dict[str, object]]:
    result = run_scenario(made, RunSettings(seed=seed))
    assert (result.status, result.reason, result.violations) == ("success", "", ())
    return [json.loads(line) for line in result.trace_lines]


def chosen(made: type[TwoCars], seed: int) -> str:
    """The alternative that was chosen; the actor does only what it says."""
    found = lines(made, seed)
    (name,) = (line["chosen"] for line in found if line["kind"] == "choice")
    started = [line for line in found if line["kind"] == "action" and line["status"] == "start"]
    assert [line["name"] for line in started if line["actor"] == "a"] == ["a drive"]
    return str(name)


def test_each_is_drawn() -> None:
    """Uniformly, and the same one for the same seed."""
    made = scenario(lambda s: OneOf("either", slow(s), quick(s)))
    drawn = Counter(chosen(made, seed) for seed in range(200))
    assert set(drawn) == {"slow", "quick"}
    assert 70 <= drawn["slow"] <= 130
    assert chosen(made, 7) == chosen(made, 7)


def test_only_one_that_fills_the_duration() -> None:
    made = scenario(lambda s: OneOf("either", slow(s), quick(s), duration=2.0))
    assert {chosen(made, seed) for seed in range(20)} == {"quick"}


def test_after_something_instantaneous_and_in_a_composition() -> None:
    made = scenario(
        lambda s: OneOf(
            "either",
            Serial("set", s.a.assign_speed(speed=8.0), slow(s)),
            Parallel("both", quick(s), s.b.keep_speed(), duration=2.0),
        )
    )
    names = {chosen_of(lines(made, seed)) for seed in range(20)}
    assert names == {"set", "both"}


def chosen_of(found: list[dict[str, object]]) -> object:
    return next(line["chosen"] for line in found if line["kind"] == "choice")


@pytest.mark.parametrize("seed", range(5))
def test_others_still_race(seed: int) -> None:
    """`b` is another actor: what it does is over first."""
    made = scenario(
        lambda s: OneOf("race", slow(s), quick(s), s.b.drive("other", speed(12.0), duration=0.5))
    )
    assert chosen_of(lines(made, seed)) == "other"
