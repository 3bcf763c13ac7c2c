"""Scenarios that look for lies: what is graded exact does what the embedded world does."""

from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest

from osc2tx.backends.xosc import XmlScenario
from osc2tx.options import XmlOptions, XmlVersion
from osc2tx_runtime import RunSettings
from tests.unit.backends.xosc.checks import schema_errors
from tests.xosc.adversarial import FAMILIES
from tests.xosc.parity import FINE, Given, check, is_exact, is_measured, played, scenarios

LEAST = 150  # cases that are written as exact, so that all this compares enough
CASES = [(family, name) for family, cases in FAMILIES.items() for name in cases.names]
OLDER: XmlVersion = "1.1"  # it has no limits of the jerk
IN_OLDER = [case for case in CASES if case[0] in ("speeds", "cut")]

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def folder() -> Iterator[Path]:
    with TemporaryDirectory() as name:
        yield Path(name)


@cache
def family_of(
    family: str, folder: Path, version: XmlVersion = "1.3"
) -> tuple[Given, dict[str, XmlScenario]]:
    """Return the source of a family, and its documents by scenario."""
    path = folder / f"{family}.osc"
    path.write_text(FAMILIES[family].source, encoding="utf-8")
    given = Given(path, RunSettings(dt=FINE), xml=XmlOptions(version=version, allow_approx=True))
    return given, {each.name: each for each in scenarios(given)}


@pytest.mark.parametrize(("family", "name"), CASES)
def test_no_lies(family: str, name: str, folder: Path) -> None:
    check_case(*family_of(family, folder), name)


@pytest.mark.parametrize(("family", "name"), IN_OLDER)
def test_no_lies_in_older_versions(family: str, name: str, folder: Path) -> None:
    check_case(*family_of(family, folder, OLDER), name)


def check_case(given: Given, documents: Mapping[str, XmlScenario], name: str) -> None:
    document = documents[name]
    assert document.xml is not None, document.report.obstacles
    assert schema_errors(document.xml, given.xml.version) == []
    if is_measured(document):
        check(given, document)
    else:  # it plays, and its report says in words how far off it is
        played(document.xml, 0.1, given.maps, most=10.0)


def test_enough_is_exact(folder: Path) -> None:
    exact = [name for family, name in CASES if is_exact(family_of(family, folder)[1][name])]
    assert len(exact) >= LEAST
    assert len({name for _, name in CASES}) == len(CASES)
