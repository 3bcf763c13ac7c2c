"""What becomes of scenarios and constructs as OpenSCENARIO XML, by version, from loss reports.

Reports of the repository's own scenarios, whose documents are played, and of the golden tests of
the back end are all that is looked at: a construct that none of them has is not in the table.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

from osc2tx.backends.xosc import XmlScenario, emit
from osc2tx.diagnostics import DiagnosticSink
from osc2tx.grading import Source as Played
from osc2tx.grading import graded
from osc2tx.losses.entries import Entry, Grade
from osc2tx.options import XML_VERSIONS, XmlVersion
from osc2tx.support.records import Records
from tests.coverage.capabilities import Row
from tests.coverage.sources import Source, scenarios
from tests.golden.test_xosc import CASES, written

WORDS = {
    Grade.EXACT: "exact",
    Grade.APPROXIMATED: "approximated",
    Grade.INEXPRESSIBLE: "not expressible",
}
ORDER = (Grade.EXACT, Grade.APPROXIMATED, Grade.INEXPRESSIBLE)
OF_VERSION = re.compile(r"revMinor=\W+\d|version=.1\.\d")
THIS_VERSION = re.compile(r"OpenSCENARIO XML 1\.\d")
ONE_OF_A_KIND = ("actor", "signal", "parameter")
"""Constructs that are called by a name of the scenario."""


class Findings(Records):
    """Findings in memory, which hold for the same document of another version."""

    def __init__(self) -> None:
        super().__init__(Path(), "")
        self._known: dict[Path, dict[str, Any]] = {}

    def place(self, *parts: object) -> Path:
        """Return the name of a finding."""
        return super().place(OF_VERSION.sub("", json.dumps(parts)))

    def read(self, place: Path) -> dict[str, Any] | None:
        """Return a finding."""
        return self._known.get(place)

    def write(self, place: Path, record: dict[str, Any]) -> None:
        """Store a finding."""
        self._known[place] = record


FINDINGS = Findings()


@cache
def documents(source: Source, version: XmlVersion) -> tuple[XmlScenario, ...]:
    """Return the scenarios of a file in a version, with grades by their runs, as of a build."""
    compilation, folder = source.compilation, source.path.parent
    module = compilation.ir
    if module is None or not module.scenarios:
        return ()
    options = replace(compilation.options, xml=replace(compilation.options.xml, version=version))
    found = emit(module, options.xml, folder)
    played = Played(module, options, folder, compilation.whole_module, FINDINGS)
    return graded(found, played, DiagnosticSink())


def grade_of(found: Iterable[XmlScenario]) -> Grade:
    """Return the worst grade of scenarios."""
    grades = {entry.grade for scenario in found for entry in scenario.report.entries}
    return max(grades, key=ORDER.index, default=Grade.EXACT)


def capability_rows(rows: Sequence[Row]) -> Iterator[list[str]]:
    """Yield for each scenario of a capability its grade in each version, and what is in the way."""
    for row in rows:
        for source in row.scenarios:
            found = {version: documents(source, version) for version in XML_VERSIONS}
            grades = [WORDS[grade_of(found[version])] for version in XML_VERSIONS]
            yield [row.id, source.path.stem, *grades, _reasons(found[XML_VERSIONS[-1]])]


def _reasons(found: Iterable[XmlScenario]) -> str:
    """Return why the newest version has no exact document."""
    entries = [entry for scenario in found for entry in scenario.report.entries]
    lost = [entry for entry in entries if entry.grade is not Grade.EXACT]
    return "<br>".join(dict.fromkeys(_cell(f"{e.construct}: {e.reason}") for e in lost))


def construct_rows() -> Iterator[list[str]]:
    """Yield for each construct the best and the worst that becomes of it, by version."""
    for name, by_version in sorted(losses().items()):
        yield [
            f"`{name}`",
            *(_grades(by_version.get(v, ())) for v in XML_VERSIONS),
            _why(by_version),
        ]


@cache
def losses() -> dict[str, dict[XmlVersion, list[Entry]]]:
    """Return what became of each construct, by version."""
    seen: dict[str, dict[XmlVersion, list[Entry]]] = {}
    for version in XML_VERSIONS:
        for scenario in _all(version):
            for entry in scenario.report.entries:
                name = _kind(entry.construct)
                seen.setdefault(name, {}).setdefault(version, []).append(entry)
    return seen


def _all(version: XmlVersion) -> Iterator[XmlScenario]:
    for source in scenarios():
        yield from documents(source, version)
    for case in CASES:
        yield written(case, version)


def _kind(construct: str) -> str:
    """Return the construct without a name that only one scenario has."""
    first = construct.partition(" ")[0]
    if first == "actor":
        return construct
    return first if first in ONE_OF_A_KIND else construct.replace("`", "")


def _grades(entries: Sequence[Entry]) -> str:
    grades = {entry.grade for entry in entries}
    return ", ".join(WORDS[grade] for grade in ORDER if grade in grades) or "-"


def _why(by_version: dict[XmlVersion, list[Entry]]) -> str:
    lost = [e for entries in by_version.values() for e in entries if e.grade is not Grade.EXACT]
    reasons: dict[str, str] = {}
    for entry in lost:
        remedy = f" ({entry.remedy} can)" if str(entry.remedy) else ""
        reason = THIS_VERSION.sub("this version", _cell(entry.reason))
        reasons.setdefault(reason, remedy)
    shown = [f"{reason}{remedy}" for reason, remedy in list(reasons.items())[:3]]
    more = len(reasons) - len(shown)
    return "<br>".join([*shown, *([f"and {more} more"] if more else [])])


def _cell(text: str) -> str:
    return text.replace("|", "&#124;").replace("\n", " ")
