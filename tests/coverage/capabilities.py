"""The 38 capability rows: which scenarios and tests stand for each, and what is missing."""

from __future__ import annotations

import ast
import csv
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from tests.coverage.sources import CAPABILITIES, REPOSITORY, Source, scenarios

ROWS = Path(__file__).with_name("rows.csv")
TESTS = REPOSITORY / "tests" / "capabilities"


@dataclass(frozen=True)
class Row:
    """A capability.

    Attributes:
        id: `C01` to `C38`.
        category: What it belongs to.
        name: What it is called.
        scenarios: Those whose file begins with the id.
        tests: `file::function` of those whose name begins with it.
    """

    id: str
    category: str
    name: str
    scenarios: tuple[Source, ...]
    tests: tuple[str, ...]

    @property
    def gaps(self) -> tuple[str, ...]:
        """What stands in the way of saying that it works."""
        found = []
        if not self.scenarios:
            found.append("no scenario")
        for source in self.scenarios:
            reports = source.compilation.diagnostics
            if not source.builds or reports:
                codes = ", ".join(sorted({report.code for report in reports}))
                found.append(f"{source.path.stem}: {codes or 'no module'}")
        if not self.tests:
            found.append("no test")
        return tuple(found)


def rows() -> Sequence[Row]:
    """Return all rows."""
    own = [source for source in scenarios() if source.path.parent == CAPABILITIES]
    tests = test_functions()
    with ROWS.open(newline="", encoding="utf-8") as file:
        return [
            Row(
                line["id"],
                line["category"],
                line["capability"],
                tuple(source for source in own if source.path.stem.startswith(f"{line['id']}_")),
                tuple(tests.get(line["id"], ())),
            )
            for line in csv.DictReader(file)
        ]


@cache
def test_functions() -> Mapping[str, Sequence[str]]:
    """Return the tests of each row, by the names of their functions: `test_c07_...`."""
    found: dict[str, list[str]] = {}
    for path in sorted(TESTS.glob("test_*.py")):
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            match = isinstance(node, ast.FunctionDef) and re.match(r"test_(c\d\d)_", node.name)
            if match:
                place = f"{path.relative_to(REPOSITORY).as_posix()}::{node.name}"
                found.setdefault(match[1].upper(), []).append(place)
    return found
