"""Alternatives that a duration relates to each other are drawn from all that fit."""

from __future__ import annotations

import json
from collections import Counter
from itertools import product

from osc2tx_runtime import OneOf, RunSettings, Scenario, Serial, Wait, elapsed, run_scenario
from osc2tx_runtime.language.tree.base import Behaviour

LENGTHS = (1.0, 2.0, 3.0)


class ThreeChoices(Scenario):
    """Three members, each 1 s, 2 s or 3 s, that take 6 s together."""

    name = "three"

    def create_tree(self) -> Behaviour:
        members = [
            OneOf(f"member {place}", *(Wait(f"{place}: {t:g}", elapsed(t)) for t in LENGTHS))
            for place in range(3)
        ]
        return Serial("three", *members, duration=6.0)


def test_each_way_to_fill_a_duration_is_drawn() -> None:
    found = Counter[tuple[float, ...]]()
    for seed in range(140):
        result = run_scenario(ThreeChoices, RunSettings(seed=seed))
        assert (result.status, result.time) == ("success", 6.0)
        lines = map(json.loads, result.trace_lines)
        chosen = [line["chosen"] for line in lines if line["kind"] == "choice"]
        found[tuple(float(name.partition(": ")[2]) for name in chosen)] += 1
    assert found.keys() == {each for each in product(LENGTHS, repeat=3) if sum(each) == 6.0}
    assert min(found.values()) > 140 / 7 / 3  # seven ways
