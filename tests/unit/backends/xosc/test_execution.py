"""Documents, played, do what the embedded world does: same events at the same times, same motion.

A tool may see a completion one step late; so times may differ by one step for each event before,
and places by what that makes at the speeds in question.
"""

import json
from dataclasses import dataclass
from functools import cache
from itertools import combinations
from pathlib import Path

import pytest
from lxml import etree

from osc2tx.backends.xosc import emit
from osc2tx.backends.xosc.report import Grade
from osc2tx.driver import Compilation
from osc2tx.loading import scenarios_of_module
from osc2tx.options import CompileOptions, XmlOptions, XmlVersion
from osc2tx_runtime import RunSettings, run_scenario
from tests.unit.backends.xosc.checks import schema_errors, story_problems
from tests.unit.backends.xosc.player import Player

DT = 0.05
NEAR = 0.35  # m: 0.16 for the shape of a change of lane, and its motion in one or two steps
FLOW = Path(__file__).parent / "control_flow.osc"
SCENARIOS = Path(__file__).parents[4] / "scenarios"
NAMES = [
    line.removeprefix("scenario ").rstrip(":")
    for line in FLOW.read_text(encoding="utf-8").splitlines()
    if line.startswith("scenario ") and "pass_by" not in line  # that one is only invoked
]
OWN = ["cut_in", "follow_leader", "pedestrian_crossing"]
NOMINAL = {"cut_in": {"v_other": 87.5 / 3.6}}


@dataclass(frozen=True)
class World:
    """What the embedded world did: its end, starts of actions by source line, motion by actor."""

    end: float
    starts: dict[str, float]
    track: dict[str, list[tuple[float, float, float]]]


@cache
def compiled(path: Path) -> Compilation:
    return Compilation(path, path.name, CompileOptions())


@cache
def world(path: Path, name: str) -> World:
    module = compiled(path).module
    assert module is not None
    with scenarios_of_module(module) as scenarios:
        result = run_scenario(scenarios[name], RunSettings(dt=DT, set=NOMINAL.get(name, {})))
    assert result.status == "success"
    starts: dict[str, float] = {}
    track: dict[str, list[tuple[float, float, float]]] = {}
    end = 0.0
    for line in map(json.loads, result.trace_lines):
        if line["kind"] == "state":
            end = line["t"]
            track.setdefault(line["actor"], []).append((line["x"], line["y"], line["v"]))
        elif line["kind"] == "action" and line["status"] == "start":
            starts.setdefault(line["source"], line["t"])
    return World(end, starts, track)


def document(path: Path, name: str, version: XmlVersion) -> tuple[str, float]:
    """Return a document, and how far (m) from the world it may be at its times."""
    module = compiled(path).ir
    assert module is not None
    options = XmlOptions(version=version, allow_approx=True)
    (found,) = (x for x in emit(module, options, path.parent) if x.name == name)
    assert found.xml is not None, found.report.obstacles
    is_exact = all(entry.grade is Grade.EXACT for entry in found.report.entries)
    has_profiles = version >= "1.2"  # before, courses of speed have plainer shapes
    return found.xml, NEAR if is_exact and has_profiles else 2.0 * NEAR


def events_by_source(player: Player) -> dict[str, list[str]]:
    """Return the events that stand for invocations, by the line that their comment names."""
    found: dict[str, list[str]] = {}
    for event in player.root.iter("Event"):
        comment, name = event.getprevious(), event.get("name")
        if comment is not None and comment.tag is etree.Comment and not name.startswith("hold_"):
            source = ":".join(str(comment.text).strip().split(":")[:2])
            found.setdefault(source, []).append(name)
    return found


def compare(path: Path, name: str, version: XmlVersion, *, is_lazy: bool) -> None:
    xml, near = document(path, name, version)
    assert schema_errors(xml, version) == []
    assert story_problems(xml) == []
    expected, player = world(path, name), Player(xml, DT, is_lazy=is_lazy)
    hops = 1 + sum(1 for _ in player.root.iter("Event"))
    late = hops * DT + 1e-6
    assert player.play() == pytest.approx(expected.end, abs=late)
    times = []
    for source, names in events_by_source(player).items():
        if source in expected.starts:
            found = [player.starts[name] for name in names if name in player.starts]
            assert found, f"nothing of {source} ever started"
            times.append((expected.starts[source], min(found), source))
    for should, at, source in times:
        assert at == pytest.approx(should, abs=late), source
    for before, after in combinations(times, 2):  # what is clearly apart keeps its order
        if before[0] + 2 * late < after[0]:
            assert before[1] < after[1], (before, after)
    for actor, rows in expected.track.items():
        speeds = [v for _, _, v in rows]
        most = near + late * (max(speeds) - min(speeds))
        for (x, y, _), (t, found_x, found_y, _) in zip(rows, player.track[actor], strict=False):
            apart = ((x - found_x) ** 2 + (y - found_y) ** 2) ** 0.5
            assert apart < most, f"{actor} at {t}: {apart:.2f} m"


@pytest.mark.parametrize("name", NAMES)
def test_control_flow(name: str) -> None:
    compare(FLOW, name, "1.3", is_lazy=False)


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_control_flow_in_a_lazy_tool(name: str) -> None:
    compare(FLOW, name, "1.3", is_lazy=True)


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("version", ["1.0", "1.1"])
def test_control_flow_in_old_versions(name: str, version: XmlVersion) -> None:
    compare(FLOW, name, version, is_lazy=False)


@pytest.mark.slow
@pytest.mark.parametrize("name", OWN)
@pytest.mark.parametrize("is_lazy", [False, True], ids=["eager", "lazy"])
def test_own_scenarios(name: str, is_lazy: bool) -> None:
    compare(SCENARIOS / f"{name}.osc", name, "1.3", is_lazy=is_lazy)
