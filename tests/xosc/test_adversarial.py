"""Scenarios that look for lies: what is graded exact does what the embedded world does."""

from collections.abc import Iterator
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from osc2tx.backends.xosc import XmlScenario
from osc2tx.options import XmlOptions, XmlProfile, XmlVersion
from osc2tx_runtime import RunSettings
from tests.unit.backends.xosc.checks import schema_errors
from tests.xosc.adversarial import FAMILIES
from tests.xosc.parity import (
    FINE,
    WRITTEN,
    Given,
    check,
    is_exact,
    is_stated,
    played,
    reading_for,
    scenarios,
)

UNWRITTEN = "goes_aside"
"""In the names of cases whose lanes are those of an actor that changes lanes meanwhile: the world
follows it, and XML takes its lane at the start."""

LEAST = 150  # cases that are written as exact, so that all this compares enough
CASES = [(family, name) for family, cases in FAMILIES.items() for name in cases.names]

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def folder() -> Iterator[Path]:
    with TemporaryDirectory() as name:
        yield Path(name)


@cache
def family_of(
    family: str, folder: Path, profile: XmlProfile = "generic", version: XmlVersion = "1.3"
) -> tuple[Given, dict[str, XmlScenario]]:
    """Return the source of a family, and its documents by scenario."""
    path = folder / f"{family}.osc"
    path.write_text(FAMILIES[family].source, encoding="utf-8")
    xml = XmlOptions(profile=profile, version=version, allow_approx=True)
    given = Given(path, RunSettings(dt=FINE), xml=xml)
    return given, {each.name: each for each in scenarios(given)}


@pytest.mark.parametrize(("family", "name"), CASES)
def test_no_lies(family: str, name: str, folder: Path) -> None:
    for profile, version in WRITTEN:
        given, documents = family_of(family, folder, profile, version)
        try:
            check_case(given, documents[name])
        except AssertionError as error:
            error.add_note(f"in version {version} for {profile}")
            raise


def check_case(given: Given, document: XmlScenario) -> None:
    if document.xml is None:
        reasons = " ".join(entry.reason or "" for entry in document.report.obstacles)
        follows = UNWRITTEN in document.name and "takes the lane at the start" in reasons
        assert given.xml.version == "1.0" or follows, document.report.obstacles
        return
    assert schema_errors(document.xml, given.xml.version) == []
    if is_stated(document):
        check(given, document)
    else:  # it plays; how far off it is, its report says in words or as the run of a build shows
        reading = reading_for(given.xml)
        played(document.xml, 0.1, given.maps, reading=reading, most=10.0)


def test_enough_is_exact(folder: Path) -> None:
    exact = [name for family, name in CASES if is_exact(family_of(family, folder)[1][name])]
    assert len(exact) >= LEAST
    assert len({name for _, name in CASES}) == len(CASES)
