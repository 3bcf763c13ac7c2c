"""Edges of conditions on measured states: what flickers at a threshold turns once."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, cast

import pytest

from osc2tx_runtime import RunSettings
from osc2tx_runtime.language.context import ExecutionContext
from osc2tx_runtime.language.tree.conditions import Edge
from osc2tx_runtime.opendrive import LanePosition, RoadMap
from osc2tx_runtime.world import EmbeddedWorld
from osc2tx_runtime.world.plant.plant import Identity
from tests.runtime.world.following_plant import FollowingPlant


@pytest.mark.parametrize(
    ("samples", "exact", "measured"),
    [
        ("0001111", [3], [3]),
        ("0101010", [1, 3, 5], [1]),
        ("0001010011", [3, 5, 8], [3, 8]),
        ("11100011", [6], [6]),
        ("1011", [2], []),  # the start is no edge, and one step without is none either
        ("00110011", [2, 6], [2, 6]),
    ],
)
@pytest.mark.parametrize("target", [True, False])
def test_turns(samples: str, exact: list[int], measured: list[int], target: bool) -> None:
    """`samples` has a digit a step: whether the function has the value that it turns to."""
    for noisy, expected in ((False, exact), (True, measured)):
        now: Any = SimpleNamespace(step=0, snapshot=0, is_placing=False, is_measured=noisy)
        edge = Edge(
            lambda now=now: (samples[now.step] == "1") is target,
            target,
            cast(ExecutionContext, now),
        )
        found = []
        for step in range(1, len(samples)):
            now.step = now.snapshot = step
            if edge():
                found.append(step)
        assert found == expected


@pytest.mark.parametrize(
    ("plant", "measured"), [(Identity(), False), (FollowingPlant(), True)], ids=["exact", "driven"]
)
def test_whose_states_are_noisy(
    highway: RoadMap, make_spec: Any, plant: Any, measured: bool
) -> None:
    world = EmbeddedWorld(highway, 0.05, plant)
    world.add(make_spec("a"))
    world.place("a", LanePosition("1", -2, 100.0), 15.0)
    context = ExecutionContext(world, RunSettings(), {"a": cast(Any, None)})
    assert context.is_measured is measured
