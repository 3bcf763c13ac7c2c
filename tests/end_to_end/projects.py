"""A project of many scenarios: libraries with types, modifiers and bases, and users of them."""

from __future__ import annotations

from pathlib import Path

KINDS = """\
import osc.standard.all

namespace null use std, stdtypes

enum mood: [calm, brisk]

struct style:
    mood: mood = calm
    peak: acceleration = 2mpss
    keep(mood == brisk => peak == 3mpss)

# The vehicle under test.
actor test_car inherits vehicle:
    seats: int = 5
    style: style

actor long_car inherits test_car:
    payload: mass = 500kg
"""
MODIFIERS = """\
import osc.standard.all

namespace null use std, stdtypes

modifier easy of vehicle.drive:
    top: speed
    speed(top)
    keep_lane()

modifier starts_in of vehicle.drive:
    in_lane: int
    along_road: length
    lane(in_lane, at: start)
    position(along_road, at: start)
"""
BASE = """\
import osc.standard.all
import "kinds.osc"

namespace null use std, stdtypes

# What all scenarios on this road share.
scenario on_highway:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: test_car
    v_ego: speed with:
        keep(it in [60kph..100kph])
    event passed(gap: length)

scenario measured_highway inherits on_highway:
    cover(v_ego, unit: kph, range: [60..100], every: 10)
"""
SCENARIO = """\
import osc.standard.all
import "../lib/base.osc"
import "../lib/modifiers.osc"

namespace null use std, stdtypes

# Number {number}: the other one passes on the left.
scenario pass_{number} inherits measured_highway:
    keep(v_ego <= {v_max}kph)
    other: {kind}
    # How much faster
    ahead: speed = {ahead}kph
    event clear
    on @passed as p if p.gap > 1m:
        emit clear
    do parallel:
        ego.drive() with:
            lane(2, at: start)
            position(100m, at: start)
            speed(v_ego)
        other_passes: serial:
            come_near: other.drive() with:
                lane(3, at: start)
                position(60m, at: start)
                speed(v_ego + ahead)
                until rise(other.space_gap(reference: ego, direction: longitudinal) >= {gap}m)
            emit passed(other.space_gap(reference: ego, direction: longitudinal))
            other.drive(duration: 2s) with:
                easy(top: 90kph)
"""


def write_project(root: Path, number: int) -> Path:
    """Write a project of as many scenarios and its libraries; return the folder of its sources."""
    library, sources = root / "scenarios" / "lib", root / "scenarios" / "passing"
    library.mkdir(parents=True)
    sources.mkdir()
    texts = {"kinds": KINDS, "modifiers": MODIFIERS, "base": BASE}
    for name, text in texts.items():
        (library / f"{name}.osc").write_text(text, encoding="utf-8")
    for index in range(number):
        text = SCENARIO.format(
            number=index,
            v_max=70 + index % 30,
            kind=("vehicle", "test_car", "long_car")[index % 3],
            ahead=5 + index % 20,
            gap=5 + index % 7,
        )
        (sources / f"pass_{index}.osc").write_text(text, encoding="utf-8")
    return root / "scenarios"
