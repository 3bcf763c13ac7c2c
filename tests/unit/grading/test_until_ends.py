"""Members that are over before their `until` fail, and so do their documents (§7.6.2.5.4)."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from osc2tx.backends.xosc import XmlScenario
from osc2tx.compilation.driver import Compilation
from osc2tx.losses.entries import Grade
from osc2tx.options import CompileOptions, XmlOptions, XmlVersion
from osc2tx.xosc import read
from osc2tx.xosc.player import Evaluator
from osc2tx_runtime.opendrive import read_map
from osc2tx_shared.map_files import SHIPPED
from tests.unit.grading.test_grading import grade

HEAD = """\
import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle

    do serial:
"""
FASTER = """\
        ego.change_speed({time}target: 20mps, rate_profile: constant) with:
            lane(2, at: start)
            position(50m, at: start)
            speed(10mps, at: start)
            until {until}
        ego.drive(duration: 1s)
"""
"""From 10 to 20 m/s; at 4 m/s^2 that takes 2.5 s."""
RATE = "rate_peak: 4mpsps, "

OF_A_SERIAL = """\
        serial:
            ego.change_speed(rate_peak: 4mpsps, target: 20mps, rate_profile: constant) with:
                lane(2, at: start)
                position(50m, at: start)
                speed(10mps, at: start)
            ego.change_lane(num_of_lanes: 1, side: left, duration: 3s)
        with:
            until {until}
        ego.drive(duration: 1s)
"""
RACE = """\
        one_of:
            ego.change_speed(rate_peak: 4mpsps, target: 20mps, rate_profile: constant) with:
                lane(2, at: start)
                position(50m, at: start)
                speed(10mps, at: start)
                until ego.speed > {limit}mps
            wait elapsed(6s)
        ego.drive(duration: 1s)
"""
OF_A_DRIVE = """\
        ego.drive(duration: {time}) with:
            lane(2, at: start)
            position(50m, at: start)
            speed(10mps, at: start)
            acceleration(2mpsps)
            until ego.speed > 15mps
        ego.drive(duration: 1s)
"""


def graded(folder: Path, text: str, version: XmlVersion = "1.3") -> XmlScenario:
    path = folder / "top.osc"
    path.write_text(HEAD + text, encoding="utf-8")
    options = XmlOptions(version=version, allow_approx=True)
    (found,) = Compilation(path, path.name, CompileOptions(xml=options)).graded_xml
    return found


def grades_of_until(found: XmlScenario) -> Iterator[Grade]:
    return (each.grade for each in found.report.entries if each.construct == "until")


def play(found: XmlScenario) -> tuple[float, bool]:
    """Return when a document ends and whether its verdict is success."""
    assert found.xml is not None
    player = Evaluator(read(found.xml), read_map(SHIPPED / "highway.xodr"), 0.05)
    return player.play(30.0), all(player.globals.monitors.values())


@pytest.mark.parametrize(
    ("text", "end", "succeeds"),
    [
        (FASTER.format(time=RATE, until="ego.speed > 15mps"), 2.25, True),
        (FASTER.format(time=RATE, until="ego.speed > 25mps"), 2.5, False),
        (FASTER.format(time=RATE, until="elapsed(2s)"), 3.0, True),
        (FASTER.format(time=RATE, until="elapsed(2.5s)"), 3.5, True),
        (OF_A_SERIAL.format(until="ego.speed > 15mps"), 2.25, True),
        (OF_A_SERIAL.format(until="ego.speed > 25mps"), 5.5, False),
        (RACE.format(limit=15), 2.25, True),
        (RACE.format(limit=25), 7.0, True),  # the other one wins
        (OF_A_DRIVE.format(time="[2s..5s]"), 3.5, True),
        (OF_A_DRIVE.format(time="[1s..4s]"), 3.5, True),  # later than the middle of the range
        (OF_A_DRIVE.format(time="[3s..5s]"), 2.5, False),
        (OF_A_DRIVE.format(time="[1s..2s]"), 3.0, True),
        (OF_A_DRIVE.format(time="5s"), 2.5, False),
        (OF_A_DRIVE.format(time="2s"), 2.0, False),
    ],
)
def test_a_document_ends_as_its_run(text: str, end: float, succeeds: bool, tmp_path: Path) -> None:
    """Ends are computed by hand; each event may be seen a step later."""
    found = graded(tmp_path, text)
    assert found.report.measured is not None, found.report.unmeasured
    assert set(grades_of_until(found)) == {Grade.EXACT}, found.report_json
    ended, verdict = play(found)
    assert end - 1e-6 <= ended <= end + 0.3 and verdict is succeeds, (ended, verdict)


def test_what_surely_is_over_before_is_refused(tmp_path: Path) -> None:
    found = graded(tmp_path, FASTER.format(time=RATE, until="elapsed(3s)"))
    assert found.xml is None
    (obstacle,) = found.report.obstacles
    assert "after 2.5 s, before its `until` at 3 s: every run fails" in obstacle.reason


def test_without_a_verdict_the_run_decides(tmp_path: Path) -> None:
    in_time, late = (FASTER.format(time=RATE, until=f"ego.speed > {v}mps") for v in (15, 25))
    assert set(grades_of_until(graded(tmp_path, in_time, "1.2"))) == {Grade.EXACT}
    found = graded(tmp_path, late, "1.2")
    assert Grade.APPROXIMATED in grades_of_until(found)
    assert found.report.unmeasured.startswith("the run in the world fails")


def test_a_document_that_fails_alone_deviates(tmp_path: Path) -> None:
    text = HEAD + FASTER.format(time=RATE, until="ego.speed > 15mps")
    found, compilation = grade(tmp_path, waits_longer, text=text)
    assert found.xml is None
    (error,) = (each for each in compilation.diagnostics if each.code == "OSC518")
    assert any(note.startswith("it fails at 2.5") for note in error.notes), error.notes


def waits_longer(document: str) -> str:
    """Return a document that looks for a speed that the actor does not come to."""
    changed = re.sub(r'(<SpeedCondition[^/]*) value="15"', r'\1 value="25"', document)
    assert changed != document
    return changed
