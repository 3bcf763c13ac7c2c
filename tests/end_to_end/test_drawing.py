"""Values that constraints between them leave: drawn, whatever the shape of what is left."""

from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx_runtime import RunSettings, Scenario
from osc2tx_runtime.errors import ScenarioError
from tests.end_to_end.harness import asam

Load = Callable[[GeneratedModule], type[Scenario]]

HEAD = """import osc.standard.all

namespace null use std, stdtypes

scenario top:
"""
TAIL = "    do wait elapsed(0.1s)\n"


@pytest.fixture
def drawn(load: Load, tmp_path: Path) -> Callable[[str, int], list[dict[str, Any]]]:
    """Declare a scenario with the first seeds, and return its values."""

    def drawn(members: str, seeds: int) -> list[dict[str, Any]]:
        scenario = load(emit(asam(HEAD + members + TAIL, tmp_path)))
        return [scenario(RunSettings(seed=seed)).parameters for seed in range(seeds)]

    return drawn


def parameters(*names: str, type_: str, values: str) -> str:
    return "".join(f"    {n}: {type_} with:\n        keep(it in {values})\n" for n in names)


Drawn = Callable[[str, int], list[dict[str, Any]]]


@pytest.mark.parametrize(
    ("condition", "share"),
    [
        ("b in [0.0..4.0] or b in [6.0..8.0]", 4 / 6),
        ("b in [6.0..8.0] or (b >= 0.0 and b <= 4.0)", 4 / 6),
        ("not (b < 0.0 or b > 4.0 and b < 6.0 or b > 8.0)", 4 / 6),
        ("(b > 5.0 => b in [6.0..8.0]) and (b <= 5.0 => b in [0.0..4.0])", 4 / 6),
    ],
)
def test_a_union_of_ranges_is_drawn_evenly(drawn: Drawn, condition: str, share: float) -> None:
    found = [each["b"] for each in drawn(f"    b: float\n    keep({condition})\n", 600)]
    assert all(0.0 <= b <= 4.0 or 6.0 <= b <= 8.0 for b in found)
    lower = sum(b <= 4.0 for b in found) / len(found)
    assert lower == pytest.approx(share, abs=4 * (share * (1 - share) / len(found)) ** 0.5)


def test_alternatives_of_whole_numbers_and_of_several_values(drawn: Drawn) -> None:
    members = "    n, k: int\n    keep(n in [1..2] and k == 5 or n == 9 and k in [2, 3])\n"
    found = {(each["n"], each["k"]) for each in drawn(members, 60)}
    assert found == {(1, 5), (2, 5), (9, 2), (9, 3)}


def test_a_division_may_stand_before_its_guard(drawn: Drawn) -> None:
    members = parameters("i", "j", type_="int", values="[0..5]")
    found = drawn(members + "    keep(12 / (i - j) > 3)\n    keep(i != j)\n", 40)
    assert all(0 < each["i"] - each["j"] <= 3 for each in found)


@pytest.mark.parametrize(
    ("member", "line", "text"),
    [
        ("    x: float = 1.0 / 0.0\n", 6, "`1.0 / 0.0` cannot be computed: float division"),
        ("    n: int = 0\n    x: int = 7 % n\n", 7, "`7 % n` cannot be computed: integer modulo"),
        ("    n: int = 0\n    x: int = 7 / n\n", 7, "`7 / n` cannot be computed: integer div"),
    ],
)
def test_a_value_without_result_is_said_with_its_line(
    drawn: Drawn, member: str, line: int, text: str
) -> None:
    with pytest.raises(ScenarioError) as error:
        drawn(member, 1)
    assert error.value.source == f"case.osc:{line}"
    assert text in error.value.message


def test_elements_of_which_nothing_is_said_are_as_the_others(drawn: Drawn) -> None:
    members = (
        "    xs: list of length with:\n        keep(it.size() == 3)\n    keep(xs[0] in [1m..2m])\n"
    )
    for each in drawn(members, 10):
        assert sorted(each) == ["xs.0", "xs.1", "xs.2"]
        assert all(1.0 <= value <= 2.0 for value in each.values())


