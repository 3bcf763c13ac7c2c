"""The work of a check grows with the size of a program, whatever its shape."""

import math

import pytest

from benchmarks.growth import SHAPES, compile_shape
from tests.work import calls

INHERITED = "generations"  # scenarios have all that they inherit: n * n / 2 members together


def exponent(name: str, size: int) -> float:
    compile_shape(name, 3)  # what is loaded once does not count
    small, large = (calls(lambda n=n: compile_shape(name, n)) for n in (size, 2 * size))
    return math.log2(large / small)


@pytest.mark.parametrize("name", sorted(SHAPES.keys() - {INHERITED}))
def test_growth_is_linear(name: str) -> None:
    assert exponent(name, 2 * SHAPES[name][1]) < 1.2


def test_each_inherited_member_takes_little_work() -> None:
    compile_shape(INHERITED, 3)
    members = [n * (n + 1) / 2 for n in (50, 100)]
    work = [calls(lambda n=n: compile_shape(INHERITED, n)) for n in (50, 100)]
    assert (work[1] - work[0]) / (members[1] - members[0]) < 200
