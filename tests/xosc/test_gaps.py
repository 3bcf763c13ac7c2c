"""Gaps that are kept rigid, while the other one moves aside."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest

from osc2tx.backends.xosc import XmlScenario
from osc2tx.grading.comparison import Row
from osc2tx.options import XML_VERSIONS, XmlOptions, XmlVersion
from osc2tx_runtime import RunSettings
from tests.unit.backends.xosc.documents import PLAIN
from tests.xosc.parity import Given, played, scenarios, world

SOURCE = """\
import osc.standard.all

namespace null use std, stdtypes

scenario side_by_side:
    road: map with:
        keep(it.map_file == "highway.xodr")
    leader, side_car: vehicle

    do parallel:
        serial:
            leader.drive(duration: 4s) with:
                lane(2, at: start)
                position(120m, at: start)
                speed(20mps)
            leader.change_lane(side: right, duration: 4s)
            leader.drive(duration: 1s)
        serial:
            side_car.change_space_gap(target: 1.2m, direction: left, reference: leader) with:
                lane(side_of: leader, side: left, at: start)
                position(10m, ahead_of: leader, at: start)
                speed(20mps)
            keep: side_car.keep_space_gap(reference: leader, direction: lateral, duration: 7s)
"""
REACHED, OVER = 3.0, 8.0  # s: in the world, and where a tool closes gaps as fast as it may
APART = 1.2 + 1.9  # m between the middles of cars that are 1.9 m wide
NEAR = 0.1  # m


def aside(track: Mapping[str, Sequence[Row]]) -> list[float]:
    """Return how far the side car is to the left of the leader, on a road along the x axis."""
    rows = zip(track["side_car"], track["leader"], strict=False)
    return [mine[2] - theirs[2] for mine, theirs in rows if REACHED < mine[0] < OVER]


def written(folder: Path, version: XmlVersion) -> tuple[Given, XmlScenario]:
    path = folder / "aside.osc"
    path.write_text(SOURCE, encoding="utf-8")
    given = Given(path, RunSettings(dt=0.05), xml=XmlOptions(version=version, allow_approx=True))
    (document,) = scenarios(given)
    return given, document


@pytest.mark.parametrize("version", XML_VERSIONS[1:])
def test_lateral_gaps(version: XmlVersion, tmp_path: Path) -> None:
    given, document = written(tmp_path, version)
    assert document.xml is not None, document.report.obstacles
    runs = (
        world(given.path, document.name, given.settings, PLAIN),
        played(document.xml, given.settings.dt),
    )
    for run in runs:
        assert all(abs(each - APART) < NEAR for each in aside(run.track))


def test_the_oldest_version_counts_across_the_car(tmp_path: Path) -> None:
    given, document = written(tmp_path, "1.0")
    assert document.xml is not None, document.report.obstacles
    played(document.xml, given.settings.dt)
    kept = [e for e in document.report.losses if "across the actor" in e.reason]
    assert [(e.construct, e.remedy.version) for e in kept] == [("action change_space_gap", "1.1")]
