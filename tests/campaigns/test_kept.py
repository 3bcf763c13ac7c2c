"""A `keep` is never broken: 10^5 draws over twenty logical scenarios, checked in Python."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import closing
from typing import Any

import pytest

from osc2tx_runtime.campaigns import Executor, Row
from tests.campaigns.kit import DRIVES, plan_of

pytestmark = pytest.mark.slow

Values = Mapping[str, Any]

DRAWS = 5000
ROUNDING = 1e-9  # of products and quotients that are computed in another order here


def ranged(names: str, low: float, high: float, of_type: str = "float", unit: str = "") -> str:
    """Declare parameters with the same range."""
    return "".join(
        f"    {name}: {of_type} with:\n        keep(it in [{low}{unit}..{high}{unit}])\n"
        for name in names.split()
    )


def keeps(*constraints: str) -> str:
    return "".join(f"    keep({each})\n" for each in constraints)


CASES: dict[str, tuple[str, Callable[[Values], bool]]] = {
    "order": (ranged("a b", 0, 10) + keeps("a < b"), lambda v: v["a"] < v["b"]),
    "distances": (
        ranged("a b c", 0, 10) + keeps("a + 1.0 <= b", "b <= c + 2.0"),
        lambda v: v["a"] + 1 <= v["b"] <= v["c"] + 2,
    ),
    "corner of a cube": (
        ranged("a b c", 0, 1) + keeps("a + b + c >= 2.7"),
        lambda v: v["a"] + v["b"] + v["c"] >= 2.7,
    ),
    "sum of whole numbers": (
        ranged("i j", 0, 10, "int") + keeps("i + j == 10"),
        lambda v: v["i"] + v["j"] == 10,
    ),
    "one side or the other": (
        ranged("a", 0, 10) + keeps("a <= 1.0 or a >= 9.0"),
        lambda v: v["a"] <= 1 or v["a"] >= 9,
    ),
    "union": (
        "    a: float with:\n        keep(it in [0.0..4.0] or it in [6.0..8.0])\n",
        lambda v: 0 <= v["a"] <= 4 or 6 <= v["a"] <= 8,
    ),
    "braking distance": (
        ranged("v", 10, 20, "speed", "mps")
        + ranged("gap", 0, 100, "length", "m")
        + keeps("gap <= v * 2s"),
        lambda v: v["gap"] <= v["v"] * 2 + ROUNDING,
    ),
    "time to collision": (
        ranged("v w", 10, 20, "speed", "mps")
        + ranged("gap", 1, 50, "length", "m")
        + keeps("v > w", "gap / (v - w) in [1.5s..4s]"),
        lambda v: 1.5 - ROUNDING <= v["gap"] / (v["v"] - v["w"]) <= 4 + ROUNDING,
    ),
    "other members": ("    x: light\n    y: light\n" + keeps("x != y"), lambda v: v["x"] != v["y"]),
    "member and number": (
        "    x: light\n" + ranged("n", 1, 6, "int") + keeps("x == red => n >= 4"),
        lambda v: "red" not in str(v["x"]) or v["n"] >= 4,
    ),
    "bool and number": (
        "    w: bool\n" + ranged("n", 1, 6, "int") + keeps("w => n < 3"),
        lambda v: not v["w"] or v["n"] < 3,
    ),
    "chain": (
        ranged("p q r s", 0, 100) + keeps("p < q", "q < r", "r < s"),
        lambda v: v["p"] < v["q"] < v["r"] < v["s"],
    ),
    "diagonal": (
        ranged("a b", 0, 100) + keeps("a - b < 5.0", "b - a < 5.0"),
        lambda v: abs(v["a"] - v["b"]) < 5,
    ),
    "product": (ranged("a b", 0, 10) + keeps("a * b >= 20.0"), lambda v: v["a"] * v["b"] >= 20),
    "disc": (
        ranged("a b", 0, 10) + keeps("a * a + b * b <= 50.0"),
        lambda v: v["a"] ** 2 + v["b"] ** 2 <= 50 + ROUNDING,
    ),
    "division by what may be zero": (
        ranged("i j", 1, 12, "int") + keeps("12 / (i - j) > 3", "i != j"),
        lambda v: v["i"] != v["j"] and 12 / (v["i"] - v["j"]) > 3,
    ),
    "list": (
        "    k: int with:\n        keep(it in [1, 2, 5])\n"
        + ranged("m", 1, 8, "int")
        + keeps("m >= k"),
        lambda v: v["k"] in (1, 2, 5) and v["m"] >= v["k"],
    ),
    "computed within its range": (  # `b` follows, so it is not drawn
        ranged("a b c", 0, 10) + keeps("b == a + c"),
        lambda v: 0 <= v["a"] + v["c"] <= 10 + ROUNDING,
    ),
    "remainder": (ranged("i", 0, 20, "int") + keeps("i % 3 == 1"), lambda v: v["i"] % 3 == 1),
    "not both": (
        ranged("a b", 0, 10) + keeps("not (a > 5.0 and b > 5.0)", "a + b > 6.0"),
        lambda v: not (v["a"] > 5 and v["b"] > 5) and v["a"] + v["b"] > 6,
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_no_draw_breaks_a_constraint(case: str) -> None:
    declared, holds = CASES[case]
    head = "import osc.standard\n\nenum light: [red, amber, green]\n\nscenario top:\n"
    with closing(Executor(plan_of(head + declared + DRIVES))) as executor:
        drawn = [executor.values_of(Row(seed, seed))[0] for seed in range(DRAWS)]
    assert [values for values in drawn if not holds(values)] == []
    assert len({tuple(values.items()) for values in drawn}) > 1
