"""The work of a check grows with the size of a program, whatever its shape."""

import math

import pytest

from benchmarks.growth import SHAPES, compile_shape
from osc2tx.semantics.declarations.inheritance import MOST_LEVELS
from osc2tx_runtime.language.tree.invocation import unique_name
from tests.work import calls

INHERITED = "generations"  # scenarios have all that they inherit: n * n / 2 members together

BUILT = (
    *("chain_of_invocations", "choices", "convoy", "logic", "misspelt", "reactions"),
    *("sequence", "signals", "total", "tower", "twice_invoked", "wide"),
)


def exponent(name: str, size: int, *, build: bool = False) -> float:
    def work(number: int) -> int:
        return calls(lambda: compile_shape(name, number, build=build))

    compile_shape(name, 3, build=build)  # what is loaded once does not count
    return math.log2(work(2 * size) / work(size))


@pytest.mark.parametrize("name", sorted(SHAPES.keys() - {INHERITED}))
def test_growth_is_linear(name: str) -> None:
    assert exponent(name, 2 * SHAPES[name][1]) < 1.2


@pytest.mark.parametrize("name", BUILT)
def test_growth_of_builds_is_linear(name: str) -> None:
    """Modules and documents are made, and played to be graded; budgets end what is not linear."""
    assert exponent(name, 2 * SHAPES[name][1], build=True) < 1.2


def test_a_unique_name_has_the_next_number() -> None:
    taken = dict.fromkeys(["drive", *(f"drive_{number}" for number in range(2, 1000))])
    assert unique_name("drive", taken) == "drive_1000"
    assert unique_name("brake", taken) == "brake"


def test_each_inherited_member_takes_little_work() -> None:
    compile_shape(INHERITED, 3)
    sizes = (MOST_LEVELS // 2, MOST_LEVELS)
    members = [n * (n + 1) / 2 for n in sizes]
    work = [calls(lambda n=n: compile_shape(INHERITED, n)) for n in sizes]
    assert (work[1] - work[0]) / (members[1] - members[0]) < 250
