"""C17 and C29: what a map has besides its lanes, measured against its file."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from lxml import etree

import osc2tx_runtime
from tests.capabilities.kit import ROUNDED, Perform, Performance, next_step

MAPS = Path(osc2tx_runtime.__file__).parent / "maps"
CAR_FRONT = 3.679  # m from the rear axle to the front of a car
SEMI_MAJOR, FLATTENING = 6_378_137.0, 1.0 / 298.257_223_563


def written(name: str) -> etree._Element:
    """The file of a map."""
    return etree.parse(MAPS / f"{name}.xodr").getroot()


def number(element: etree._Element | None, name: str) -> float:
    assert element is not None
    return float(element.get(name, ""))


def values(run: Performance) -> dict[str, object]:
    return {line["name"]: line["value"] for line in run.of_kind("variable")}


def test_c29_people_cross_a_street(perform: Perform) -> None:
    run = perform("C29_crossing")
    assert run.status == "success"
    root, found = written("crossing"), values(run)
    zebra, street = root.find(".//object"), root.find("road")
    s, length = number(zebra, "s"), number(street, "length")
    # from the middle of one sidewalk to that of the other: two lanes of 3.5 m, two halves of 2.5 m
    across = sum(number(w, "a") for w in root.findall(".//lane[@type='driving']/width")) + 2.5
    assert found["zebra_length"] == pytest.approx(across)
    assert found["width"] == pytest.approx(number(zebra, "length"))  # which lies along the street
    # Against s a sidewalk is measured from the other end of the street.
    assert (found["starts_at"], found["ends_at"]) == pytest.approx((s, length - s))
    assert found["is_for_walkers"] is True
    # 20 m along the near sidewalk, then over the zebra crossing, then 10 m along the far one
    on_zebra = run.event("on_zebra")
    walker = run.at("walker", on_zebra)
    # Each corner takes up to two steps more.
    assert on_zebra == pytest.approx((20.0 + 0.5 * across) / 1.5, abs=0.11)
    assert walker["x"] == pytest.approx(s, abs=1e-3)
    assert found["half_way"] == pytest.approx(0.5 * across + walker["y"], abs=1e-3)
    way = 20.0 + across + 10.0
    done = run.span("walker walk").end
    assert done == pytest.approx(way / 1.5, abs=0.21)
    goal = run.at("walker", done)
    assert (goal["x"], goal["y"]) == pytest.approx((s - 10.0, 0.5 * across), abs=0.1)
    # The shortcut leaves its sidewalk at 60 degrees.
    assert found["shortcut_length"] == pytest.approx(across / math.sin(math.radians(60.0)))
    ahead = across / math.tan(math.radians(60.0))
    assert found["shortcut_ends_at"] == pytest.approx(length - (100.0 + ahead))
    begin = run.at("other", 0.0)
    assert (begin["x"], begin["y"]) == pytest.approx((100.0, -0.5 * across), abs=ROUNDED)
    for line in run.states("other")[1:100]:
        assert line["h"] == pytest.approx(math.radians(60.0), abs=ROUNDED)


def test_c29_what_the_map_says_of_its_roads(perform: Perform) -> None:
    run = perform("C29_route_values")
    assert run.status == "success"
    root, found = written("urban_crossing"), values(run)
    arm = root.find("road[@name='east']")
    outside = [road for road in root.findall("road") if road.get("junction") == "-1"]
    driving = root.findall("road[@name='east']//lane[@type='driving']")
    assert found["arm_length"] == found["end_of_arm"] == number(arm, "length")
    assert found["lanes_of_arm"] == len(driving)
    assert found["lanes_in"] == sum(int(lane.get("id", "")) < 0 for lane in driving)
    assert found["lane_width"] == number(driving[0].find("width"), "a")
    assert found["is_split"] is found["is_normal"] is found["is_this_map"] is True
    assert found["arms"] == found["roads"] == len(outside)
    assert found["junctions"] == len(root.findall("junction"))
    assert found["groups"] == len(root.findall("controller"))
    assert found["elements"] == 2
    # Both arms, and the quarter of a circle in between, 20 m and half a lane around the corner
    way = 2.0 * number(arm, "length") + 0.5 * math.pi * (20.0 + 1.75)
    assert found["way_length"] == pytest.approx(way, rel=1e-4)
    away = next(line["t"] for line in run.of_kind("variable"))
    begin, there = run.at("ego", 0.0), run.at("ego", away)
    assert begin["s"] == pytest.approx(20.0, abs=ROUNDED)
    assert found["covered"] == pytest.approx(there["s"], abs=1e-3)
    assert away == next_step((50.0 - 20.0) / 10.0)
    drive = run.span("ego drive")
    assert drive.length == pytest.approx((way - 40.0) / 10.0, abs=0.1)
    end = run.at("ego", drive.end)
    assert (end["road"], end["s"]) == ("4", pytest.approx(20.0, abs=0.6))


def test_c29_roads_of_a_merge(perform: Perform) -> None:
    run = perform("C29_joined_roads")
    assert run.status == "success"
    root, found = written("merge"), values(run)
    motorway = root.find("road[@name='after']")
    assert motorway is not None
    assert found["motorway_length"] == found["way_length"] == number(motorway, "length")
    begins = [number(section, "s") for section in motorway.findall("lanes/laneSection")]
    # The lane for joining becomes narrower, so that its middle is longer than its section of 100 m.
    assert begins[2] - begins[1] < found["lane_length"] < begins[2] - begins[1] + 0.1
    first = motorway.find("lanes/laneSection/right")
    types = [] if first is None else [lane.get("type") for lane in first]
    assert found["lanes_joined"] == len([each for each in types if each in ("driving", "entry")])
    begin = run.at("ego", 0.0)
    assert (begin["road"], begin["lane"], begin["s"]) == ("3", -1, 20.0)


def test_c29_lanes_abreast(perform: Perform) -> None:
    run = perform("C29_lanes_abreast")
    assert run.status == "success"
    ego, other, oncoming = (run.at(actor, 0.0) for actor in ("ego", "other", "oncoming"))
    assert other["lane"] - ego["lane"] == 2 and ego["lane"] * oncoming["lane"] < 0
    assert ego["x"] == other["x"] == 200.0
    # Against s a lane begins at the end of the road of 2 km.
    assert oncoming["s"] == pytest.approx(2000.0 - 200.0, abs=ROUNDED)


def test_c29_degrees_become_metres(perform: Perform) -> None:
    run = perform("C29_geodetic_points")
    assert run.status == "success"
    # Where equator and central meridian meet a degree is as long as the ellipsoid is curved there.
    degree = math.radians(1.0)
    east = SEMI_MAJOR * degree
    north = SEMI_MAJOR * (1.0 - FLATTENING) ** 2 * degree
    begin = run.at("ego", 0.0)
    assert begin["x"] == pytest.approx(0.001 * east, abs=1e-5)
    assert begin["y"] == pytest.approx(-0.0000475 * north, abs=1e-5)
    drive = run.span("ego drive")
    assert drive.end == next_step(0.002 * east / 20.0)


def test_c17_single_bulbs_and_a_line_of_its_own(perform: Perform) -> None:
    run = perform("C17_light_bulbs")
    assert run.status == "success"
    root, found = written("urban_crossing"), values(run)
    signal = root.find(".//signal[@id='101']")
    arm = root.find("road[@name='east']")
    geometry = None if arm is None else arm.find("planView/geometry")
    # The arm runs against x.
    assert found["at"] == pytest.approx(number(geometry, "x") - number(signal, "s"))
    assert found["above"] == pytest.approx(number(signal, "zOffset"))
    assert found["height"] == number(signal, "height")
    assert found["width"] == number(signal, "width")
    lights = root.findall("controller[@id='1']/control")
    assert found["bulbs"] == 3 * len(lights)
    assert found["phases"] == 2
    assert found["section"] == number(arm, "length")
    assert (found["line_at"], found["last_lane"], found["is_drawn"]) == (100.0, 2, True)
    # Red for 12 s.
    assert run.event("red_shines") == 0.0
    assert run.event("green_shines") == 12.0
    waiting = run.at("ego", 12.0)
    assert waiting["v"] == 0.0
    assert waiting["s"] + CAR_FRONT == pytest.approx(100.0 - 1.0, abs=2e-3)
    assert run.last("ego")["s"] > 110.0
