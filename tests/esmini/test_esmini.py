"""The XML, played in esmini, does what the embedded world does.

`OSC2TX_ESMINI` names a shared library of esmini (`libesminiLib.so`); without it nothing is tested
here. How to get one: docs/how-to/legacy-xml.md.
"""

import json
import math
import os
import subprocess
import sys
import tomllib
from dataclasses import dataclass, field, replace
from functools import cache
from itertools import combinations
from pathlib import Path

import pytest

from osc2tx.backends.xosc import XmlScenario, emit
from osc2tx.options import CompileOptions, XmlOptions
from osc2tx_runtime import RunSettings
from osc2tx_shared.map_files import SHIPPED
from tests.processes import HANGING
from tests.unit.backends.xosc.documents import PLAIN, compiled, graded_documents
from tests.xosc import esmini_laws
from tests.xosc.case_study import OPTIONS, SCENARIO, maps_in, run_settings, xml_options
from tests.xosc.parity import (
    Recording,
    compare,
    values_of,
    world,
)

LIBRARY = os.environ.get("OSC2TX_ESMINI", "")
pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not LIBRARY, reason="OSC2TX_ESMINI does not name a library of esmini"),
]

HERE = Path(__file__).parent
SCENARIOS = HERE.parents[1] / "scenarios"
BOUNDS = tomllib.loads((HERE / "bounds.toml").read_text(encoding="utf-8"))
NEAR = 0.2  # m, at steps of 0.01 s
FINE, COARSE = 0.01, 0.05
ALL_IT_CAN = XmlOptions(profile="esmini", allow_approx=True)


@dataclass(frozen=True)
class Given:
    """A scenario, and what it needs from outside."""

    path: Path
    settings: RunSettings = field(default_factory=lambda: RunSettings(dt=FINE), compare=False)
    options: CompileOptions = PLAIN
    xml: XmlOptions = ALL_IT_CAN
    maps: Path = SHIPPED


@cache
def documents(given: Given) -> dict[str, XmlScenario]:
    """Return the documents of a source by scenario."""
    module = compiled(given.path, given.options).ir
    assert module is not None
    found = emit(module, given.xml, given.path.parent)
    return {each.name: each for each in found if each.xml is not None}


def play(given: Given, document: str, dt: float, folder: Path) -> Recording:
    """Play a document in esmini."""
    file, result = folder / f"{dt}.xosc", folder / f"{dt}.json"
    file.write_text(document, encoding="utf-8")
    told = [LIBRARY, str(file), str(given.maps), str(dt), "300", str(result)]
    script = [sys.executable, str(HERE / "headless.py"), *told]
    subprocess.run(script, check=True, capture_output=True, timeout=HANGING)
    data = json.loads(result.read_text(encoding="utf-8"))
    assert "error" not in data, data["error"]
    starts: dict[str, float] = {}
    for time, name in data["starts"]:
        starts.setdefault(name, time)
    end = math.inf if data["end"] is None else data["end"]
    return Recording(end, starts, data["rows"])


def both(
    given: Given, name: str, dt: float, folder: Path
) -> tuple[XmlScenario, Recording, Recording]:
    """Return the document, what the world does, and what esmini does."""
    document = documents(given)[name]
    assert document.xml is not None
    settings = replace(given.settings, dt=dt)
    expected = world(given.path, name, settings, given.options, values_of(document))
    return document, expected, play(given, document.xml, dt, folder)


OWN = ["cut_in", "cut_in_and_evade", "follow_leader", "pedestrian_crossing"]
CAPABILITIES = [
    path
    for path in sorted((SCENARIOS / "capabilities").glob("*.osc"))
    if path.stem != "C34_conflict_reported"  # which the world refuses to run
]


def case_study(maps: Path) -> Given:
    """Return the scenario of the case study with what its user supplies."""
    settings, xml = run_settings(maps, FINE), xml_options(maps, "esmini")
    return Given(SCENARIO, settings, OPTIONS, xml, maps)


