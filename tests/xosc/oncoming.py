"""Scenarios in which an actor drives in a lane of oncoming traffic."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

from tests.xosc.case_texts import Case

OUT = {
    "usual": "change_lane(side: inside)",
    "two": "change_lane(num_of_lanes: 2, side: left)",
    "from_one_beside": "change_lane(num_of_lanes: 1, side: left, reference: other)",
    "asap": "change_lane(side: left, rate_profile: asap)",
    "even": "change_lane(side: left, rate_profile: constant)",
    "slow": "change_lane(side: left, duration: 5s)",
    "peak": "change_lane(side: left, rate_profile: smooth, rate_peak: 1.2mps)",
}
WHILE = {
    "after_a_time": "elapsed(1.5s)",
    "gap": "ego.space_gap(reference: other, direction: longitudinal) > 12m",
    "ahead": "ego.object_distance(reference: other, direction: longitudinal) < -15m",
    "road": "ego.road_distance(reference: other, direction: longitudinal) < -15m",
    "straight": "ego.object_distance(reference: met, direction: euclidean) < 40m",
    "aside": "ego.object_distance(reference: met, direction: longitudinal) < 30m",
}
BACK = {
    "right": "change_lane(side: right)",
    "to_other": "change_lane(side: same, reference: other)",
    "two": "change_lane(num_of_lanes: 2, side: outside)",
}


def oncoming() -> Iterator[Case]:
    """Yield changes to lanes of oncoming traffic, what waits for something there, and returns."""
    for out, waits, back in (
        *product(OUT, ("after_a_time",), ("right",)),
        *product(("two",), ("after_a_time",), ("to_other", "two")),
        *product(("usual",), WHILE, ("to_other",)),
    ):
        change, until, returns = OUT[out], WHILE[waits], BACK[back]
        yield f"out_{out}_{waits}_back_{back}", (
            "ego, other, met: vehicle\n"
            "far: position_3d with:\n    keep(it.x == 520m)\n    keep(it.y == 8.75m)\n"
            "    keep(it.z == 0m)\n"
            "do parallel:\n"
            "    other.drive() with:\n        lane(4, at: start)\n"
            "        position(230m, at: start)\n        speed(12mps)\n"
            "    met.drive() with:\n"
            "        position(at_point: far, project_on_route: false, at: start)\n"
            "        speed(15mps)\n"
            "    serial:\n        ego.drive(duration: 1s) with:\n            lane(4, at: start)\n"
            "            position(200m, at: start)\n            speed(20mps)\n"
            f"        ego.{change}\n"
            f"        ego.drive() with:\n            until {until}\n"
            f"        ego.{returns}\n"
            "        ego.drive(duration: 0.5s)\n"
        )
