"""Traces of small scenarios, good ones and perturbed ones, and what monitors say of them."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable
from functools import cache
from typing import Any

from osc2tx_runtime import Behaviour, RunSettings, Scenario, run_scenario
from osc2tx_runtime.domain.monitoring.phase import Violation
from osc2tx_runtime.running.verification import RecordedRun, recorded_run, verify
from osc2tx_shared.classes import replace
from tests.runtime.world.two_cars import TwoCars, scenario

Body = Callable[[TwoCars], Behaviour]
Change = Callable[[dict[str, Any], float], dict[str, Any]]


@cache
def recorded(body: Body) -> tuple[type[Scenario], RecordedRun]:
    """Run a scenario; it succeeds. Return its class and its trace."""
    made = scenario(body)
    result = run_scenario(made, RunSettings())
    assert (result.status, result.reason) == ("success", "")
    return made, recorded_run([json.loads(line) for line in result.trace_lines])


def found(body: Body, changes: Iterable[tuple[str, int, Change, float]] = ()) -> list[Violation]:
    """Return what monitors find in the trace of a scenario.

    Args:
        body: Its behavior.
        changes: Actor, step (negative: from the end), what changes in the state, by how much.
    """
    made, run = recorded(body)
    states = [dict(step) for step in run.states]
    for actor, step, change, by in changes:
        states[step][actor] = change(dict(states[step][actor]), by)
    return list(verify(replace(run, states=states), made).violations)


# --- changes of a state, whose kinds hang together as on the road -------------------------------


def faster(line: dict[str, Any], by: float) -> dict[str, Any]:
    return line | {"v": line["v"] + by}


def accelerated(line: dict[str, Any], by: float) -> dict[str, Any]:
    return line | {"a": line["a"] + by}


def ahead(line: dict[str, Any], by: float) -> dict[str, Any]:
    """Along the road, which is straight."""
    return line | {"s": line["s"] + by, "x": line["x"] + by}


def left(line: dict[str, Any], by: float) -> dict[str, Any]:
    """Across the lane."""
    return line | {"offset": line["offset"] + by, "y": line["y"] + by}


def lanes_left(line: dict[str, Any], by: float) -> dict[str, Any]:
    """To the centre of another lane: their ids grow to the left, they are 3.5 m wide."""
    lanes = round(by)
    return line | {"lane": line["lane"] + lanes, "y": line["y"] + 3.5 * lanes}


def off_road(line: dict[str, Any], by: float) -> dict[str, Any]:
    """Nowhere on the map, whatever the size."""
    return line | dict.fromkeys(("road", "lane", "s", "offset"))


def turned(line: dict[str, Any], by: float) -> dict[str, Any]:
    return line | {"h": math.remainder(line["h"] + by, math.tau)}


def tilted(line: dict[str, Any], by: float) -> dict[str, Any]:
    return line | {"pitch": line.get("pitch", 0.0) + by}
