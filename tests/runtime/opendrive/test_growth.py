"""The work on a map grows with its size, whatever its shape."""

import math

import pytest

from benchmarks.maps import SHAPES, ask
from tests.work import calls


@pytest.mark.slow
@pytest.mark.parametrize("name", SHAPES)
def test_growth_is_linear(name: str) -> None:
    shape, size = SHAPES[name]
    small, large = (calls(lambda n=n: ask(shape(n))) for n in (size, 2 * size))
    assert math.log2(large / small) < 1.15
