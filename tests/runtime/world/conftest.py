"""Worlds and small scenarios for the tests of the world side."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import osc2tx_runtime
from osc2tx_runtime import RunSettings, Scenario, run_scenario
from osc2tx_runtime.opendrive import LanePosition, RoadMap, read_map
from osc2tx_runtime.world import ActorSpec, EmbeddedWorld
from osc2tx_runtime.world.actor_dimensions import limits_of, shape_of

MAPS = Path(osc2tx_runtime.__file__).parent / "maps"


@pytest.fixture(scope="session")
def load_map() -> Callable[[str], RoadMap]:
    """A map of the runtime by name; read once."""
    known: dict[str, RoadMap] = {}

    def load(name: str) -> RoadMap:
        if name not in known:
            known[name] = read_map(MAPS / f"{name}.xodr")
        return known[name]

    return load


@pytest.fixture
def highway(load_map: Callable[[str], RoadMap]) -> RoadMap:
    return load_map("highway")


@pytest.fixture
def car_world(highway: RoadMap) -> Callable[..., EmbeddedWorld]:
    """World with one car `a` on lane -2 of the highway."""

    def make(dt: float = 0.05, speed: float = 10.0, category: str = "car") -> EmbeddedWorld:
        world = EmbeddedWorld(highway, dt)
        world.add(spec("a", category=category))
        world.place("a", LanePosition("1", -2, 100.0), speed)
        return world

    return make


def spec(name: str, kind: str = "vehicle", category: str | None = None) -> ActorSpec:
    return ActorSpec(
        name,
        kind,
        shape_of(kind, category),
        limits_of(kind, category),
        lane_bound=kind == "vehicle",
        movable=kind != "stationary_object",
    )


@pytest.fixture
def make_spec() -> Callable[..., ActorSpec]:
    return spec


class Run:
    """Result of a scenario with its trace, by actor."""

    def __init__(self, scenario: type[Scenario], settings: RunSettings) -> None:
        self.result = run_scenario(scenario, settings)
        self.lines: list[dict[str, Any]] = [json.loads(text) for text in self.result.trace_lines]

    def states(self, actor: str) -> list[dict[str, Any]]:
        return [e for e in self.lines if e["kind"] == "state" and e["actor"] == actor]

    def at(self, actor: str, t: float) -> dict[str, Any]:
        return next(e for e in self.states(actor) if abs(e["t"] - t) < 1e-6)

    def actions(self, name: str, status: str) -> list[dict[str, Any]]:
        return [
            e
            for e in self.lines
            if e["kind"] == "action" and e["name"] == name and e["status"] == status
        ]


@pytest.fixture
def run() -> Callable[..., Run]:
    """Runs a scenario class to its end."""

    def start(scenario: type[Scenario], **settings: Any) -> Run:
        return Run(scenario, RunSettings(**{"max_time": 60.0, **settings}))

    return start
