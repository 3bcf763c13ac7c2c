"""How much of the scenarios here and of the public ones becomes OpenSCENARIO XML.

    python -m tests.corpus.xml_report             documents by version and profile
    python -m tests.corpus.xml_report --reasons   with why most of them are refused

Counted are scenarios: exact ones, those that are written where approximations are allowed, and
refused ones. The public files lie in `$OSC2TX_TEST_DATA/corpus`, maps that they may ask for in the
folders of `$OSC2TX_TEST_DATA/maps`. Files that do not build, and those whose authors expect a
refusal, do not count.
"""

from __future__ import annotations

import argparse
import os
import re
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator
from pathlib import Path

from osc2tx.backends.xosc import XmlScenario, emit
from osc2tx.compilation.driver import Compilation
from osc2tx.losses.entries import Grade
from osc2tx.options import CompileOptions, XmlOptions
from osc2tx.xosc.profiles import PROFILES
from tests.corpus.report import INVALID, compilation_of, manifest

SCENARIOS = Path(__file__).parents[2] / "scenarios"
TEST_DATA = Path(os.environ["OSC2TX_TEST_DATA"])
MAPS = tuple(map(str, sorted(each for each in (TEST_DATA / "maps").iterdir() if each.is_dir())))
TARGETS = [
    XmlOptions(version=version, profile=name, allow_approx=True, map_path=MAPS)
    for name, tool in PROFILES.items()
    for version in tool.versions
]
GRADES = ("exact", "approximated", "refused")
MOST = 12  # reasons

Table = dict[str, dict[XmlOptions, Counter[str]]]


def own() -> Iterator[Compilation]:
    """Yield the compilations of the scenarios of this repository."""
    for path in sorted(SCENARIOS.rglob("*.osc")):
        dialect = "carla" if path.stem == "hello_world" else "asam"
        yield Compilation(path, path.name, CompileOptions(dialect=dialect))


def public(corpus: Path) -> Iterator[Compilation]:
    """Yield the compilations of the public files that should build."""
    for row in manifest(corpus):
        if row["kind"] != INVALID:
            yield compilation_of(corpus, row)


def grade_of(document: XmlScenario) -> str:
    """Return what became of a scenario."""
    if document.xml is None:
        return "refused"
    grades = {entry.grade for entry in document.report.entries}
    return "exact" if grades <= {Grade.EXACT} else "approximated"


def count(
    name: str, compilations: Iterable[Compilation], table: Table, reasons: Counter[str]
) -> None:
    """Count the documents of some files; reasons are those of generic 1.3."""
    rows = table.setdefault(name, defaultdict(Counter))
    for compilation in compilations:
        if compilation.module is None or compilation.ir is None:
            continue
        for target in TARGETS:
            for document in emit(compilation.ir, target, compilation.path.parent):
                rows[target][grade_of(document)] += 1
                if (target.version, target.profile) == ("1.3", "generic"):
                    reasons.update({_kind(entry.reason) for entry in document.report.obstacles})


def _kind(reason: str) -> str:
    """Return a reason without names and numbers."""
    return re.sub(r"`[^`]*`|\b\d[\w.]*|map \w+|--spawn \w+", "…", reason)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--reasons", action="store_true")
    options = parser.parse_args()
    table: Table = {}
    reasons: Counter[str] = Counter()
    count("scenarios/", own(), table, reasons)
    count("corpus", public(TEST_DATA / "corpus"), table, reasons)
    print(
        f"{'':12}{'profile':17}{'version':9}"
        + "".join(f"{each:>14}" for each in ("written", *GRADES))
    )
    for name, rows in table.items():
        for target, counts in rows.items():
            written = counts["exact"] + counts["approximated"]
            figures = (written, *(counts[each] for each in GRADES))
            print(
                f"{name:12}{target.profile:17}{target.version:9}"
                + "".join(f"{n:14}" for n in figures)
            )
    if options.reasons:
        for reason, times in reasons.most_common(MOST):
            print(f"{times:6} {reason}")


if __name__ == "__main__":
    main()
