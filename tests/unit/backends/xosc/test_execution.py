"""Documents, played, do what the embedded world does: same events, same times, same motion."""

from functools import cache
from pathlib import Path

import pytest

from osc2tx.backends.xosc import XmlScenario
from osc2tx.backends.xosc.report import Grade
from osc2tx.options import XmlOptions, XmlVersion
from osc2tx_runtime import RunSettings
from tests.unit.backends.xosc.checks import schema_errors, story_problems
from tests.unit.backends.xosc.documents import PLAIN, compiled, documents
from tests.unit.backends.xosc.played import (
    Played,
    compare,
    hops,
    spread,
    with_values_of,
    world,
)
from tests.unit.backends.xosc.player import Player

DT = 0.05
NEAR = 0.4  # m: 0.16 for the shape of a change of lane, 0.2 for the way back from half of one
FLOW = Path(__file__).parent / "control_flow.osc"
SCENARIOS = Path(__file__).parents[4] / "scenarios"
NAMES = [
    line.removeprefix("scenario ").rstrip(":")
    for line in FLOW.read_text(encoding="utf-8").splitlines()
    if line.startswith("scenario ") and "pass_by" not in line  # that one is only invoked
]
OWN = ["cut_in", "follow_leader", "pedestrian_crossing"]


@cache
def document(path: Path, name: str, version: XmlVersion) -> tuple[XmlScenario, float]:
    """Return a document, and how far (m) from the world it may be at its times."""
    options = XmlOptions(version=version, allow_approx=True)
    (found,) = (x for x in documents(compiled(path), options) if x.name == name)
    assert found.xml is not None, found.report.obstacles
    is_exact = all(entry.grade is Grade.EXACT for entry in found.report.entries)
    has_profiles = version >= "1.2"  # before, courses of speed have plainer shapes
    return found, NEAR if is_exact and has_profiles else 4.0 * NEAR


@cache
def expected(path: Path, name: str) -> Played:
    xml = document(path, name, "1.3")[0].xml
    assert xml is not None
    return world(path, name, with_values_of(xml, RunSettings(dt=DT)), PLAIN)


def check(path: Path, name: str, version: XmlVersion, *, is_lazy: bool) -> None:
    made, near = document(path, name, version)
    xml = made.xml
    assert xml is not None
    assert schema_errors(xml, version) == []
    assert story_problems(xml) == []
    should, player = expected(path, name), Player(xml, DT, is_lazy=is_lazy)
    found = Played(player.play(), player.starts, player.track)
    late = (1 + max(hops(player.root).values())) * DT
    for actor, (metres, t) in compare(made, should, found, DT).apart.items():
        assert metres < near + late * spread(should, actor), f"{actor} at {t}"


@pytest.mark.parametrize("name", NAMES)
def test_control_flow(name: str) -> None:
    check(FLOW, name, "1.3", is_lazy=False)


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_control_flow_in_a_lazy_tool(name: str) -> None:
    check(FLOW, name, "1.3", is_lazy=True)


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("version", ["1.0", "1.1"])
def test_control_flow_in_old_versions(name: str, version: XmlVersion) -> None:
    check(FLOW, name, version, is_lazy=False)


@pytest.mark.slow
@pytest.mark.parametrize("name", OWN)
@pytest.mark.parametrize("is_lazy", [False, True], ids=["eager", "lazy"])
def test_own_scenarios(name: str, is_lazy: bool) -> None:
    check(SCENARIOS / f"{name}.osc", name, "1.3", is_lazy=is_lazy)
