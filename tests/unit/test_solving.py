"""Values that keep constraints: what is found keeps them, and what exists is found."""

from __future__ import annotations

from itertools import pairwise, product

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from osc2tx.support.solving import All, Among, Any, Interval, Linear, Relation, Solver

NAMES = ("a", "b", "c")
DIGITS = range(5)

weights = st.dictionaries(
    st.sampled_from(NAMES), st.sampled_from([-2.0, -1.0, 1.0, 2.0]), min_size=1
)
comparisons = st.tuples(weights, st.integers(-8, 8), st.booleans())
clauses = st.lists(st.lists(comparisons, min_size=1, max_size=3), min_size=1, max_size=3)
shares = st.tuples(*[st.floats(0.01, 0.99)] * len(NAMES))


def linear(comparison: tuple[dict[str, float], int, bool]) -> Relation:
    weights, rest, is_strict = comparison
    return Linear(weights, float(rest), is_strict=is_strict)


def holds(comparison: tuple[dict[str, float], int, bool], point: dict[str, object]) -> bool:
    weights, rest, is_strict = comparison
    total = sum(weight * float(point[name]) for name, weight in weights.items()) + rest  # type: ignore[arg-type]
    return total < 0 if is_strict else total <= 0


def is_kept(rows: list[list[tuple[dict[str, float], int, bool]]], point: dict[str, object]) -> bool:
    return all(any(holds(each, point) for each in row) for row in rows)


@settings(max_examples=300, deadline=None)
@given(clauses, shares, st.booleans())
def test_what_is_found_keeps_all_relations(rows, places, is_listed):  # type: ignore[no-untyped-def]
    """Whole numbers, as an interval or as a set; `or` of comparisons of sums."""
    domain = tuple(DIGITS) if is_listed else Interval(DIGITS[0], DIGITS[-1], is_whole=True)
    relations = [Any([linear(each) for each in row]) for row in rows]
    found = Solver(dict.fromkeys(NAMES, domain), relations).choose(
        dict(zip(NAMES, places, strict=True))
    )
    possible = [dict(zip(NAMES, point, strict=True)) for point in product(DIGITS, repeat=3)]
    if not any(is_kept(rows, point) for point in possible):  # type: ignore[arg-type]
        assert found is None
    if found is not None:
        assert is_kept(rows, found)


@settings(max_examples=100, deadline=None)
@given(st.lists(st.floats(0.001, 0.999), min_size=2, max_size=30))
def test_an_order_of_numbers_is_always_found(places):  # type: ignore[no-untyped-def]
    keys = [f"v{index}" for index in range(len(places))]
    pairs = list(pairwise(keys))
    order = [Linear({low: 1.0, high: -1.0}, 0.0, is_strict=True) for low, high in pairs]
    found = Solver(dict.fromkeys(keys, Interval(1.0, 100.0)), order).choose(
        dict(zip(keys, places, strict=True))
    )
    assert found is not None
    values = [found[key] for key in keys]
    assert all(a < b for a, b in pairwise(values))  # type: ignore[operator]


@settings(max_examples=100, deadline=None)
@given(st.lists(st.floats(0.0, 1.0), min_size=2, max_size=30), st.data())
def test_whole_numbers_with_a_given_sum_are_always_found(places, data):  # type: ignore[no-untyped-def]
    keys = [f"k{index}" for index in range(len(places))]
    total = data.draw(st.integers(0, 9 * len(keys)))
    ones = dict.fromkeys(keys, 1.0)
    minus = dict.fromkeys(keys, -1.0)
    relations = [
        Linear(ones, -float(total), is_strict=False),
        Linear(minus, float(total), is_strict=False),
    ]
    found = Solver(dict.fromkeys(keys, Interval(0, 9, is_whole=True)), relations).choose(
        dict(zip(keys, places, strict=True))
    )
    assert found is not None and sum(found.values()) == total  # type: ignore[arg-type]


def test_sets_are_left_what_passes() -> None:
    wet = Among("road", lambda value: value == "wet")
    slow = Linear({"v": 1.0}, -10.0, is_strict=False)
    dry = Among("road", lambda value: value != "wet")
    domains = {"road": ("dry", "wet"), "v": Interval(0.0, 100.0)}
    solver = Solver(domains, [Any([dry, All([wet, slow])])])
    for share in (0.0, 0.3, 0.6, 0.9):
        found = solver.choose({"road": 0.9, "v": share})
        assert found is not None and (found["road"] == "dry" or found["v"] <= 10.0)  # type: ignore[operator]


@pytest.mark.parametrize(
    "relations",
    [
        [Any(())],
        [Linear({"v": 1.0}, 1.0, is_strict=False), Linear({"v": -1.0}, 0.0, is_strict=False)],
        [
            Linear({"v": 1.0, "w": -1.0}, 1.0, is_strict=False),
            Linear({"v": -1.0, "w": 1.0}, 1.0, is_strict=False),
        ],
    ],
)
def test_contradictions_have_no_values(relations: list[Relation]) -> None:
    """The last one creeps: `v < w - 1` and `w < v - 1` push bounds without an end."""
    domains = {"v": Interval(0.0, 1e6), "w": Interval(0.0, 1e6)}
    assert Solver(domains, relations).choose({"v": 0.5, "w": 0.5}) is None
