"""Public documents: how many check, are compared with their documents, and do the same.

`python -m tests.importing.shared_report` prints the table with reasons.
"""

from pathlib import Path

import pytest

from tests.importing.shared_report import OFF, SAME, Row, rows

LEAST = {  # documents that check, are compared, and do the same
    "alks": (30, 30, 30),
    "ncap": (60, 60, 57),
    "esmini": (137, 105, 72),
    "scenario_runner": (16, 13, 11),
}

MOST_LINES = {"alks": 0.18, "ncap": 0.20, "esmini": 0.25, "scenario_runner": 0.14}
"""For one of XML. Curves that a document states in a line are polylines with many corners."""


@pytest.mark.slow
@pytest.mark.parametrize("family", LEAST)
def test_documents_of_a_library(family: str, test_data: Path, tmp_path: Path) -> None:
    found = list(rows(test_data / "xosc", tmp_path, [f"{family}/"]))
    checked = sum(row.is_checked for row in found)
    compared = sum(row.outcome in (SAME, OFF) for row in found)
    same = sum(row.outcome == SAME for row in found)
    least = LEAST[family]
    assert (checked >= least[0], compared >= least[1], same >= least[2]) == (True,) * 3, _said(
        found
    )
    ratio = sum(row.lines for row in found) / sum(row.xml_lines for row in found)
    assert ratio <= MOST_LINES[family]


def _said(found: list[Row]) -> str:
    return "\n".join(f"{row.file}: {row.detail or row.outcome}" for row in found)
