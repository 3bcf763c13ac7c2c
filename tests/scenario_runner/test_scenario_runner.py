"""ScenarioRunner carries out the XML of its profile: events and ends are those of the world.

`OSC2TX_SCENARIO_RUNNER` names a checkout of ScenarioRunner, with its requirements in `.venv` there
and CARLA's package `agents` on `PYTHONPATH`; without it nothing is tested here. How to get them:
docs/how-to/legacy-xml.md. The server is the stand-in of the tests of CARLA.
"""

from __future__ import annotations

import json
import math
import os
import shutil
import subprocess
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from osc2tx.grading.comparison import Recording, Row
from osc2tx.options import XmlOptions
from osc2tx_runtime import RunSettings
from osc2tx_shared.map_files import SHIPPED
from tests.processes import HANGING
from tests.unit.backends.xosc.documents import compiled, documents
from tests.xosc.case_study import OPTIONS, SCENARIO, maps_in, run_settings, xml_options
from tests.xosc.parity import Given, compare, world

CHECKOUT = os.environ.get("OSC2TX_SCENARIO_RUNNER", "")
pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not CHECKOUT, reason="OSC2TX_SCENARIO_RUNNER does not name a checkout"),
]

HERE = Path(__file__).parent
SCENARIOS = HERE.parents[1] / "scenarios"
BOUNDS = tomllib.loads((HERE / "bounds.toml").read_text(encoding="utf-8"))
STEP = 0.05  # s
SOON = 0.1  # s
STEPS_BEFORE = 1  # ticks for which actors have been on their way when a run begins there
MAPS = ("merge", "crossing")  # It does not load a map that is there, and misses its name then.
READ_BY_IT = XmlOptions(version="1.0", profile="scenario_runner", allow_approx=True)


def play(document: str, folder: Path, port: int) -> Recording:
    """Play a document in ScenarioRunner, which looks for the map beside it."""
    file = folder / "scenario.xosc"
    file.write_text(document, encoding="utf-8")
    python = Path(CHECKOUT, ".venv", "bin", "python")
    run = [str(python), str(HERE / "play.py"), CHECKOUT, str(port), str(file)]
    done = subprocess.run(run, capture_output=True, text=True, timeout=HANGING, cwd=folder)
    said = [json.loads(line) for line in done.stdout.splitlines() if line.startswith("[")]
    ends = [time for time, what, name, *_ in said if (what, name) == ("END", "")]
    assert ends, done.stdout[-5000:] + done.stderr
    starts = {name: time for time, what, name, *_ in said if what == "START"}
    track: dict[str, list[Row]] = {}
    for time, what, name, *place in said:
        if what == "AT":
            track.setdefault(name, []).append((time, *place, 0.0))
    return Recording(ends[0], starts, track)


def check(given: Given, folder: Path, bound: Mapping[str, Any]) -> None:
    """Compare events and end in ScenarioRunner with those of the world, within a bound."""
    from tests.carla.stand_in.process import StandInProcess

    *_, document = documents(compiled(given.path, given.options), given.xml)
    assert document.xml is not None, document.report.obstacles
    expected = world(given.path, document.name, given.settings, given.options)
    for each in (path for maps in given.maps for path in maps.glob("*.xodr")):
        shutil.copy(each, folder)
    other = next(name for name in MAPS if name not in document.xml)
    with StandInProcess(list(given.maps), other) as server:
        found = play(document.xml, folder, server.port)
        assert server.ask("stand_in_unknown") == {}
    if "until" in bound:
        expected, found = before(bound["until"], expected), before(bound["until"], found)
    compare(document, replace(expected, track={}), found, STEP, bound.get("seconds", SOON))
    assert farthest(expected, found) < bound.get("metres", math.inf)


@pytest.mark.parametrize("name", BOUNDS)
def test_events_and_end_are_those_of_the_world(name: str, tmp_path: Path) -> None:
    (path,), bound = SCENARIOS.rglob(f"{name}.osc"), BOUNDS[name]
    settings = RunSettings(dt=STEP, set=bound.get("values", {}))
    check(Given(path, settings, xml=READ_BY_IT), tmp_path, bound)


def test_case_study(test_data: Path, tmp_path: Path) -> None:
    maps = maps_in(test_data)
    xml = xml_options(maps, "scenario_runner", "1.0", allow_approx=True)
    given = Given(SCENARIO, run_settings(maps, STEP), OPTIONS, xml, (SHIPPED, maps))
    # Trucks are as fast as they should be at once there, so it overtakes long before its time.
    check(given, tmp_path, {"until": 3.0, "metres": 9.0})


def farthest(expected: Recording, found: Recording) -> float:
    """Return how far (m) an actor is from its place in the world at most."""
    pairs = (
        pair for actor, rows in expected.track.items() for pair in _pairs(rows, found.track[actor])
    )
    return max((math.dist(there[1:3], here[1:3]) for there, here in pairs), default=0.0)


def _pairs(expected: Sequence[Row], found: Sequence[Row]) -> Iterator[tuple[Row, Row]]:
    by_step = {round(row[0] / STEP): row for row in expected}
    for row in found:
        step = round(row[0] / STEP) - STEPS_BEFORE
        if step in by_step:
            yield by_step[step], row


def before(end: float, played: Recording) -> Recording:
    """Return what has begun before a time (s)."""
    starts = {name: time for name, time in played.starts.items() if time < end}
    track = {actor: [row for row in rows if row[0] < end] for actor, rows in played.track.items()}
    return Recording(end, starts, track)


def test_bounds_have_reasons() -> None:
    for name, bound in BOUNDS.items():
        is_close = bound.get("seconds", SOON) <= SOON and bound.get("metres", math.inf) < 0.5
        assert is_close or bound["reason"], name
