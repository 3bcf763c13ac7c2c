"""A part of the long run (`make fuzz`): a number of inputs of each kind, always the same."""

import re
import subprocess
import sys
from itertools import islice
from pathlib import Path

import pytest

from tests.fuzz.run import cases

SEED = 1
COUNTS = {
    **{"programs": 150, "grammar": 400, "mutations": 2000, "tokens": 8000, "extremes": 500},
    **{"maps": 3000, "traces": 1000, "source_maps": 1000, "reports": 1000, "digests": 1000},
    **{"settings": 2000, "options": 5000, "stores": 800},
}
"""About three minutes of one processor."""


@pytest.mark.slow
@pytest.mark.parametrize("maker", COUNTS)
def test_inputs(maker: str) -> None:
    for case in islice(cases(SEED, [maker], most="quick"), COUNTS[maker]):
        finding = case.attempt(case.text, execute=True)
        if finding is not None:
            pytest.fail(f"{case.seed}: {finding.key}\n{case.text}\n{finding.report}")


def test_the_page_states_these_counts() -> None:
    page = (Path(__file__).parents[2] / "docs" / "robustness.md").read_text(encoding="utf-8")
    stated = re.findall(r"^\| `(\w+)` \|.*\| ([\d,]+) \|$", page, re.MULTILINE)
    assert {kind: int(count.replace(",", "")) for kind, count in stated} == COUNTS


@pytest.mark.slow
def test_random_scenarios_run_the_same_twice() -> None:
    command = [sys.executable, str(Path(__file__).with_name("twice.py")), "--count", "40"]
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    assert " trace" in ended.stdout
