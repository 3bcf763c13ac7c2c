"""Findings of earlier builds, which hold as long as the same is played.

A change in a base compiles all scenarios that inherit it, but most of them are played as before:
they fix the changed value, or do not read it. So a finding is kept under a digest of all that the
runs depend on: the module and the document that are played, the map, osc2tx itself. Comments count
for nothing, and lines of the sources only name things in it, so it holds as well if they move.
"""

from __future__ import annotations

import ast
import json
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields
from functools import lru_cache
from typing import Any

from osc2tx.backends.py_trees.emitter import GeneratedModule
from osc2tx.backends.xosc import XmlScenario
from osc2tx.grading.comparison import ActorDeviation, Deviation
from osc2tx.grading.measuring import Finding
from osc2tx.grading.runs import NoEvidence
from osc2tx.losses.bounds import Measured
from osc2tx.losses.entries import Grade
from osc2tx.options import XmlOptions
from osc2tx.support.records import Records, digest
from osc2tx_shared.classes import replace

MEASURED = tuple(each.name for each in fields(Measured))
ACTOR = tuple(each.name for each in fields(ActorDeviation))


def find(
    records: Records,
    document: XmlScenario,
    module: GeneratedModule,
    files: Mapping[str, str],
    options: XmlOptions,
    measure: Callable[[], Finding],
) -> Finding:
    """Return the finding about a document, measured only if it is unknown.

    Args:
        records: Findings of earlier builds.
        document: The document with its report.
        module: The module with the scenario.
        files: The sources of the scenarios of the module, by their names.
        options: Those of the document.
        measure: Plays the document.

    Raises:
        NoEvidence: There is no finding.
    """
    lines = list(dict.fromkeys(str(span) for _, span in sorted(document.origins.items())))
    stated = [e for e in document.report.entries if e.grade is Grade.APPROXIMATED]
    place = records.place(
        [document.name, _program(module.python), _lines_of_nodes(module, files, lines)],
        [document.xml, document.parameters],
        {event: lines.index(str(span)) for event, span in sorted(document.origins.items())},
        [[each.is_open, type(each.bound).__name__, str(each.bound)] for each in stated],
        repr(replace(options, map_path=())),
        [each.is_file() and digest(each.read_bytes()) for each in document.map_places],
    )
    known = records.read(place)
    try:
        if known is not None:
            return _restored(known, lines)
    except (ValueError, KeyError, IndexError, TypeError, AttributeError):  # damaged: as missing
        pass
    try:
        finding = measure()
    except NoEvidence as error:
        records.write(place, {"reason": str(error)})
        raise
    records.write(place, _record(finding, lines))
    return finding


@lru_cache(maxsize=1)  # the documents of a file have one module
def _program(python: str) -> str:
    """Return what a module does: its tree without docstrings."""
    tree = ast.parse(python)
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef) and ast.get_docstring(
            node
        ):
            del node.body[0]
    return ast.dump(tree)


def _lines_of_nodes(
    module: GeneratedModule, files: Mapping[str, str], lines: Sequence[str]
) -> list[list[int | None]]:
    """Return the line of each node of the trees, as its number among some lines."""
    numbers = {line: number for number, line in enumerate(lines)}
    maps = json.loads(module.source_map)["scenarios"]
    return [
        [place and numbers.get(f"{files[name]}:{place[0]}") for place in each["nodes"]]
        for name, each in maps.items()
    ]


def _record(finding: Finding, lines: Sequence[str]) -> dict[str, Any]:
    deviation, measured = finding.deviation, finding.measured
    return {
        "measured": [getattr(measured, name) for name in MEASURED],
        "late": deviation.late,
        "end": deviation.end,
        "actors": {
            actor: [getattr(each, name) for name in ACTOR]
            for actor, each in deviation.actors.items()
        },
        "problems": [_without_lines(each, lines) for each in deviation.problems],
        "is_off_road": deviation.is_off_road,
        "is_at_fork": deviation.is_at_fork,
        "starts": [finding.starts.get(line) for line in lines],
        "is_faithful": finding.is_faithful,
    }


def _without_lines(sentence: str, lines: Sequence[str]) -> list[str | int]:
    """Return the parts of a sentence, with numbers instead of the lines that it mentions."""
    numbers = {line: number for number, line in enumerate(lines)}
    longest_first = sorted(map(re.escape, lines), key=len, reverse=True)
    parts = re.split(f"({'|'.join(longest_first)})", sentence) if lines else [sentence]
    return [numbers.get(part, part) for part in parts]


def _restored(record: Mapping[str, Any], lines: Sequence[str]) -> Finding:
    """Return a stored finding.

    Raises:
        NoEvidence: As the runs gave none.
    """
    if "reason" in record:
        raise NoEvidence(record["reason"])
    problems = (
        "".join(lines[part] if isinstance(part, int) else part for part in sentence)
        for sentence in record["problems"]
    )
    deviation = Deviation(
        record["late"],
        record["end"],
        {actor: ActorDeviation(*each) for actor, each in record["actors"].items()},
        tuple(problems),
        record["is_off_road"],
        record["is_at_fork"],
    )
    place, speed, time, events, runs, omitted = record["measured"]
    measured = Measured(place, speed, time, events, runs, tuple(omitted))
    pairs = zip(lines, record["starts"], strict=True)
    starts = {line: at for line, at in pairs if at is not None}
    return Finding(measured, deviation, starts, record["is_faithful"])