@pytest.mark.parametrize("name", OWN)
def test_own_scenarios(name: str, tmp_path: Path) -> None:
    given = Given(SCENARIOS / f"{name}.osc", xml=XmlOptions(profile="esmini"))
    fine = compare(*both(given, name, FINE, tmp_path), FINE)
    coarse = compare(*both(given, name, COARSE, tmp_path), COARSE)
    assert fine.place < NEAR
    # esmini moves for a whole step at the speed of its end, so it nears the world as steps shrink.
    assert coarse.place < max(NEAR, 2.0 * COARSE / FINE * fine.place)


def test_case_study(test_data: Path, tmp_path: Path) -> None:
    given = case_study(maps_in(test_data))
    # Half a kilometre and three minutes, with courses that stop at others' places
    assert compare(*both(given, "hello_world", FINE, tmp_path), FINE).place < 0.25


@pytest.mark.parametrize(
    "text",
    [
        esmini_laws.BESIDE_IN_A_BEND,
        esmini_laws.AFTER_AN_EVEN_CHANGE,
        esmini_laws.PUT_AT_THE_START,
        esmini_laws.WAITS_FOR_THE_SAME_INSTANT,
    ],
    ids=["beside", "after", "put", "waits"],
)
def test_laws_of_its_own(text: str, tmp_path: Path) -> None:
    path = tmp_path / "it.osc"
    path.write_text(text, encoding="utf-8")
    given = Given(path, xml=XmlOptions(profile="esmini"))
    (name,) = documents(given)
    assert compare(*both(given, name, FINE, tmp_path), FINE).place < 0.1


@pytest.mark.parametrize("action", ["keep_space_gap", "keep_time_gap"])
def test_gaps_that_it_fits_are_as_far_off_as_played(action: str, tmp_path: Path) -> None:
    path = tmp_path / "it.osc"
    path.write_text(esmini_laws.FOLLOWS_IN_A_BEND.format(action=action), encoding="utf-8")
    given = Given(path)
    (graded,) = graded_documents(compiled(path), given.xml)
    (document,) = documents(given).values()
    assert document.xml == graded.xml and graded.report.measured is not None
    found = compare(*both(given, document.name, FINE, tmp_path), FINE)
    assert found.place == pytest.approx(graded.report.measured.place, abs=0.1)


def test_a_speed_does_not_include_lateral_motion(tmp_path: Path) -> None:
    path = tmp_path / "it.osc"
    path.write_text(esmini_laws.PULLS_OUT_FROM_STANDSTILL, encoding="utf-8")
    difference = compare(*both(Given(path), "pulls_out", FINE, tmp_path), FINE)
    assert difference.place < 0.5  # of the lateral motion itself; the other one starts on time
    assert difference.time <= FINE


def _stem(path: Path) -> str:
    return path.stem


@pytest.mark.parametrize("path", CAPABILITIES, ids=_stem)
def test_capabilities(path: Path, tmp_path: Path) -> None:
    given, bound = Given(path), BOUNDS.get(path.stem, {})
    what, near = bound.get("compare", "places"), bound.get("metres", NEAR)
    patience = bound.get("seconds", 0.0)
    if not documents(given):
        pytest.skip("it has no XML")
    for name in documents(given):
        document, expected, found = both(given, name, FINE, tmp_path)
        if what == "places":
            difference = compare(document, expected, found, FINE, patience)
            assert not difference.beyond(near), difference
        elif what == "held":
            assert distances(found) == pytest.approx(distances(expected), abs=near)


def distances(played: Recording) -> dict[tuple[str, str], float]:
    """Return the distances (m) between the actors at the end."""
    last = {actor: rows[-1] for actor, rows in played.track.items()}
    return {
        (one, other): math.dist(last[one][1:3], last[other][1:3])
        for one, other in combinations(sorted(last), 2)
    }


def test_bounds_are_of_scenarios() -> None:
    assert set(BOUNDS) <= set(map(_stem, CAPABILITIES))
    assert all(bound["reason"] for bound in BOUNDS.values())
