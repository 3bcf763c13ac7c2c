"""What is graded exact does what the embedded world does, at steps of 10 ms.

These are all scenarios of the repository and all cases of the golden documents. What is
approximated is not compared, for its report says how far off it is, but it has to play.
"""

from dataclasses import replace
from pathlib import Path

import pytest

from osc2tx.config import GivenOptions
from osc2tx.options import CompileOptions, XmlOptions, XmlProfile
from osc2tx_runtime import RunSettings
from tests.golden.test_xosc import CASES
from tests.golden.test_xosc import given as stated
from tests.xosc.parity import FINE, Given, check, is_exact, played, scenarios

SCENARIOS = Path(__file__).parents[2] / "scenarios"
OWN = [path for path in sorted(SCENARIOS.rglob("*.osc")) if path.stem != "hello_world"]
ALL = [*OWN, *CASES]
QUICK = {"cut_in", "pedestrian_crossing", "follow_leader", "C19_change_speed", "drive_to_a_place"}

# Exact, and not compared with a run of the world to its end.
WITHOUT_RUN = {
    "C34_conflict_reported": "the world refuses to run it",
    "command_of_the_tool": "its actions come from packages of users",
    "own_actions": "its actions come from packages of users",
    "duration_that_holds": "the world fails where nothing fills a duration, the XML holds it",
    "emitted_twice": "it waits for ever for an event that it missed, here and there",
    "endless": "it is over when the road is in the world, and after 300 s in XML",
    "event_from_outside_unknown": "nobody sends the event that it waits for",
    "outside_event_later": "nobody sends the event that it waits for",
    "hostile_names": "nobody sends the event that it waits for",
}


def name(path: Path) -> str:
    return path.name if path.is_dir() else path.stem


def given(path: Path) -> Given:
    """Return a source with what it is told from outside."""
    if path.is_dir():
        text = (path / "input.osc").read_text(encoding="utf-8")
        options = GivenOptions(target="xosc").over(stated(text)).complete()
        xml = replace(options.xml, allow_approx=True)
        signals = dict(signal.split("@") for signal in xml.signals)
        settings = RunSettings(
            dt=FINE, signal={event: float(at.rstrip("s")) for event, at in signals.items()}
        )
        return Given(path / "input.osc", settings, replace(options, xml=XmlOptions()), xml)
    profile: XmlProfile = "esmini" if path.stem == "cut_in_and_evade" else "generic"
    return Given(path, xml=XmlOptions(profile=profile, allow_approx=True))


def case_study(maps: Path) -> Given:
    """Return the scenario of the case study with what its user supplies."""
    settings = RunSettings(
        dt=FINE,
        signal={"go_signal": 1.0},
        spawn={"hero": ("16", -3, 5.0)},
        destination={"hero": "obstacle", "npc": "obstacle"},
        map_path=(maps,),
    )
    xml = XmlOptions(
        profile="esmini",
        signals=("go_signal@1s",),
        spawns=("hero=16,-3,5",),
        map_path=(str(maps),),
    )
    path = SCENARIOS / "hello_world.osc"
    return Given(path, settings, CompileOptions(dialect="carla"), xml, (maps,))


def slow_but(path: Path) -> object:
    return path if name(path) in QUICK else pytest.param(path, marks=pytest.mark.slow)


@pytest.mark.parametrize("path", list(map(slow_but, ALL)), ids=name)
def test_exact_is_like_the_world(path: Path) -> None:
    source = given(path)
    for document in scenarios(source):
        if document.xml is None:
            assert document.report.obstacles
        elif is_exact(document) and name(path) not in WITHOUT_RUN:
            check(source, document)
        else:
            played(document.xml, 0.1, source.maps, most=10.0)


@pytest.mark.slow
def test_case_study(test_data: Path) -> None:
    source = case_study(test_data / "maps" / "carla-2020")
    (document,) = scenarios(source)
    assert is_exact(document), document.report.obstacles
    check(source, document)


def test_exceptions_are_of_scenarios() -> None:
    assert set(WITHOUT_RUN) <= set(map(name, ALL))
    assert set(map(name, ALL)) >= QUICK
