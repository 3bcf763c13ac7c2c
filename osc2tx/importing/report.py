"""How exactly a scenario says what its document says."""

from __future__ import annotations

import json
import math
from dataclasses import field
from typing import Literal, TypeAlias

from osc2tx.xosc.element import Place
from osc2tx_shared.classes import dataclass

Grade: TypeAlias = Literal["exact", "approximated", "left out"]
GRADES: tuple[Grade, ...] = ("left out", "approximated", "exact")
FORMAT = 2
CLOSE = 0.1  # m: what is nearer is the same place


@dataclass(frozen=True, slots=True)
class Finding:
    """A construct of a document that the scenario says nearly, or not at all.

    Attributes:
        grade: How well the scenario says it.
        construct: Its element.
        reason: What the difference is, a sentence without full stop.
        place: Where the element begins.
        file: Its file, if it is a catalog.
        bound: Metres by which an actor may be off; `None`: not known.
    """

    grade: Grade
    construct: str
    reason: str
    place: Place | None
    file: str = ""
    bound: float | None = None


def where(place: Place | None, file: str = "") -> str:
    """Return file and place, as far as they are known."""
    return ":".join(str(part) for part in (file, place) if part)


@dataclass(frozen=True, slots=True)
class Measured:
    """How far a run of the scenario is from the document, played.

    Attributes:
        place: Longest distance (m) between an actor here and there, events one step late apart.
        actor: The actor with that distance.
        at: Time (s) of that distance.
        time: Difference of the ends (s).
        is_exact: Whether places and ends are the same.
        off_road: The actor with which the comparison ends, at the end of its road.
    """

    place: float
    actor: str
    at: float
    time: float
    is_exact: bool
    off_road: str = ""

    @property
    def difference(self) -> str:
        """What differs, a sentence without full stop."""
        said = []
        if self.place >= CLOSE:
            said.append(f"{self.actor} is {self.place:.3g} m off at {self.at:g} s")
        if not self.is_exact and self.time > 0.0:
            said.append(f"its end is {self.time:.3g} s off")
        return "run against the document, " + " and ".join(said or ["the scenario is the same"])


@dataclass
class ImportReport:
    """What the import of a document found.

    Attributes:
        source: The document.
        scenario: The name of the scenario.
        findings: Constructs that are not exact.
        idle: Attributes that change nothing: path, text, reason, place.
        problems: What the version of the document does not allow, with places.
        names: Names of the document, and those of the scenario.
        under_test: Actors that a controller drives: systems under test.
        measured: What a run shows; `None`: there is none.
        unmeasured: Why there is no run.
    """

    source: str
    scenario: str = ""
    findings: list[Finding] = field(default_factory=list)
    idle: list[tuple[str, str, str, str]] = field(default_factory=list)
    problems: list[tuple[str, str]] = field(default_factory=list)
    names: dict[str, str] = field(default_factory=dict)
    under_test: list[str] = field(default_factory=list)
    measured: Measured | None = None
    unmeasured: str = ""
    _noted: set[tuple[str, str, str, str]] = field(default_factory=set)

    def measure(self, found: Measured | None, reason: str = "") -> None:
        """Take what a run shows; what is off in it is a finding with a bound.

        Args:
            found: The deviation; `None`: there is no run.
            reason: Why there is none.
        """
        self.measured, self.unmeasured = found, reason
        if found is not None and found.off_road:
            reason = (
                f"it fails where {found.off_road} comes to the end of its road, of which the"
                " standard says nothing; up to there it was compared"
            )
            self.findings.append(Finding("approximated", "the scenario", reason, None))
        if found is not None and not found.is_exact:
            bound = math.ceil(found.place * 100.0) / 100.0
            what = Finding("approximated", "the scenario", found.difference, None, bound=bound)
            self.findings.append(what)

    def add(self, finding: Finding) -> None:
        """Take a finding, unless it is known."""
        if finding not in self.findings:
            self.findings.append(finding)

    def note(
        self, what: str, text: str, reason: str, place: Place | None = None, file: str = ""
    ) -> None:
        """Take something that changes nothing; at one place it counts once.

        Args:
            what: Its path in the document, or what it is.
            text: What stands there.
            reason: Why that changes nothing.
            place: Where it stands.
            file: Its file, if it is a catalog.
        """
        note = (what, text, reason, where(place, file))
        if place is None or note not in self._noted:
            self._noted.add(note)
            self.idle.append(note)

    @property
    def grade(self) -> Grade:
        """The worst grade of all."""
        return min((each.grade for each in self.findings), key=GRADES.index, default="exact")

    @property
    def ordered(self) -> list[Finding]:
        """The findings, the worst first, then by place."""
        nowhere = Place(0, 0)
        return sorted(
            self.findings,
            key=lambda each: (GRADES.index(each.grade), each.file, each.place or nowhere),
        )

    def _measured(self) -> dict[str, object]:
        found = self.measured
        if found is None:
            return {"reason": self.unmeasured}
        return {
            "exact": found.is_exact,
            "place_m": round(found.place, 3),
            "actor": found.actor,
            "at_s": round(found.at, 3),
            "end_s": round(found.time, 3),
            **({"until_end_of_road_of": found.off_road} if found.off_road else {}),
        }

    def to_json(self) -> str:
        """Return the text of `NAME.import.json`."""
        document = {
            "format": FORMAT,
            "source": self.source,
            "scenario": self.scenario,
            "grade": self.grade,
            "basis": "constructs" if self.measured is None else "run",
            "measured": self._measured(),
            "under_test": self.under_test,
            "findings": [
                {
                    "grade": each.grade,
                    "construct": each.construct,
                    "reason": each.reason,
                    **({"file": each.file} if each.file else {}),
                    **(
                        {}
                        if each.place is None
                        else {"line": each.place.line, "column": each.place.column}
                    ),
                    **({} if each.bound is None else {"bound": each.bound}),
                }
                for each in self.ordered
            ],
            "problems": [{"reason": reason, "at": at} for reason, at in self.problems],
            "names": dict(sorted(self.names.items())),
            "without_effect": [
                {"attribute": path, "text": text, "reason": reason, "at": at}
                for path, text, reason, at in self.idle
            ],
        }
        return json.dumps(document, indent=1, ensure_ascii=False) + "\n"
