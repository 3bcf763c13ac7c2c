"""The slips of newcomers, each mended by the fixes that are offered, as a tool would do it."""

from __future__ import annotations

from pathlib import Path

import pytest

from osc2tx.building.fixing import fix_text
from osc2tx.building.jobs import job_for
from osc2tx.compilation.inputs import Input
from osc2tx.config import ConfigFiles, GivenOptions
from osc2tx.diagnostics import Severity

TEXT = """import osc.standard

scenario newcomer:
    ego: vehicle
    other: vehicle
    limit: speed = 50kph
    do parallel:
        ego.drive(duration: 5s) with:
            speed(limit)
            lane(1, at: start)
        serial:
            other.drive() with:
                speed(30kph)
                until other.speed > 10mps
            other.change_lane(num_of_lanes: 1, side: left)
"""
# What is written, and what is written instead; a reason where no fix can know the text.
SLIPS: list[tuple[str, str]] = [
    ("scenario newcomer", "scenaro newcomer"),
    ("ego: vehicle", "ego: vehicel"),
    ("ego: vehicle", "ego: car"),
    ("speed = 50kph", "speed = 50 kph"),
    ("speed = 50kph", "speed = 50km/h"),
    ("speed = 50kph", "speed = 50kmh"),
    ("speed = 50kph", 'speed = "50kph"'),
    ("do parallel:", "do parallel"),
    ("do parallel:", "do paralel:"),
    ("do parallel:", "do together:"),
    ("duration: 5s", "duration = 5s"),
    ("duration: 5s", "duration: 5 s"),
    ("duration: 5s", "duraton: 5s"),
    ("drive(duration: 5s) with:", "drive(duration: 5s):"),
    ("drive(duration: 5s) with:", "drive(duration: 5s) with {"),
    ("drive(duration: 5s)", "driv(duration: 5s)"),
    ("speed(limit)", "speed(limits)"),
    ("speed(limit)", "speed(limit);"),
    ("speed(limit)", "velocity(limit)"),
    ("speed(limit)", "speed(40kph..60kph)"),
    ("lane(1, at: start)", "lane(1, at start)"),
    ("lane(1, at: start)", "lane(1, at: strat)"),
    ("lane(1, at: start)", "lane(1, at: start))"),
    ("until other.speed > 10mps", "until: other.speed > 10mps"),
    ("until other.speed > 10mps", "until other.sped > 10mps"),
    ("until other.speed > 10mps", "until other.speed > 10mps && true"),
    ("until other.speed > 10mps", "until other.speed > 10mps  // fast"),
    ("num_of_lanes: 1, side: left", "left"),
    ("other.change_lane(num_of_lanes: 1, side: left)", "wait until other.speed > 3mps"),
    ("other.change_lane(num_of_lanes: 1, side: left)", "other.drive() until other.speed > 3mps"),
    (
        "other.change_lane(num_of_lanes: 1, side: left)",
        "other.drive(50kph) until other.speed > 12mps",
    ),
    ("other.change_lane(num_of_lanes: 1, side: left)", "other.drive() for 3s"),
    ("other.change_lane(num_of_lanes: 1, side: left)", "wait 5s"),
    ("other.change_lane(num_of_lanes: 1, side: left)", "other.drive(50kph)"),
    ("other.change_lane(num_of_lanes: 1, side: left)", "other.drive(speed: 50kph, duration: 2s)"),
    ("other.change_lane(num_of_lanes: 1, side: left)", "other.drive(2s) -> other.drive(3s)"),
    ("other.change_lane(num_of_lanes: 1, side: left)", "wait(@other_done)"),
    ("other.change_lane(num_of_lanes: 1, side: left)", "other.drive() with: speed(20kph)"),
    ("lane(1, at: start)", "position(20m, lane: 1, at: start)"),
    ("limit: speed = 50kph", "limit: speed in [40kph..50kph]"),
    ("limit: speed = 50kph", "limit: speed = 50 km/h"),
    ("speed(30kph)", "acceleration(2mps2)"),
    ("other: vehicle", "other: vehicle\n    cars: vehicle[5]"),
    ("other.change_lane(num_of_lanes: 1, side: left)", "repeat(3):"),
    ("other.change_lane(num_of_lanes: 1, side: left)", "while true:"),
    ("other.change_lane(num_of_lanes: 1, side: left)", "other.turn_left()"),
    ("import osc.standard", "import osc.standrad"),
]
WITHOUT = {"repeat(3):", "while true:", "other.turn_left()"}  # loops, and a turn without a route


def is_mended(text: str, folder: Path) -> bool:
    path = folder / "newcomer.osc"
    job = job_for(Input(path, path, folder, True), GivenOptions(), ConfigFiles().for_source(path))
    fixed = fix_text(job, text, unsafe=True).text
    compilation = job.compilation(text=fixed)
    compilation.check()
    return not any(d.severity is Severity.ERROR for d in compilation.diagnostics)


def test_the_text_is_right(tmp_path: Path) -> None:
    assert is_mended(TEXT, tmp_path)


def test_slips_are_mended(tmp_path: Path) -> None:
    texts = [TEXT.replace(right, wrong, 1) for right, wrong in SLIPS]
    assert TEXT not in texts
    left = {w for (_, w), text in zip(SLIPS, texts, strict=True) if not is_mended(text, tmp_path)}
    assert len(SLIPS) >= 30
    assert left == WITHOUT


@pytest.mark.parametrize("slip", SLIPS, ids=lambda slip: slip[1])
def test_each_slip_is_found(slip: tuple[str, str], tmp_path: Path) -> None:
    path = tmp_path / "newcomer.osc"
    job = job_for(Input(path, path, tmp_path, True), GivenOptions(), ConfigFiles().for_source(path))
    compilation = job.compilation(text=TEXT.replace(*slip, 1))
    assert not compilation.check()
    found = [d for d in compilation.diagnostics if d.severity is Severity.ERROR]
    assert found and all(d.help or d.fixes or d.labels for d in found[:1])
