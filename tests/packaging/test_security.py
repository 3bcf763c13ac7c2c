"""The pages about security and about robustness name tests that exist."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize(
    ("page", "heading"),
    [("SECURITY.md", "## Promises"), ("docs/robustness.md", "## Corrected defects")],
)
def test_each_row_names_its_test(page: str, heading: str) -> None:
    text = (ROOT / page).read_text(encoding="utf-8")
    table = text.partition(heading)[2].partition("\n## ")[0]
    rows = [line for line in table.splitlines() if line.startswith("| ")][1:]
    assert len(rows) > 10
    for row in rows:
        *_, tests = row.strip("| ").split(" | ")
        named = re.findall(r"`(tests/[^`]+)`", tests)
        assert named, row
        for each in named:
            path, _, function = each.partition("::")
            assert (ROOT / path).exists(), each
            if function:
                assert f"def {function}(" in (ROOT / path).read_text(encoding="utf-8"), each
