"""The page about security names tests that exist."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_each_promise_names_its_test() -> None:
    text = (ROOT / "SECURITY.md").read_text(encoding="utf-8")
    table = text.partition("## Promises")[2].partition("\n## ")[0]
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
