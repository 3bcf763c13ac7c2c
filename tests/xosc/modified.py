"""Scenarios in which modifiers say what a drive of some length does."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

from tests.xosc.case_texts import EGO, Case, indented

MODIFIERS = {
    "faster": "speed(30mps)",
    "slower": "speed(8mps)",
    "speeding_up": "acceleration(1.5mpss)",
    "braking": "acceleration(-2mpss)",
    "aside": "lateral(distance: 0.5m, side: left, measure_by: center_to_center)",
    "to_a_lane": "lane(1, at: end)",
    "to_a_speed": "speed(24mps, at: end)",
    "as_told": "speed(26mps)\nacceleration(3mpss)",
    "kept": "keep_speed()\nkeep_lane()",
}
BEFORE = {
    "steady": "ego.drive(duration: 1s)",
    "cut": "ego.drive(duration: 1s) with:\n    speed(10mps)",
    "moved": "ego.drive(duration: 1s) with:\n"
    "    lateral(distance: 0.6m, side: right, measure_by: center_to_center)",
}


def timed() -> Iterator[Case]:
    """Yield drives that may be too short for what they are to do."""
    for (name, modifiers), length, (state, before) in product(
        MODIFIERS.items(), ("1", "3.5"), BEFORE.items()
    ):
        yield f"timed_{name}_{length}_{state}".replace(".", "_"), (
            f"ego: vehicle\ndo serial:\n    ego.drive(duration: 0.2s) with:\n{indented(EGO, 2)}"
            f"{indented(before, 1)}"
            f"    ego.drive(duration: {length}s) with:\n{indented(modifiers, 2)}"
            "    ego.drive(duration: 2s)\n"
        )


BY_ANOTHER = {
    "faster": "speed(3mps, faster_than: other)",
    "slower": "speed(3mps, slower_than: other)",
    "to_be_ahead": "position(20m, ahead_of: other, at: end)",
    "to_be_behind": "position(15m, behind: other, at: end)",
    "to_its_lane": "lane(same_as: other, at: end)",
    "beside_it": "lane(side_of: other, side: left, at: end)",
    "beside_it_soon": "lane(side_of: other, side: left)",
}
WHAT_IT_DOES = {
    "drives": "other.drive(duration: 6s)",
    "brakes": "other.change_speed(target: 12mps, rate_profile: constant, rate_peak: 1.5mpss)",
    "goes_aside": "other.change_lane(side: right, duration: 4s)",
}


def relative() -> Iterator[Case]:
    """Yield drives by another actor, which does something at the same time."""
    for (name, modifier), (what, act), length in product(
        BY_ANOTHER.items(), WHAT_IT_DOES.items(), (3, 5)
    ):
        yield f"{name}_that_{what}_{length}", (
            "ego, other: vehicle\ndo parallel:\n    serial:\n"
            "        other.drive(duration: 1s) with:\n            lane(3, at: start)\n"
            "            position(220m, at: start)\n            speed(19mps)\n"
            f"        {act}\n"
            f"    serial:\n        ego.drive(duration: 0.5s) with:\n{indented(EGO, 3)}"
            f"        ego.drive(duration: {length}s) with:\n{indented(modifier, 3)}"
            "        ego.drive(duration: 1s)\n"
        )
