"""Runtime of the modules that osc2tx generates: cast, behavior tree, embedded world, verdict.

A generated module needs the names below, `osc2tx_runtime.modifiers` and `osc2tx_runtime.units`.
In order of control flow: `main` reads the options (`settings`), `runner` makes a `scenario`, its
tree (`behaviour`, `action`, `registry`) and its world (`world`, `initializer`), and runs the loop
of instants (`context`, `slots`); what happens goes into the `trace` and the `report`.
"""

from __future__ import annotations

import osc2tx_runtime.actions  # noqa: F401 (registers the actions of the library)
from osc2tx_runtime.action import Action
from osc2tx_runtime.actors import (
    Animal,
    Environment,
    Map,
    MovableObject,
    OdrPoint,
    Orientation,
    Person,
    PhysicalObject,
    Point,
    Pose,
    StationaryObject,
    TrafficLightController,
    Vehicle,
)
from osc2tx_runtime.behaviour import (
    Behaviour,
    Call,
    Emit,
    Event,
    On,
    OneOf,
    Parallel,
    Serial,
    Status,
    Until,
    Wait,
    elapsed,
    every,
    fall,
    rise,
)
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.main import main
from osc2tx_runtime.registry import LATERAL, LONGITUDINAL, action, methods
from osc2tx_runtime.runner import RunResult, run_scenario
from osc2tx_runtime.scenario import Scenario, within
from osc2tx_runtime.settings import RunSettings

API_LEVEL = 1
"""Of the names and signatures below; a generated module asks for the level it was made for."""


def require_api(level: int) -> None:
    """Stop the import of a module that was made for another runtime.

    Raises:
        ImportError: If this runtime does not have the level.
    """
    if level != API_LEVEL:
        advice = "upgrade osc2tx" if level > API_LEVEL else "build the module again"
        raise ImportError(
            f"the module needs level {level} of osc2tx_runtime, this is {API_LEVEL}: {advice}"
        )


__all__ = [  # noqa: RUF022 (grouped by origin)
    # This file
    "API_LEVEL",
    "require_api",
    # scenario: the base of generated classes
    "Scenario",
    "within",
    # actors: the cast and its values
    "Animal",
    "Environment",
    "Map",
    "MovableObject",
    "OdrPoint",
    "Orientation",
    "Person",
    "PhysicalObject",
    "Point",
    "Pose",
    "StationaryObject",
    "TrafficLightController",
    "Vehicle",
    # behaviour: compositions, directives, conditions
    "Behaviour",
    "Call",
    "Emit",
    "Event",
    "On",
    "OneOf",
    "Parallel",
    "Serial",
    "Status",
    "Until",
    "Wait",
    "elapsed",
    "every",
    "fall",
    "rise",
    # main, runner, settings, errors: running it
    "RunResult",
    "RunSettings",
    "ScenarioError",
    "main",
    "run_scenario",
    # action, registry: own actions
    "LATERAL",
    "LONGITUDINAL",
    "Action",
    "action",
    "methods",
]
