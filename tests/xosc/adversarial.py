"""Scenarios that look for a document that says something else than they do.

Each is short and ends in every run. They are combinations: what another actor does, and what is
asked of it; from which speed to which, and how; and so on. A family is one source text.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import product
from typing import NamedTuple

from tests.xosc.case_texts import EGO, Case, indented, point, source
from tests.xosc.cut_short import composed, cut
from tests.xosc.modified import interrupted, lines, phases, relative, timed
from tests.xosc.oncoming import oncoming
from tests.xosc.starts import OPEN, relative_starts, starts, turned, walkers

# --- conditions on another actor ------------------------------------------------------------------

# What the other one is, and what it does.
OTHERS = {
    "ahead": ("vehicle", "", "lane(2, at: start)\nposition(280m, at: start)\nspeed(10mps)"),
    "behind": ("vehicle", "", "lane(2, at: start)\nposition(140m, at: start)\nspeed(28mps)"),
    "beside": ("vehicle", "", "lane(3, at: start)\nposition(280m, at: start)\nspeed(10mps)"),
    "beside_behind": ("vehicle", "", "lane(1, at: start)\nposition(150m, at: start)\nspeed(28mps)"),
    "truck_ahead": ("truck", "", "lane(2, at: start)\nposition(290m, at: start)\nspeed(12mps)"),
    "against": (
        "vehicle",
        point("far", 500, -8.75),
        "position(at_point: far, project_on_route: false, at: start)\n"
        "yaw(180deg, at: start)\nspeed(15mps)",
    ),
    "oncoming": (
        "vehicle",
        point("far", 500, 5.25),
        "position(at_point: far, project_on_route: false, at: start)\nspeed(15mps)",
    ),
    "walker_across": (
        "person",
        point("far", 330, -24),
        "position(at_point: far, project_on_route: false, at: start)\n"
        "yaw(90deg, at: start)\nspeed(2mps)",
    ),
    "walker_slanting": (
        "person",
        point("far", 400, -20),
        "position(at_point: far, project_on_route: false, at: start)\n"
        "yaw(150deg, at: start)\nspeed(2mps)",
    ),
}
CONDITIONS = {
    "near": "ego.object_distance(reference: other, direction: longitudinal) < 40m",
    "passed": "ego.object_distance(reference: other, direction: longitudinal) < -10m",
    "along_road": "ego.road_distance(reference: other, direction: longitudinal) < 30m",
    "straight": "ego.object_distance(reference: other, direction: euclidean) < 45m",
    "gap": "ego.space_gap(reference: other, direction: longitudinal) > -35m",
    "headway": "ego.time_headway(reference: other) < 2s",
    "time_gap": "ego.time_gap(reference: other, direction: longitudinal) > -1.5s",
    "collision": "ego.time_to_collision(reference: other) < 3s",
}


def _on_another() -> Iterator[Case]:
    for (other, (kind, place, moves)), (name, condition) in product(
        OTHERS.items(), CONDITIONS.items()
    ):
        acts = "walk" if kind == "person" else "drive"
        is_truck = kind == "truck"
        kind = "vehicle" if is_truck else kind
        keep = " with:\n    keep(it.vehicle_category == truck)" if is_truck else ""
        yield f"{name}_{other}", (
            f"ego: vehicle\nother: {kind}{keep}\n{place}do parallel:\n"
            f"    other.{acts}() with:\n{indented(moves, 2)}"
            "    serial:\n        one_of:\n"
            f"            ego.drive() with:\n{indented(EGO, 4)}"
            f"                until {condition}\n"
            "            wait elapsed(9s)\n"
            "        ego.change_speed(target: 15mps, rate_profile: constant, rate_peak: 2mpss)\n"
        )


# --- changes of the speed -------------------------------------------------------------------------

KINDS = {"car": "", "truck": "truck", "motorcycle": "motorcycle"}
PROFILES = ("none", "constant", "smooth", "asap")


def _speeds() -> Iterator[Case]:
    changes = ((10, 18), (18, 10), (12, 0), (0, 8), (-3, 2))
    for (start, end), profile, peak in product(changes, PROFILES, (None, 1.5, 7.5)):
        if peak == 7.5 and profile in ("none", "asap"):
            continue  # as much as limits that are there anyway
        said = "" if peak is None else f", rate_peak: {peak:g}mpss"
        name = f"from_{start}_to_{end}_{profile}".replace("-", "minus_")
        yield f"{name}_{'usual' if peak is None else f'{peak:g}'.replace('.', '_')}", (
            "ego: vehicle\ndo serial:\n"
            f"    ego.change_speed(target: {end}mps, rate_profile: {profile}{said}) with:\n"
            "        lane(2, at: start)\n        position(300m, at: start)\n"
            f"        speed({start}mps, at: start)\n"
            "    ego.drive(duration: 1s)\n"
            "    ego.change_lane(side: left)\n"
            "    ego.change_speed(target: 14mps, rate_profile: asap)\n"
        )


# --- changes of the lane, and of the place in it --------------------------------------------------

LATERAL = {
    "usual": "change_lane(side: left)",
    "two": "change_lane(num_of_lanes: 2, side: left)",
    "right": "change_lane(side: right, duration: 2.5s)",
    "slow": "change_lane(side: left, duration: 6s)",
    "even": "change_lane(side: right, rate_profile: constant)",
    "asap": "change_lane(side: left, rate_profile: asap)",
    "smooth_peak": "change_lane(side: left, rate_profile: smooth, rate_peak: 1.2mps)",
    "to_an_offset": "change_lane(side: left, offset: 0.6m)",
    "beside_another": "change_lane(num_of_lanes: 1, side: left, reference: other)",
}
WHILE = {
    "at_a_speed": "ego.drive(duration: 7s)",
    "while_braking": "ego.change_speed(target: 5mps, rate_profile: constant, rate_peak: 2mpss)",
    "while_speeding_up": "ego.change_speed(target: 28mps, rate_profile: smooth)",
}


def _lanes() -> Iterator[Case]:
    for (name, change), (when, pace) in product(LATERAL.items(), WHILE.items()):
        yield f"lane_{name}_{when}", (
            "ego, other: vehicle\ndo parallel:\n"
            "    other.drive() with:\n        lane(2, at: start)\n"
            "        position(300m, at: start)\n        speed(18mps)\n"
            f"    serial:\n        ego.drive(duration: 1s) with:\n{indented(EGO, 3)}"
            f"        parallel:\n            ego.{change}\n            {pace}\n"
            "        ego.drive(duration: 0.5s)\n"
        )


# --- events that come again, or late --------------------------------------------------------------

REACTIONS = {
    "speed": ("rise(ego.speed > 22mps)", "rate_profile: constant, rate_peak: 3mpss"),
    "slow": ("rise(ego.speed < 19mps)", "rate_profile: constant, rate_peak: 4mpss"),
    "smooth": ("rise(ego.speed > 21mps)", "rate_profile: smooth, rate_peak: 3mpss"),
}


def _again() -> Iterator[Case]:
    for (name, (condition, how)), late in product(REACTIONS.items(), ("0s", "0.7s", "2s")):
        waits = f"wait elapsed({late})"
        yield f"again_{name}_{late[:-1]}".replace(".", "_"), (
            f"ego, other: vehicle\nevent seen is {condition}\nevent told\non @seen:\n"
            "    emit told\n"
            "do parallel:\n    serial:\n"
            f"        ego.drive(duration: 1s) with:\n{indented(EGO, 3)}"
            f"        ego.change_speed(target: 25mps, {how})\n"
            f"        ego.change_speed(target: 17mps, {how})\n"
            f"        ego.change_speed(target: 25mps, {how})\n"
            f"        ego.change_speed(target: 17mps, {how})\n"
            "    serial:\n        other.drive(duration: 1s) with:\n"
            "            lane(3, at: start)\n            position(200m, at: start)\n"
            "            speed(20mps)\n"
            f"        wait @told\n        {waits}\n"
            "        other.change_speed(target: 23mps, rate_profile: constant, rate_peak: 5mpss)\n"
            f"        wait @told\n        {waits}\n"
            "        other.change_lane(side: left, duration: 2s)\n"
        )


# --- walkers, and those who go backwards ----------------------------------------------------------

WALKS = {
    "faster": "walker.change_speed(target: 3mps, rate_profile: constant, rate_peak: 1mpss)",
    "stops": "walker.remain_stationary(duration: 2s)",
    "turns": "walker.assign_orientation(orientation: turned)",
    "runs": "walker.change_speed(target: 4mps, rate_profile: smooth)",
    "jumps": "walker.assign_position(position: far)",
    "goes": "walker.change_position(target_xyz: far, interpolation: straight_line,"
    " on_road_network: false)",
}


def _walks() -> Iterator[Case]:
    for (name, act), yaw, then in product(WALKS.items(), (0, 120), ("1.5", "0.5")):
        yield f"walker_{name}_{yaw}_then_{then}".replace(".", "_"), (
            "walker: person\n"
            + point("near", 220, -5)
            + point("far", 224, -9)
            + "turned: orientation_3d with:\n    keep(it.yaw == 70deg)\n"
            "    keep(it.pitch == 0deg)\n    keep(it.roll == 0deg)\n"
            "do serial:\n    walker.walk(duration: 2s) with:\n"
            "        position(at_point: near, project_on_route: false, at: start)\n"
            f"        yaw({yaw}deg, at: start)\n        speed(1.2mps)\n    {act}\n"
            "    walker.walk(duration: 2s)\n"
            f"    walker.walk(duration: 2s) with:\n        speed({then}mps)\n"
        )


# --- places by that of another one, and late starts -----------------------------------------------

BESIDE = {
    "ahead": "position(30m, ahead_of: other, at: start)\nlane(same_as: other, at: start)",
    "behind": "position(40m, behind: other, at: start)\nlane(same_as: other, at: start)",
    "left": "position(10m, behind: other, at: start)\nlane(side_of: other, side: left, at: start)",
    "right": "position(5m, ahead_of: other, at: start)\n"
    "lane(side_of: other, side: right, at: start)",
}
WITH_SPEED = {
    "own": "speed(18mps)",
    "as_other": "speed(speed: 0mps, faster_than: other, at: start)",
    "slower": "speed(speed: 3mps, slower_than: other, at: start)",
}


def _placed() -> Iterator[Case]:
    for (where, place), (how, speed), late in product(
        BESIDE.items(), WITH_SPEED.items(), ("0s", "1.5s")
    ):
        yield f"placed_{where}_{how}_{late[:-1]}".replace(".", "_"), (
            "ego, other: vehicle\ndo parallel:\n    serial:\n"
            f"        ego.drive(duration: 2s) with:\n{indented(place, 3)}{indented(speed, 3)}"
            "        ego.change_speed(target: 14mps, rate_profile: constant)\n"
            "    serial:\n        other.drive(duration: 1s) with:\n            lane(2, at: start)\n"
            "            position(250m, at: start)\n            speed(20mps)\n"
            f"        wait elapsed({late})\n"
            "        other.change_lane(side: left)\n"
        )


class Family(NamedTuple):
    """Scenarios of one source text."""

    names: tuple[str, ...]
    source: str


def _family(cases: Iterable[Case], map_: str = "highway") -> Family:
    listed = tuple(cases)
    return Family(tuple(name for name, _ in listed), source(listed, map_))


ALL_BUT_OPEN = frozenset(OPEN) - {"nowhere"}
"""Starts in the leftmost lane of a road with two."""

FAMILIES: Mapping[str, Family] = {
    "on_another": _family(_on_another()),
    "speeds": _family(_speeds()),
    "lanes": _family(_lanes()),
    "again": _family(_again()),
    "cut": _family(cut()),
    "composed": _family(composed()),
    "timed": _family(timed()),
    "oncoming": _family(oncoming()),
    "relative": _family(relative()),
    "lines": _family(lines()),
    "phases": _family(phases()),
    "interrupted": _family(interrupted()),
    "placed": _family(_placed()),
    "starts": _family(starts("straight", frozenset({"left_lane"}))),
    "starts_in_a_bend": _family(starts("bend", ALL_BUT_OPEN), "curve"),
    "starts_on_the_left": _family(starts("left", ALL_BUT_OPEN), "left_hand"),
    "turned": _family(turned()),
    "relative_starts": _family(relative_starts()),
    "walkers": _family(walkers(), "curve"),
    "walks": _family(_walks(), "crossing"),
}
