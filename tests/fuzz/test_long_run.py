"""A part of the long run (`make fuzz`): a number of inputs of each kind, always the same."""

from itertools import islice

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
    for case in islice(cases(SEED, [maker], quick=True), COUNTS[maker]):
        finding = case.attempt(case.text, execute=True)
        if finding is not None:
            pytest.fail(f"{case.seed}: {finding.key}\n{case.text}\n{finding.report}")
