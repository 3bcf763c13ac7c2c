"""What is graded exact does what the embedded world does, at steps of 10 ms.

These are all scenarios of the repository and all cases of the golden documents, in all versions and
for all tools. What is approximated is not farther off than its report says.
"""

from dataclasses import replace
from pathlib import Path

import pytest

from osc2tx.backends.xosc import XmlScenario
from osc2tx.config import GivenOptions
from osc2tx.options import XmlOptions, XmlProfile, XmlVersion
from osc2tx_runtime import RunSettings
from tests.golden.test_xosc import CASES
from tests.golden.test_xosc import given as stated
from tests.unit.backends.xosc.checks import (
    checker_issues,
    schema_errors,
    story_problems,
    untraced,
)
from tests.unit.backends.xosc.deprecations import deprecated
from tests.xosc.case_study import OPTIONS, SCENARIO, maps_in, run_settings, xml_options
from tests.xosc.parity import (
    FINE,
    WRITTEN,
    Given,
    check,
    is_exact,
    is_measured,
    played,
    reading_for,
    scenarios,
)

SCENARIOS = Path(__file__).parents[2] / "scenarios"
OWN = [path for path in sorted(SCENARIOS.rglob("*.osc")) if path.stem != "hello_world"]
ALL = [*OWN, *CASES]
QUICK = {"cut_in", "pedestrian_crossing", "follow_leader", "C19_change_speed", "drive_to_a_place"}


# Exact, and not compared with a run of the world to its end.
WITHOUT_RUN = {
    "command_of_the_tool": "its actions come from packages of users",
    "own_actions": "its actions come from packages of users",
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
    settings, xml = run_settings(maps, FINE), xml_options(maps, "esmini")
    return Given(SCENARIO, settings, OPTIONS, xml, (maps,))


def check_document(path: Path, source: Given, document: XmlScenario) -> None:
    """Compare a document with the world as far as metres say how far off it is."""
    if document.xml is None:
        assert document.report.obstacles
    elif is_measured(document) and name(path) not in WITHOUT_RUN:
        check(source, document)
    else:
        played(document.xml, 0.1, source.maps, reading=reading_for(source.xml), most=10.0)


@pytest.mark.parametrize("path", [path for path in ALL if name(path) in QUICK], ids=name)
def test_documents_are_like_the_world(path: Path) -> None:
    source = given(path)
    for document in scenarios(source):
        check_document(path, source, document)


@pytest.mark.slow
@pytest.mark.parametrize("path", ALL, ids=name)
def test_all_versions_and_profiles(path: Path, tmp_path: Path) -> None:
    """They are valid as well, their stories can end, and their events lead back to the source."""
    for profile, version in WRITTEN:
        source = given(path)
        source = replace(source, xml=replace(source.xml, profile=profile, version=version))
        for document in scenarios(source):
            try:
                check_text(document, version)
                if profile == "generic":
                    check_quality(document, tmp_path)
                check_document(path, source, document)
            except AssertionError as error:
                error.add_note(f"{document.name} in version {version} for {profile}")
                raise


def check_text(document: XmlScenario, version: XmlVersion) -> None:
    """Look at a document as it is written."""
    assert (document.xml is None) == bool(document.report.obstacles)
    if document.xml is not None:
        assert schema_errors(document.xml, version) == []
        assert deprecated(document.xml, version) == set()
        assert story_problems(document.xml) == []
        assert untraced(document) == []
    if document.parameters is not None:
        assert schema_errors(document.parameters, version) == []


def check_quality(document: XmlScenario, folder: Path) -> None:
    """Let the quality checker look at a document and its values."""
    for text in (document.xml, document.parameters):
        if text is not None:
            assert checker_issues(text, folder) == []


@pytest.mark.slow
def test_case_study(test_data: Path) -> None:
    source = case_study(maps_in(test_data))
    (document,) = scenarios(source)
    assert is_exact(document), document.report.obstacles
    check(source, document)


def test_what_builds_write_is_one_of_the_versions_and_profiles() -> None:
    stated = [given(path).xml for path in ALL]
    assert {(xml.profile, xml.version) for xml in stated} <= set(WRITTEN)
    assert all(xml.allow_approx for xml in stated)


def test_exceptions_are_of_scenarios() -> None:
    assert WITHOUT_RUN.keys() <= set(map(name, ALL))
    assert set(map(name, ALL)) >= QUICK
