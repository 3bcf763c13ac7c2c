"""What becomes of public OpenSCENARIO XML documents: a table with reasons by count.

    python -m tests.importing.shared_report $OSC2TX_TEST_DATA/xosc [--off] [FILTER ...]

Each document is imported, checked, run in the embedded world and compared with the document as the
player plays it. A FILTER is part of a path; `--off` lists the documents that are not the same.
"""

from __future__ import annotations

import argparse
import re
import tempfile
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from statistics import median
from typing import NamedTuple

from osc2tx.cli.import_ import Result, import_all
from osc2tx.importing.document import Folders

TOWNS = "carla-2020"
"""The folder of the maps that documents of CARLA name without a path."""

MOST_LINES = 1 / 6
"""Lines of a scenario for one of its document, in review."""

SAME, OFF = "same places and end", "other places or another end"


class Row(NamedTuple):
    """A document.

    Attributes:
        file: Its path below the folder of documents.
        outcome: `SAME`, `OFF`, or why it was not compared.
        is_checked: Whether the scenario checks.
        is_overriding: Whether an event of the scenario overrides another one.
        lines: Lines of the scenario.
        xml_lines: Lines of the document; with those of the scenario that it names unless it is
            inherited.
        detail: What is off, where and when.
    """

    file: str
    outcome: str
    is_checked: bool
    is_overriding: bool
    lines: int
    xml_lines: int
    detail: str = ""


def rows(folder: Path, out: Path, filters: Sequence[str] = ()) -> Iterator[Row]:
    """Yield the rows of the documents below a folder.

    Args:
        folder: The folder.
        out: Where the scenarios go.
        filters: Parts of paths; documents with none of them are left out.
    """
    maps = (folder.parent / "maps" / TOWNS,)
    for number, path in enumerate(sorted(folder.rglob("*.xosc"))):
        file = path.relative_to(folder).as_posix()
        if filters and not any(part in file for part in filters):
            continue
        place = out / str(number)  # each has settings of its own
        results, refused = import_all([path], place, Folders(maps), force=True)
        yield from (_row(file, path, each) for each in results if each.imported.source == path)
        if refused:
            yield Row(file, "it is refused", False, False, 0, 0)


def _row(file: str, path: Path, result: Result) -> Row:
    report = result.imported.report
    measured, detail = report.measured, ""
    if measured is None:
        outcome, detail = _without_numbers(report.unmeasured), report.unmeasured
    else:
        outcome = SAME if measured.is_exact else OFF
        where = f"{measured.actor} at {measured.at:.2f} s"
        detail = f"{measured.place:.2f} m: {where}; end {measured.time:.2f} s"
    named = None if result.imported.program.base else result.imported.distribution
    return Row(
        file,
        outcome,
        not result.faults,
        "override(" in result.text,
        len(result.text.splitlines()),
        _lines(path) + (0 if named is None else _lines(path.parent / named.scenario)),
        detail,
    )


def _lines(path: Path) -> int:
    return len(path.read_bytes().splitlines())


def _without_numbers(reason: str) -> str:
    """Return what is common to reasons: no names, numbers and places."""
    reason = re.sub(r"\S*\d\S*|`[^`]*`", "…", reason.split(" (")[0])
    return re.sub(r"(: )\S+?(\.\w+)?( failed| overlaps)", r"\1…\3", reason)[:100]


def summary(found: Sequence[Row]) -> str:
    """Return the table."""
    lines = [
        "| documents | all | check | compared | the same | lines for one of XML, median |",
        "|---|---|---|---|---|---|",
    ]
    families = sorted({row.file.split("/")[0] for row in found})
    for family in (*families, ""):
        of = [row for row in found if row.file.startswith(family)]
        compared = sum(row.outcome in (SAME, OFF) for row in of)
        same = sum(row.outcome == SAME for row in of)
        checked = sum(row.is_checked for row in of)
        length = median(row.lines / row.xml_lines for row in of if row.xml_lines)
        counts = f"{len(of)} | {checked} | {compared} | {same}"
        lines.append(f"| {family or 'all'} | {counts} | {length:.3f} |")
    outcomes = Counter(row.outcome for row in found)
    lines += ["", *(f"{count:4} {outcome}" for outcome, count in outcomes.most_common())]
    ratio = sum(row.lines for row in found) / max(1, sum(row.xml_lines for row in found))
    overriding = sum(row.is_overriding for row in found)
    short = sum(row.lines <= MOST_LINES * row.xml_lines for row in found)
    counted = f"{ratio:.3f} lines for one of XML, {short} with a sixth at most"
    return "\n".join([*lines, "", f"{counted}; {overriding} with override"])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("filters", nargs="*")
    parser.add_argument("--off", action="store_true", help="list what is not the same")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as out:
        found = list(rows(arguments.folder, Path(out), arguments.filters))
    for row in found if arguments.off else ():
        if row.outcome != SAME:
            print(f"{row.file}: {row.detail}")
    print(summary(found))


if __name__ == "__main__":
    main()