def ordered(count: int) -> str:
    names = [f"p{n}" for n in range(count)]
    after = [f"    keep({a} < {b})\n" for a, b in pairwise(names)]
    return parameters(*names, type_="length", values="[0m..300m]") + "".join(after)


@pytest.mark.slow
def test_eight_values_in_order(drawn: Drawn) -> None:
    """One of 40,320 draws would have them so."""
    for each in drawn(ordered(8), 6):
        assert list(each.values()) == sorted(each.values())


@pytest.mark.slow
def test_a_thin_set_beside_other_demands(drawn: Drawn) -> None:
    members = parameters("a", "b", "c", type_="length", values="[0m..100m]")
    members += "    keep(a - b < 1cm)\n    keep(b - a < 1cm)\n    keep(b + c > 30m)\n"
    found = drawn(members, 8)
    assert all(abs(each["a"] - each["b"]) < 0.01 for each in found)
    assert max(each["a"] for each in found) - min(each["a"] for each in found) > 20.0


@pytest.mark.slow
def test_values_in_order_are_drawn_from_all_that_are(drawn: Drawn) -> None:
    """The means of n numbers in order divide their range evenly (order statistics)."""
    count, seeds = 8, 150
    found = drawn(ordered(count), seeds)
    for n in range(count):
        mean = sum(each[f"p{n}"] for each in found) / seeds
        share = (n + 1) / (count + 1)
        deviation = 300 * (share * (1 - share) / (count + 2)) ** 0.5
        assert mean == pytest.approx(300 * share, abs=4 * deviation / seeds**0.5), n


def test_what_nothing_can_be_is_said(drawn: Drawn) -> None:
    members = parameters("i", "j", "k", type_="int", values="[0..5]")
    with pytest.raises(ScenarioError, match=r"does not hold in 1000 draws"):
        drawn(members + "    keep(i * i + j * j + k * k == 7)\n", 1)


BALL = parameters("a", "b", "c", "d", type_="float", values="[0.0..10.0]")


@pytest.mark.parametrize(
    ("relations", "broken", "rivals"),
    [
        (["a * a + b * b <= 9.0", "c > d", "a + b > 5.0"], "a + b > 5.0", [0]),
        (["c > d", "a + b > 5.0", "a * a + b * b <= 9.0"], "a * a + b * b <= 9.0", [1]),
        (
            ["a * a + b * b + c * c <= 9.0", "a > d", "a + b > 3.5", "c > 2.0 or d > 9.0"],
            "c > 2.0 or d > 9.0",
            [0, 1, 2],  # without `a > d`, `d` may be above 9
        ),
        (["i * i + j * j == 7", "i < 4"], "i * i + j * j == 7", []),  # at odds with itself
    ],
)
def test_relations_that_contradict_each_other_are_named(
    drawn: Drawn, relations: list[str], broken: str, rivals: list[int]
) -> None:
    members = BALL + parameters("i", "j", type_="int", values="[0..5]")
    first = (HEAD + members).count("\n") + 1
    keeps = "".join(f"    keep({each})\n" for each in relations)
    with pytest.raises(ScenarioError) as error:
        drawn(members + keeps, 1)
    assert error.value.source is not None
    assert error.value.source.endswith(f":{first + relations.index(broken)}")
    said = error.value.message.partition(" (the last values")[0]
    named = [f"`{relations[each]}` (case.osc:{first + each})" for each in rivals]
    together = f" together with {' and '.join(named)}" if named else ""
    assert said == f"`{broken}` does not hold in 1000 draws{together}"


def test_bounds_that_depend_on_a_drawn_value(drawn: Drawn) -> None:
    members = (
        "    a: bool\n    v: int\n    keep(a => v in [1..3])\n    keep(not a => v in [5..6])\n"
    )
    found = drawn(members, 60)
    assert {(each["a"], each["v"]) for each in found} == {
        *((True, v) for v in (1, 2, 3)),
        *((False, v) for v in (5, 6)),
    }
