"""Findings of earlier builds, which hold as long as the same is played.

A change in a base compiles all scenarios that inherit it, but most of them are played as before:
they fix the changed value, or do not read it. So a finding is kept under a digest of all that the
runs depend on: the module and the document that are played, the map, osc2tx itself.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import fields
from typing import Any

from osc2tx.backends.py_trees.emitter import GeneratedModule
from osc2tx.backends.xosc import XmlScenario
from osc2tx.backends.xosc.report import Grade, Measured
from osc2tx.grading.comparison import ActorDeviation, Deviation
from osc2tx.grading.measuring import Finding
from osc2tx.grading.runs import NoEvidence
from osc2tx.options import XmlOptions
from osc2tx_shared.cache import Records, digest
from osc2tx_shared.classes import replace

MEASURED = tuple(each.name for each in fields(Measured))
ACTOR = tuple(each.name for each in fields(ActorDeviation))


def find(
    records: Records,
    document: XmlScenario,
    module: GeneratedModule,
    options: XmlOptions,
    measure: Callable[[], Finding],
) -> Finding:
    """Return the finding about a document, measured only if it is unknown.

    Args:
        records: Findings of earlier builds.
        document: The document with its report.
        module: The module with the scenario.
        options: Those of the document.
        measure: Plays the document.

    Raises:
        NoEvidence: There is no finding.
    """
    bounds = [e.bound for e in document.report.entries if e.grade is Grade.APPROXIMATED]
    place = records.place(
        [document.name, module.python, module.source_map],
        [document.xml, document.parameters],
        {event: str(span) for event, span in sorted(document.origins.items())},
        [[type(bound).__name__, str(bound)] for bound in bounds],
        repr(replace(options, map_path=())),
        [each.is_file() and digest(each.read_bytes()) for each in document.map_places],
    )
    known = records.read(place)
    try:
        if known is not None:
            return _restored(known)
    except (ValueError, KeyError, TypeError, AttributeError):  # damaged: as missing
        pass
    try:
        finding = measure()
    except NoEvidence as error:
        records.write(place, {"reason": str(error)})
        raise
    records.write(place, _record(finding))
    return finding


def _record(finding: Finding) -> dict[str, Any]:
    deviation, measured = finding.deviation, finding.measured
    return {
        "measured": [getattr(measured, name) for name in MEASURED],
        "late": deviation.late,
        "end": deviation.end,
        "actors": {
            actor: [getattr(each, name) for name in ACTOR]
            for actor, each in deviation.actors.items()
        },
        "problems": list(deviation.problems),
        "is_off_road": deviation.is_off_road,
        "is_at_fork": deviation.is_at_fork,
        "starts": dict(finding.starts),
        "is_faithful": finding.is_faithful,
    }


def _restored(record: Mapping[str, Any]) -> Finding:
    """Return a stored finding.

    Raises:
        NoEvidence: As the runs gave none.
    """
    if "reason" in record:
        raise NoEvidence(record["reason"])
    deviation = Deviation(
        record["late"],
        record["end"],
        {actor: ActorDeviation(*each) for actor, each in record["actors"].items()},
        tuple(record["problems"]),
        record["is_off_road"],
        record["is_at_fork"],
    )
    measured = Measured(*record["measured"])
    return Finding(measured, deviation, record["starts"], record["is_faithful"])
