"""A place along the road that is due in a time: an even change of the speed, in bends as well."""

from pathlib import Path

import pytest

from osc2tx.backends.xosc import emit
from osc2tx.options import XmlOptions
from osc2tx.xosc import elements as xml
from osc2tx.xosc import read
from osc2tx_runtime import RunSettings
from tests.unit.backends.xosc.documents import PLAIN, compiled, graded_documents
from tests.xosc.parity import played, world

SOURCE = """import osc.standard.all

namespace null use std, stdtypes

scenario due:
    road: map with:
        keep(it.map_file == "curve.xodr")
    a: vehicle
    do a.drive(duration: 6s) with:
        lane(1, at: start)
        position(160m, at: start)
        speed(16mps, at: start)
        position(260m, at: end)
"""
RADIUS, SLOPE = 120.0, 0.05  # of the reference line (m), and across the road there
OUTSIDE = 5.25  # m from it to the middle of lane 1
WAY = 100.0 * (1.0 + OUTSIDE * (1.0 - 0.5 * SLOPE**2) / RADIUS)
END = 2.0 * WAY / 6.0 - 16.0  # m/s


def test_the_speed_at_the_end_is_that_of_an_even_change(tmp_path: Path) -> None:
    path = tmp_path / "due.osc"
    path.write_text(SOURCE, encoding="utf-8")
    module = compiled(path, PLAIN).ir
    assert module is not None
    (document,) = emit(module, XmlOptions(), path.parent)
    assert document.xml is not None and not document.report.losses
    storyboard = read(document.xml).one(xml.Storyboard)
    (speed,) = storyboard.one(xml.Story).below(xml.AbsoluteTargetSpeed)
    assert speed.value == pytest.approx(END, abs=0.01)
    expected = world(path, "due", RunSettings(dt=0.01), PLAIN).track["a"][-1]
    found = played(document.xml, 0.01).track["a"][-1]
    assert found[1:3] == pytest.approx(expected[1:3], abs=0.1)


def test_later_it_is_only_known_during_the_run(tmp_path: Path) -> None:
    head, _ = SOURCE.split("    do ")
    path = tmp_path / "due.osc"
    path.write_text(
        head + "    do serial:\n"
        "        a.drive(duration: 1s) with:\n"
        "            speed(16mps)\n"
        "        a.drive(duration: 6s) with:\n"
        "            position(260m, at: end)\n",
        encoding="utf-8",
    )
    module = compiled(path, PLAIN).ir
    assert module is not None
    (document,) = emit(module, XmlOptions(allow_approx=True), path.parent)
    assert document.xml is None
    assert any("only known during the run" in each.reason for each in document.report.obstacles)


BESIDE = """import osc.standard.all

namespace null use std, stdtypes

scenario beside:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego, other: vehicle
    do parallel:
        ego.drive(duration: 8s) with:
            lane(2, at: start)
            position(200m, at: start)
            speed(22mps)
        serial:
            other.drive(duration: 6s) with:
                lane(3, at: start)
                position(20m, behind: ego, at: start)
                speed(24mps, at: start)
                position({ahead}m, ahead_of: ego, at: end)
                speed({speed}, at: end)
            other.drive(duration: 2s)
"""


def test_a_place_and_a_speed_at_the_end(tmp_path: Path) -> None:
    path = tmp_path / "beside.osc"
    path.write_text(BESIDE.format(ahead=5, speed="22mps"), encoding="utf-8")
    (document,) = graded_documents(compiled(path), XmlOptions())
    assert document.xml is not None and not document.report.losses
    expected = world(path, "beside", RunSettings(dt=0.01), PLAIN).track["other"]
    found = played(document.xml, 0.01).track["other"]
    for before, after in zip(expected[::100], found[::100], strict=True):
        assert after[1:3] == pytest.approx(before[1:3], abs=0.06)
    assert found[620][3] == pytest.approx(22.0)


@pytest.mark.parametrize(
    ("ahead", "speed", "reason"),
    [
        (5, "2mps, faster_than: ego", "a speed relative to another one, at the end of the way"),
        (40, "22mps", "it takes a larger acceleration than the actor has"),
    ],
)
def test_what_does_not_lead_there_says_so(
    ahead: int, speed: str, reason: str, tmp_path: Path
) -> None:
    path = tmp_path / "beside.osc"
    path.write_text(BESIDE.format(ahead=ahead, speed=speed), encoding="utf-8")
    (document,) = graded_documents(compiled(path), XmlOptions(allow_approx=True))
    assert any(reason in each.reason for each in document.report.losses)
