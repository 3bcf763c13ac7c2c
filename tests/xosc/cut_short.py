"""Scenarios in which actions and compositions are cut short."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

from tests.xosc.case_texts import EGO, Case, indented

ENDINGS = {
    "elapsed": "elapsed(1.3s)",
    "event": "@told",
    "rise": "rise(other.speed > 21mps)",
    "fall": "fall(other.speed < 22mps)",
    "level": "other.speed >= 21.5mps",
    "way": "ego.road_distance(reference: other, direction: longitudinal) < -0.25m",
}
CUT = {
    "even": "change_speed(target: 30mps, rate_profile: constant, rate_peak: 2mpss)",
    "smooth": "change_speed(target: 12mps, rate_profile: smooth)",
    "limited": "change_speed(target: 28mps)",
    "lane": "change_lane(side: left)",
    "drive": "drive()",
    "still": "keep_speed()",
}


def cut() -> Iterator[Case]:
    """Yield actions that something ends, with what comes after."""
    for (ending, trigger), (name, act) in product(ENDINGS.items(), CUT.items()):
        yield f"{name}_until_{ending}", (
            "ego, other: vehicle\nevent told\ndo parallel:\n    serial:\n"
            "        other.drive(duration: 0.5s) with:\n            lane(3, at: start)\n"
            "            position(200m, at: start)\n            speed(19mps)\n"
            "        other.change_speed(target: 23mps, rate_profile: constant, rate_peak: 3mpss)\n"
            "        emit told\n"
            f"    serial:\n        ego.drive(duration: 0.2s) with:\n{indented(EGO, 3)}"
            f"        ego.{act} with:\n            until {trigger}\n"
            "        ego.drive(duration: 0.4s)\n"
            "        ego.change_speed(target: 22mps, rate_profile: constant, rate_peak: 4mpss)\n"
        )


INSIDE = {
    "even": "ego.change_speed(target: 30mps, rate_profile: constant, rate_peak: 2mpss)",
    "limited": "ego.change_speed(target: 28mps)",
    "smooth": "ego.change_speed(target: 12mps, rate_profile: smooth)",
    "drive": "ego.drive() with:\n    speed(27mps)",
    "lane": "ego.change_lane(side: left)",
    "offset": "ego.follow_lane(offset: 0.5m)",
    "rate": "ego.change_acceleration(target: 2mpss, rate_profile: constant, rate_peak: 0.7mpspsps)",
}
AROUND = {
    "serial": "serial:\n    ego.drive(duration: 0.5s)\n",
    "parallel": "parallel:\n",
    "parallel_waits": "parallel:\n    wait elapsed(6s)\n",
    "one_of": "one_of:\n",
    "one_of_two": "one_of:\n    wait elapsed(5s)\n",
}


def composed() -> Iterator[Case]:
    """Yield compositions that something ends while an action in them is at work."""
    for (around, head), (name, act), (ending, trigger) in product(
        AROUND.items(), INSIDE.items(), list(ENDINGS.items())[::2]
    ):
        body = f"{head}{indented(act, 1)}with:\n    until {trigger}\n"
        yield f"{around}_{name}_until_{ending}", (
            "ego, other: vehicle\nevent told\ndo parallel:\n    serial:\n"
            "        other.drive(duration: 0.5s) with:\n            lane(3, at: start)\n"
            "            position(200m, at: start)\n            speed(19mps)\n"
            "        other.change_speed(target: 23mps, rate_profile: constant, rate_peak: 2mpss)\n"
            "        emit told\n"
            f"    serial:\n        ego.drive(duration: 0.2s) with:\n{indented(EGO, 3)}"
            f"{indented(body, 2)}"
            "        ego.drive(duration: 2s)\n"
        )
