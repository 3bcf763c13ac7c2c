"""Scenarios in which the start of an actor follows from others, from the map, or from a point."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

from tests.xosc.case_texts import Case, indented, point

# What is said about the start of the first actor, of whom the others speak.
OPEN = {
    "nowhere": "",
    "lane": "lane(2, at: start)",
    "left_lane": "lane(1, from: left, at: start)",
    "place": "lane(2, at: start)\nposition(60m, at: start)",
}
# The same of the second one.
SECOND = {
    "nowhere": "",
    "same_lane": "lane(2, at: start)",
    "behind": "lane(same_as: first, at: start)\nposition(25m, behind: first, at: start)",
    "left_behind": "lane(side_of: first, side: left, at: start)\n"
    "position(33m, behind: first, at: start)",
    "right_ahead": "lane(side_of: first, side: right, at: start)\n"
    "position(12m, ahead_of: first, at: start)",
}
PLACES_ACROSS = (-8.75, -8.1, -12.25, -16.0, 5.25)
HEADINGS = (0, 3, 12, 40, 180)


def starts(leftmost: frozenset[str]) -> Iterator[Case]:
    """Yield three actors each, of whom some find a place for themselves.

    Args:
        leftmost: Starts of the first one in a lane that has none to its left.
    """
    for (one, first), (other, second) in product(OPEN.items(), SECOND.items()):
        if other == "left_behind" and one in leftmost:
            continue
        yield f"{one}_and_{other}", (
            "first, second, third: vehicle\ndo parallel(duration: 3s):\n"
            f"    first.drive() with:\n        speed(12mps)\n{indented(first, 2)}"
            f"    second.drive() with:\n        speed(14mps)\n{indented(second, 2)}"
            "    third.drive() with:\n        speed(9mps)\n"
        )


def turned() -> Iterator[Case]:
    """Yield actors that start at a point in a lane or beside all, turned to it."""
    for across, heading in product(PLACES_ACROSS, HEADINGS):
        name = f"at_{across:g}_turned_{heading}".replace("-", "m").replace(".", "_")
        yield name, (
            f"ego: vehicle\n{point('there', 300, across)}do serial:\n"
            "    ego.drive(duration: 4s) with:\n"
            "        position(at_point: there, project_on_route: false, at: start)\n"
            f"        yaw({heading}deg, at: start)\n        speed(15mps)\n"
        )
