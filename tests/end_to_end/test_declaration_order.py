"""Declarations may stand in any order (§7.3.15): each is there before another one needs it."""

import json
from collections.abc import Callable
from itertools import permutations
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx_runtime import Scenario
from tests.end_to_end.harness import asam, run

DECLARATIONS = (
    "ego: vehicle",
    "limit: speed = base + 2mps",
    "base: speed = 4mps",
    "event fast is rise(ego.speed > limit)",
    "event counted is @fast if ego.speed < base + 20mps",
    "var seen: speed = sample(ego.speed, @counted, 0mps)",
    "var after: speed = sample(seen + base, @slow.end, 0mps)",
)
TEXT = """import osc.standard.all

namespace null use std, stdtypes

scenario ordered:
    {}
    do serial:
        slow: ego.drive(duration: 1s) with:
            speed(5mps)
        ego.change_speed(target: 10mps)
"""
# Each statement comes first once and last once; two that need each other stand both ways around.
ORDERS = [DECLARATIONS[n:] + DECLARATIONS[:n] for n in range(len(DECLARATIONS))]
ORDERS += [tuple(reversed(order)) for order in ORDERS]


@pytest.mark.parametrize("order", ORDERS, ids=range(len(ORDERS)))
def test_the_order_of_declarations_means_nothing(
    order: tuple[str, ...], load: Callable[[GeneratedModule], type[Scenario]], tmp_path: Path
) -> None:
    assert story(order, load, tmp_path) == story(DECLARATIONS, load, tmp_path)


def story(
    order: tuple[str, ...], load: Callable[[GeneratedModule], type[Scenario]], folder: Path
) -> list[str]:
    """Run the scenario; return what is told, at one time in any order and without source lines."""
    trace = run(load(emit(asam(TEXT.format("\n    ".join(order)), folder))))
    assert trace.of_kind("variable"), "the run samples nothing"
    told = [json.loads(line) for line in trace.ordered[1:] if line.startswith("{")]
    for line in told:
        line.pop("source", None)
    return sorted(json.dumps(line, sort_keys=True) for line in told)


def test_the_orders_have_every_pair_both_ways() -> None:
    for one, other in permutations(DECLARATIONS, 2):
        assert any(order.index(one) < order.index(other) for order in ORDERS)
