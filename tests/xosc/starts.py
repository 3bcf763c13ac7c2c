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
# How one stands of whom others speak: turned, beside the centre of its lane, at a point.
REFERENCES = {
    "turned": "lane(2, at: start)\nposition(200m, at: start)\nyaw(180deg, at: start)",
    "aside": "lane(2, at: start)\nposition(200m, at: start)\n"
    "lateral(distance: 0.8m, side: left, at: start)\nspeed(12mps)",
    "against": "position(at_point: there, project_on_route: false, at: start)\n"
    "yaw(180deg, at: start)\nspeed(5mps)",
    "near_point": "position(at_point: there, at: start)\nspeed(8mps)",
}
# Starts that speak of it.
RELATIVE = {
    "heading": "lane(3, at: start)\nposition(100m, at: start)\n"
    "yaw(0deg, relative_to: other, at: start)",
    "behind": "lane(same_as: other, at: start)\nposition(30m, behind: other, at: start)",
    "in_time": "lane(side_of: other, side: right, at: start)\n"
    "position(time: 2s, behind: other, at: start)",
    "edges": "lane(same_as: other, at: start)\nposition(30m, behind: other, at: start)\n"
    "lateral(distance: 0.3m, side: right, measure_by: right_to_right, at: start)",
    "beside": "position(30m, ahead_of: other, at: start)\n"
    "lateral(distance: 3m, side_of: other, side: left, at: start)",
    "numbered": "lane(1, at: start)\nposition(30m, ahead_of: other, at: start)",
    "along_road": "lane(side_of: other, side: left, at: start)\nposition(120m, at: start)",
}
PLACES_ACROSS = (-8.75, -8.1, -12.25, -16.0, 5.25)
HEADINGS = (0, 3, 12, 40, 180)


def starts(road: str, leftmost: frozenset[str]) -> Iterator[Case]:
    """Yield three actors each, of whom some find a place for themselves.

    Args:
        road: A word for it.
        leftmost: Starts of the first one in a lane that has none to its left.
    """
    for (one, first), (other, second) in product(OPEN.items(), SECOND.items()):
        if other == "left_behind" and one in leftmost:
            continue
        yield f"{road}_{one}_and_{other}", (
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


def relative_starts() -> Iterator[Case]:
    """Yield actors that start relative to one that stands in an unusual way."""
    for (one, reference), (other, place) in product(REFERENCES.items(), RELATIVE.items()):
        yield f"{other}_of_{one}", (
            f"ego, other: vehicle\n{point('there', 300, -8.75)}do parallel(duration: 3s):\n"
            f"    other.drive() with:\n{indented(reference, 2)}"
            f"    ego.drive() with:\n        speed(10mps)\n{indented(place, 2)}"
        )


def walkers() -> Iterator[Case]:
    """Yield persons that set out from a lane, in which they do not stay."""
    for heading, aside in product(HEADINGS, ("0m", "1m")):
        yield f"turned_{heading}_aside_{aside}", (
            "ego: person\ndo parallel(duration: 9s):\n    ego.walk() with:\n"
            "        lane(1, at: start)\n        position(250m, at: start)\n"
            f"        lateral(distance: {aside}, side: left, at: start)\n"
            f"        yaw({heading}deg, at: start)\n        speed(3mps)\n"
        )
