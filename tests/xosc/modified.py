"""Scenarios with modifiers of drives, and with ways through points."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

from tests.xosc.case_texts import EGO, Case, indented, point

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


AIMS = {
    "lane": "lane(1, at: end)",
    "offset": "lateral(distance: 0.5m, side: left, measure_by: center_to_center, at: end)",
    "speed": "speed(26mps, at: end)",
    "other_speed": "speed(4mps, faster_than: other, at: end)",
    "ahead": "position(20m, ahead_of: other, at: end)",
}
OTHER = """\
other.drive() with:
    lane(3, at: start)
    position(190m, at: start)
    speed(21mps)
"""
FIRST = f"ego.drive(duration: 2s) with:\n{indented(EGO, 1)}"
PHASES = {  # a composition with a duration, what it holds, and how deep in it the drive stands
    "parallel": ("parallel(duration: 8s):", OTHER, 1, ""),
    "serial": ("parallel(duration: 8s):", f"{OTHER}serial:\n{indented(FIRST, 1)}", 2, FIRST),
    "inner": ("parallel(duration: 8s):", f"parallel:\n{indented(OTHER, 1)}", 2, ""),
    "ended": ("serial(duration: 8s):", f"parallel:\n{indented(OTHER, 1)}", 2, ""),
}


def phases() -> Iterator[Case]:
    """Yield drives that end with a composition around them, at a time that modifiers aim at."""
    for (name, modifier), (phase, parts) in product(AIMS.items(), PHASES.items()):
        head, beside, depth, before = parts
        start = "" if before else EGO.replace("20mps", "20mps, at: start")
        aims = f"{modifier}\n{start}"
        drive = f"ego.drive() with:\n{indented(aims, 1)}"
        yield f"{name}_in_{phase}", (
            f"ego, other: vehicle\ndo serial:\n    {head}\n{indented(beside, 2)}"
            f"{indented(drive, 1 + depth)}    ego.drive(duration: 0.5s)\n"
        )


LINES = {
    "replayed": "ego.replay_path(absolute: way)",
    "along": "ego.drive() with:\n    along(way)",
}
AFTER = {
    "drives": "ego.drive(duration: 1.5s)",
    "changes_lane": "ego.change_lane(side: left, duration: 3s)",
}
PLACES = ((240, -8.75), (260, -8.75), (310, -5.25), (330, -5.25))  # m
ENDS = {"slanting": 3, "parallel": 4}  # points


def lines() -> Iterator[Case]:
    """Yield ways that end on a slant or beside their lane, with what comes after."""
    for (name, act), (then, after), (how, count) in product(
        LINES.items(), AFTER.items(), ENDS.items()
    ):
        points = "".join(
            f"{point(f'p{index}', x, y)}pose{index}: pose_3d with:\n"
            f"    keep(it.position == p{index})\n"
            for index, (x, y) in enumerate(PLACES[:count])
        )
        named = ", ".join(f"pose{index}" for index in range(count))
        yield f"way_{name}_{how}_{then}", (
            f"ego: vehicle\n{points}way: path with:\n    keep(it.points == [{named}])\n"
            "    keep(it.interpolation == straight_line)\n"
            f"do serial:\n    ego.drive(duration: 0.2s) with:\n{indented(EGO, 2)}"
            f"{indented(act, 1)}    {after}\n    ego.drive(duration: 1s)\n"
        )


LONGER = {
    "aside_and_slower": "change_lane(side: right, duration: 2s) with:\n    speed(6mps)",
    "slower_and_aside": "change_speed(target: 19mps) with:\n    lateral(0.6m)",
    "covering": "drive(duration: 3s) with:\n    distance(75m)",
    "covering_less": "drive(duration: 3s) with:\n    distance(40m)",
    "not_changing": "change_speed(target: 20mps, duration: 1.2s)",
}
"""Actions that are over while a modifier or the acceleration goes on, or that change nothing."""

NEXT = {
    "rate": "ego.change_acceleration(target: 1mpss, duration: 2s)",
    "speed": "ego.change_speed(target: 15mps)",
    "wait": "wait elapsed(1s)\nego.change_lane(side: left)",
}


def interrupted() -> Iterator[Case]:
    """Yield actions that something outlasts, and what comes next."""
    for (name, action), (after, members) in product(LONGER.items(), NEXT.items()):
        if (name, after) == ("aside_and_slower", "rate"):
            continue  # which begins with an acceleration that only the run knows
        yield f"{name}_then_{after}", (
            f"ego: vehicle\ndo serial:\n    ego.drive(duration: 0.5s) with:\n{indented(EGO, 2)}"
            f"{indented('ego.' + action, 1)}{indented(members, 1)}"
        )
