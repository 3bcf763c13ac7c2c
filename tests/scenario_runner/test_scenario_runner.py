"""ScenarioRunner carries out the XML of its profile: events and ends are those of the world.

`OSC2TX_SCENARIO_RUNNER` names a checkout of ScenarioRunner, with its requirements in `.venv` there
and CARLA's package `agents` on `PYTHONPATH`; without it nothing is tested here. How to get them:
docs/how-to/legacy-xml.md. The server is the stand-in of the tests of CARLA.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import tomllib
from dataclasses import replace
from pathlib import Path

import pytest

from osc2tx.options import XmlOptions
from osc2tx_runtime import RunSettings
from osc2tx_runtime.domain.routes.map_search import SHIPPED
from tests.processes import HANGING
from tests.unit.backends.xosc.documents import PLAIN, compiled, documents
from tests.xosc.played import Played, compare, world

CHECKOUT = os.environ.get("OSC2TX_SCENARIO_RUNNER", "")
pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not CHECKOUT, reason="OSC2TX_SCENARIO_RUNNER does not name a checkout"),
]

HERE = Path(__file__).parent
SCENARIOS = HERE.parents[1] / "scenarios"
BOUNDS = tomllib.loads((HERE / "bounds.toml").read_text(encoding="utf-8"))
STEP = 0.05  # s
OTHER_MAP = "merge"  # none of the scenarios has it
READ_BY_IT = XmlOptions(version="1.0", profile="scenario_runner", allow_approx=True)


def play(document: str, folder: Path, port: int) -> Played:
    """Play a document in ScenarioRunner, which looks for the map beside it."""
    file = folder / "scenario.xosc"
    file.write_text(document, encoding="utf-8")
    python = Path(CHECKOUT, ".venv", "bin", "python")
    run = [str(python), str(HERE / "play.py"), CHECKOUT, str(port), str(file)]
    done = subprocess.run(run, capture_output=True, text=True, timeout=HANGING, cwd=folder)
    said = [json.loads(line) for line in done.stdout.splitlines() if line.startswith("[")]
    ends = [time for time, what, name in said if (what, name) == ("END", "")]
    assert ends, done.stdout + done.stderr
    starts = {name: time for time, what, name in said if what == "START"}
    return Played(ends[0], starts, {})


@pytest.mark.parametrize("name", BOUNDS)
def test_events_and_end_are_those_of_the_world(name: str, tmp_path: Path) -> None:
    from tests.carla.stand_in.process import StandInProcess

    (path,), bound = SCENARIOS.rglob(f"{name}.osc"), BOUNDS[name]
    (document,) = documents(compiled(path, PLAIN), READ_BY_IT)
    assert document.xml is not None, document.report.obstacles
    settings = RunSettings(dt=STEP, set=bound.get("values", {}))
    expected = replace(world(path, document.name, settings, PLAIN), track={})
    for each in SHIPPED.glob("*.xodr"):
        shutil.copy(each, tmp_path)
    # It does not load a map that the server has already, and then misses the name that it gives.
    with StandInProcess([SHIPPED], OTHER_MAP) as server:
        found = play(document.xml, tmp_path, server.port)
        assert server.ask("stand_in_unknown") == {}
    if "until" in bound:
        expected, found = before(bound["until"], expected), before(bound["until"], found)
    compare(document, expected, found, STEP, bound["seconds"])


def before(end: float, played: Played) -> Played:
    """Return what has begun before a time (s)."""
    starts = {name: time for name, time in played.starts.items() if time < end}
    return replace(played, end=end, starts=starts)


def test_bounds_have_reasons() -> None:
    assert all(bound["reason"] for bound in BOUNDS.values())
