"""Conditions on measures that the XML does not have as such: the same truth by geometry."""

import math
from collections.abc import Iterator
from pathlib import Path

import pytest
from lxml import etree

from osc2tx.backends.xosc import XmlScenario
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions, XmlOptions, XmlVersion
from tests.unit.backends.xosc.checks import schema_errors

SOURCE = """\
import osc.standard.all

namespace null use std, stdtypes

scenario measured:
    road: map with:
        keep(it.map_file == "{map}.xodr")
    walker: person
    car: vehicle
    spot: position_3d with:
        keep(it.x == 150m)
        keep(it.y == -25m)
        keep(it.z == 0m)

    do parallel:
        walker.remain_stationary() with:
            position(at_point: spot, project_on_route: false, at: start)
            yaw({yaw}, at: start)
        serial:
            car.drive() with:
                lane(1, at: start)
                position(50m, at: start)
                speed({speed})
                until {condition}
            {then}
"""
WALKER = (150.0, -25.0)


def emitted(
    folder: Path,
    condition: str,
    version: XmlVersion = "1.3",
    *,
    road: str = "highway",
    yaw: str = "30deg",
    then: str = "car.drive(duration: 1s)",
    speed: str = "20mps",
) -> XmlScenario:
    path = folder / "a.osc"
    text = SOURCE.format(condition=condition, map=road, yaw=yaw, then=then, speed=speed)
    path.write_text(text, encoding="utf-8")
    xml = XmlOptions(version=version)
    compilation = Compilation(path, path.name, CompileOptions(target="xosc", xml=xml))
    assert compilation.ir is not None, compilation.diagnostics
    (found,) = compilation.xml
    if found.xml is not None:
        assert schema_errors(found.xml, version) == []
    return found


def condition_of(found: XmlScenario, tag: str) -> etree._Element:
    assert found.xml is not None, found.report.obstacles
    return next(etree.fromstring(found.xml.encode()).iter(tag))


def places() -> Iterator[tuple[float, float]]:
    """Yield places of a car all around the walker."""
    for distance in (0.5, 3.0, 8.0, 60.0):
        for step in range(48):
            angle = (step + 0.3) * math.tau / 48
            yield WALKER[0] + distance * math.cos(angle), WALKER[1] + distance * math.sin(angle)


@pytest.mark.parametrize("limit", [-4.0, 0.0, 5.0])
@pytest.mark.parametrize("direction", ["lateral", "longitudinal"])
def test_the_side_of_who_stands(direction: str, limit: float, tmp_path: Path) -> None:
    """The distance to a place far beyond the car is greater just if the car is farther that way."""
    asked = f"rise(walker.object_distance(car, direction: {direction}) > {limit}m)"
    condition = condition_of(emitted(tmp_path, asked), "DistanceCondition")
    assert condition.get("rule") == "greaterThan"
    assert condition.get("coordinateSystem") == "entity"
    assert condition.get("relativeDistanceType") == direction
    place = condition.find("Position/RelativeWorldPosition")
    assert place is not None and place.get("entityRef") == "car"
    dx, dy = float(place.get("dx", "0")), float(place.get("dy", "0"))
    heading = math.radians(30.0)  # the road of the map leads east
    axis = heading if direction == "longitudinal" else heading + math.pi / 2
    for x, y in places():
        there = (x + dx - WALKER[0], y + dy - WALKER[1])
        measured = abs(there[0] * math.cos(axis) + there[1] * math.sin(axis))
        told = measured > float(condition.get("value", "0"))
        along = (x - WALKER[0]) * math.cos(axis) + (y - WALKER[1]) * math.sin(axis)
        assert told is (along > limit), (x, y)


def test_who_turns_later_has_no_known_side(tmp_path: Path) -> None:
    asked = "rise(walker.object_distance(car, direction: lateral) > 0m)"
    found = emitted(tmp_path, asked, then="walker.walk(duration: 2s)")
    assert found.xml is None
    assert "have no sign" in found.report.obstacles[0].reason


@pytest.mark.parametrize("version", ["1.0", "1.1", "1.3"])
def test_coordinates_of_the_only_road(version: XmlVersion, tmp_path: Path) -> None:
    asked = "rise(car.get_s_coord() > 90m)"
    found = emitted(tmp_path, asked, version, road="curve", speed="10mps")  # none too fast for it
    condition = condition_of(found, "DistanceCondition")
    assert (condition.get("value"), condition.get("rule")) == ("90", "greaterThan")
    position = condition.find("Position/RoadPosition")
    assert position is not None and (position.get("s"), position.get("t")) == ("0", "0")


def test_where_there_are_several_roads_coordinates_say_too_little(tmp_path: Path) -> None:
    found = emitted(tmp_path, "rise(car.get_s_coord() > 90m)", road="urban_crossing")
    assert found.xml is None
    assert any("just one road" in entry.reason for entry in found.report.obstacles)


@pytest.mark.parametrize(
    ("measure", "tag", "direction"),
    [
        ("acceleration.translational.y > 1mpsps", "AccelerationCondition", "lateral"),
        ("acceleration.translational.norm() > 1mpsps", "AccelerationCondition", None),
        ("velocity.translational.z > 1mps", "SpeedCondition", "vertical"),
        ("velocity.translational.norm() > 1mps", "SpeedCondition", None),
        ("velocity.translational.x > 1mps", "SpeedCondition", "longitudinal"),
    ],
)
def test_parts_of_a_motion(measure: str, tag: str, direction: str | None, tmp_path: Path) -> None:
    asked = f"rise(car.{measure})"
    assert condition_of(emitted(tmp_path, asked), tag).get("direction") == direction
    older = emitted(tmp_path, asked, "1.1")
    assert (older.xml is not None) is (direction == "longitudinal")
