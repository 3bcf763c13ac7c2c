"""Paths: where they begin, and what is known where they end."""

import math
from pathlib import Path

import pytest

from osc2tx.options import XmlOptions
from osc2tx.xosc import elements as xml
from osc2tx.xosc import read
from tests.xosc.case_texts import source
from tests.xosc.parity import Given, difference, scenarios

WALKS_ON = """\
walker: person
begin: pose_3d with:
    keep(it.position.x == 100m)
    keep(it.position.y == -5m)
    keep(it.position.z == 0m)
corner: pose_3d with:
    keep(it.position.x == 104m)
    keep(it.position.y == -4m)
    keep(it.position.z == 0m)
across: pose_3d with:
    keep(it.position.x == 104m)
    keep(it.position.y == 4m)
    keep(it.position.z == 0m)
do serial:
    walker.walk(duration: 1s) with:
        position(at_point: begin.position, project_on_route: false, at: start)
        yaw(0deg, at: start)
        speed(1.4mps)
    walker.replay_path(
        absolute: road.create_path(points: [begin, corner, across], interpolation: straight_line)
    ) with:
        speed(1.4mps)
    walker.walk(duration: 2s)
"""
GOES_ON = WALKS_ON.replace("walker.walk(duration: 2s)", "wait elapsed(3s)")
LATER_ON_ITS_WAY = """\
ego: vehicle
here: pose_3d with:
    keep(it.position.x == 0m)
    keep(it.position.y == 0m)
ahead: pose_3d with:
    keep(it.position.x == 60m)
    keep(it.position.y == 0m)
way: relative_path_pose_3d with:
    keep(it.points == [here, ahead])
    keep(it.interpolation == straight_line)
do serial:
    ego.drive(duration: 1s) with:
        lane(1, at: start)
        position(50m, at: start)
        speed(10mps)
    ego.follow_path(
        relative: way, reference: ego, transform: object_relative, start_offset: 5m
    )
    ego.drive(duration: 1s)
"""


@pytest.mark.parametrize("text", [WALKS_ON, LATER_ON_ITS_WAY], ids=["walks_on", "later"])
def test_ways_begin_and_end_where_the_actor_is(text: str, tmp_path: Path) -> None:
    path = tmp_path / "it.osc"
    path.write_text(source([("it", text)], "crossing"), encoding="utf-8")
    given = Given(path, xml=XmlOptions())
    (document,) = scenarios(given)
    assert document.xml is not None and not document.report.losses
    assert not difference(given, document).beyond(0.05)


def test_behind_a_way_a_walker_goes_on_by_a_way(tmp_path: Path) -> None:
    """Tools would send it along the lane."""
    path = tmp_path / "it.osc"
    path.write_text(source([("it", GOES_ON)], "crossing"), encoding="utf-8")
    given = Given(path, xml=XmlOptions())
    (found,) = scenarios(given)
    assert found.xml is not None and not found.report.losses
    onward = read(found.xml).below(xml.Event)
    (way,) = (each for each in onward if each.name == "walker_replay_path_onward")
    begin, *_ = way.below(xml.WorldPosition)
    assert (begin.x, begin.y) == (104.0, 4.0) and begin.h == pytest.approx(0.5 * math.pi)
