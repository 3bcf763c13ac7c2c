"""Traffic lights, headlights and weather in the report."""

import json
import re

from osc2tx_runtime.report.page import render_report
from osc2tx_runtime.report.trace_reader import read_run
from tests.runtime.report.conftest import FakeMap, Post, TraceMaker, highway


def maker() -> TraceMaker:
    made = TraceMaker("crossing")
    made.car("ego", lambda t: (10 * t, -5.25, 0.0, 10.0, 0.0))
    made.note(0.0, "signal", signal="101", state="stop", bulbs=["is_on", "is_off", "is_off"])
    made.note(2.0, "signal", signal="101", state="go", bulbs=["is_off", "is_off", "is_on"])
    made.note(0.0, "lights", actor="ego", mode="auto", lit="off")
    made.note(1.0, "lights", actor="ego", mode="auto", lit="low_beam")
    made.note(0.0, "environment", temperature=270.15, sun_elevation=0.5)
    made.note(1.0, "environment", sun_elevation=-0.1, rain_intensity=2e-6)
    return made


def lit_highway() -> FakeMap:
    road_map = highway()
    road_map.posts = (Post("101", "16", 50.0, -12.0), Post("999", "16", 90.0, -12.0))
    return road_map


def surroundings(road_map: FakeMap | None) -> dict[str, object]:
    page = render_report(maker().text(80), road_map)
    data = re.search(r'<script type="application/json" id="run-data">(.*?)</script>', page)
    assert data is not None
    found: dict[str, object] = json.loads(data[1])["runs"][0]["surroundings"]
    return found


def test_lights_that_change_stand_at_their_places() -> None:
    road_map = lit_highway()
    place = road_map.road_pose("16", 50.0, -12.0)
    assert surroundings(road_map)["signals"] == [
        {
            "id": "101",
            "x": round(place.x, 2),
            "y": round(place.y, 2),
            "changes": [
                {"t": 0, "state": "stop", "lamps": ["is_on", "is_off", "is_off"]},
                {"t": 2, "state": "go", "lamps": ["is_off", "is_off", "is_on"]},
            ],
        }
    ]


def test_without_a_map_lights_have_no_place() -> None:
    assert surroundings(None)["signals"] == []


def test_headlights_and_weather_by_time() -> None:
    found = surroundings(None)
    assert found["lights"] == {"ego": [{"t": 0, "lit": "off"}, {"t": 1, "lit": "low_beam"}]}
    assert found["weather"] == [
        {"t": 0, "values": {"temperature": 270.15, "sun_elevation": 0.5}},
        {"t": 1, "values": {"sun_elevation": -0.1, "rain_intensity": 2e-06}},
    ]


def test_marks_of_the_weather_have_units_of_people() -> None:
    marks = [mark["name"] for mark in read_run(maker().text(80)).as_json()["marks"]]  # type: ignore[union-attr, attr-defined]
    assert "-3 °C, sun elevation 28.65°" in marks
    assert "sun elevation -5.73°, rain 7.2 mm/h" in marks
    strange = json.dumps({"t": 0.0, "kind": "environment", "dust": 0.5, "temperature": "?"})
    (mark,) = read_run([strange]).as_json()["marks"]  # type: ignore[misc, attr-defined]
    assert mark["name"] == "dust 0.5, temperature ?"
