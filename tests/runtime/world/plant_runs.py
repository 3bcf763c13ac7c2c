"""Worlds and runs with a plant, for the tests of plants."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

from osc2tx_runtime import (
    RunResult,
    RunSettings,
    Scenario,
    run_scenario,
)
from osc2tx_runtime.opendrive import LanePosition, RoadMap
from osc2tx_runtime.world import EmbeddedWorld
from tests.runtime.world.following_plant import FollowingPlant

DT = 0.05
Spec = Callable[..., Any]


def driving(road_map: RoadMap, spec: Spec, plant: FollowingPlant, v: float = 15.0) -> EmbeddedWorld:
    """World with the driven car `a` on lane -2 of the highway, begun."""
    world = EmbeddedWorld(road_map, DT, plant)
    world.add(spec("a"))
    world.place("a", LanePosition("1", -2, 100.0), v)
    world.begin()
    return world


def steps(world: EmbeddedWorld, seconds: float) -> None:
    for _ in range(round(seconds / DT)):
        world.step()


class Run:
    """A run of a scenario with a plant."""

    def __init__(
        self,
        made: type[Scenario],
        road_map: RoadMap,
        plant: FollowingPlant,
        **settings: Any,
    ) -> None:
        world = EmbeddedWorld(road_map, DT, plant)
        options = RunSettings(**{"max_time": 60.0, **settings})
        self.result: RunResult = run_scenario(made, options, world=world)
        self.lines = [json.loads(line) for line in self.result.trace_lines]

    def actions(self, status: str) -> list[dict[str, Any]]:
        return [e for e in self.lines if e["kind"] == "action" and e["status"] == status]
