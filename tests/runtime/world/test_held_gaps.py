"""`position` all the time, while the speed of its reference changes (DSL 8.9.2)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from osc2tx_runtime import Map, Parallel, Range, Scenario, Vehicle
from osc2tx_runtime.modifiers import lane, position, speed

Run = Callable[..., Any]
SECONDS = 8.0


def follow(place: dict[str, Any], before: float, after: float) -> type[Scenario]:
    """`a` has a place relative to `b`, whose speed (m/s) changes smoothly in 8 s."""

    class Held(Scenario):
        name = "held"
        source = "held.osc"

        def declare(self) -> None:
            self.road = Map(map_file="highway")
            self.a = Vehicle()
            self.b = Vehicle()

        def relative(self) -> dict[str, Any]:
            side = place["side"]
            return {side: self.b, **{key: v for key, v in place.items() if key != "side"}}

        def placement(self) -> None:
            self.place(self.b, lane(2), position(200.0), speed(before))
            self.place(self.a, lane(2), position(**self.relative()), speed(same_as=self.b))

        def behavior(self) -> Any:
            return Parallel(
                "both",
                self.b.drive("changes", speed(after, at="end")),
                self.a.drive("holds", position(**self.relative())),
                duration=SECONDS,
            )

    return Held


def measured(done: Any, place: dict[str, Any], t: float) -> float:
    """The distance (m), or the time (s) at the speed of the one behind."""
    a, b = done.at("a", t), done.at("b", t)
    ahead = float(a["s"] - b["s"])
    metres, behind = (ahead, b) if place["side"] == "ahead_of" else (-ahead, a)
    timed = "time" in place or "time_range" in place
    return metres / float(behind["v"]) if timed else metres


@pytest.mark.parametrize(("before", "after"), [(15.0, 8.0), (8.0, 15.0)])
@pytest.mark.parametrize("side", ["behind", "ahead_of"])
@pytest.mark.parametrize(
    ("extent", "allowed", "tolerance"),
    [
        ({"distance": 20.0}, (20.0, 20.0), 0.05),
        ({"time": 2.0}, (2.0, 2.0), 0.03),
        ({"distance_range": Range(20.0, 21.0)}, (20.0, 21.0), 0.05),
        ({"distance_range": Range(20.0, 30.0)}, (20.0, 30.0), 0.05),
        ({"time_range": Range(1.0, 1.5)}, (1.0, 1.5), 0.03),
        ({"time_range": Range(2.0, 3.0)}, (2.0, 3.0), 0.03),
    ],
)
def test_it_is_held(
    run: Run,
    side: str,
    extent: dict[str, Any],
    allowed: tuple[float, float],
    tolerance: float,
    before: float,
    after: float,
) -> None:
    place = {"side": side, **extent}
    done = run(follow(place, before, after))
    least, most = allowed
    for i in range(int(SECONDS / 0.25) + 1):
        held = measured(done, place, 0.25 * i)
        assert least - tolerance <= held <= most + tolerance, f"{held} at {0.25 * i} s"
    assert done.at("b", SECONDS)["v"] == pytest.approx(after, abs=0.01)
