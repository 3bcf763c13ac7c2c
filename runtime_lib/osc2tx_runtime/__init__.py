"""Runtime of the modules that osc2tx generates: cast, behavior tree, embedded world, verdict.

A generated module needs the names below, `osc2tx_runtime.modifiers` and `osc2tx_runtime.units`.
The floors, from above; each imports only those below it:

* `running`: options, the loop of instants, the verdict; it writes the `report`.
* `domain`: actors, actions, modifiers, routes: the domain model of the standard.
* `language`: scenarios, their trees, events and values, the state of a run, the trace.
* `world`: the embedded world, and what every world offers.
* `opendrive`: the road map.
* `errors`, `enums`, `units`, `clock`, `interrupts`: leaves.
"""

from __future__ import annotations

from math import inf

import osc2tx_runtime.interrupts

# isort: split
import osc2tx_shared.text  # noqa: F401 (before libraries that want a standard output)

# isort: split
import osc2tx_runtime.domain.actions  # noqa: F401 (registers the actions of the library)
from osc2tx_runtime.domain.actors import (
    Actor,
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
    Trailer,
    Vehicle,
)
from osc2tx_runtime.domain.map.crossings import Crossing, CrossingType
from osc2tx_runtime.domain.map.roads_and_lanes import (
    CompoundLane,
    CompoundRoute,
    Junction,
    Lane,
    LaneSection,
    Road,
    RoadPath,
    Route,
)
from osc2tx_runtime.domain.measuring.weather import (
    Air,
    CelestialLightSource,
    CelestialPosition,
    Clouds,
    Fog,
    GeodeticPosition,
    Precipitation,
    Weather,
    Wind,
)
from osc2tx_runtime.domain.modifiers.base import Late, Modifier, value_of
from osc2tx_runtime.domain.objects.parts import (
    Axle,
    BehavioralModel,
    BmEngine,
    BoundingBox,
    HitchCoupler,
    HitchReceiver,
)
from osc2tx_runtime.domain.paths.path_values import (
    Path,
    RelativePathOdr,
    RelativePathPose3d,
    RelativePathSt,
    RelativeTrajectoryOdr,
    RelativeTrajectoryPose3d,
    RelativeTrajectorySt,
    Trajectory,
)
from osc2tx_runtime.domain.points_and_poses import GeodeticPoint, Rgb, RoutePoint, XyzPoint
from osc2tx_runtime.domain.scenario import Scenario
from osc2tx_runtime.domain.shapes import (
    AnyAccelerationShape,
    AnyLateralShape,
    AnyPositionShape,
    AnyShape,
    AnySpeedShape,
    CommonAccelerationShape,
    CommonLateralShape,
    CommonPositionShape,
    CommonSpeedShape,
    OwnShape,
)
from osc2tx_runtime.domain.signals.stop_lines import TrafficLightStopLine
from osc2tx_runtime.domain.signals.traffic_lights import (
    TrafficLight,
    TrafficLightBulb,
    TrafficLightCycle,
    TrafficLightGroup,
    TrafficLightPhase,
)
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.actions.action import Action, GlobalAction
from osc2tx_runtime.language.actions.registry import (
    LATERAL,
    LONGITUDINAL,
    action,
    global_action,
    methods,
    user_action,
)
from osc2tx_runtime.language.declared import as_type, member_at, not_given, undefined
from osc2tx_runtime.language.settings import RunSettings
from osc2tx_runtime.language.tree import (
    Behaviour,
    Call,
    Emit,
    End,
    Event,
    Fail,
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
from osc2tx_runtime.language.tree.duration_limits import Duration
from osc2tx_runtime.language.values.bounded_methods import bounded
from osc2tx_runtime.language.values.parameters import (
    Range,
    any_of,
    at_least,
    at_most,
    fixed,
    within,
)
from osc2tx_runtime.language.values.written_units import Unit
from osc2tx_runtime.running.main import main
from osc2tx_runtime.running.runner import RunResult, run_scenario
from osc2tx_runtime.world.drivers.driving import Control, Driver, LaneView, Observation, OtherActor
from osc2tx_runtime.world.measuring.velocities import (
    Acceleration,
    OrientationAcceleration,
    OrientationRate,
    TranslationalAcceleration,
    TranslationalVelocity,
    Velocity,
)

API_LEVEL = 1
"""Of the names and signatures below; a generated module requires the level it was made for."""


def require_api(level: int) -> None:
    """Reject a module that was made for another level of the runtime.

    Raises:
        ImportError: If this runtime does not have the level.
    """
    if level != API_LEVEL:
        advice = "upgrade osc2tx-runtime" if level > API_LEVEL else "build the module again"
        raise ImportError(
            f"the module needs level {level} of osc2tx_runtime, this is {API_LEVEL}: {advice}"
        )


__all__ = [  # noqa: RUF022 (grouped by origin)
    # This file
    "API_LEVEL",
    "require_api",
    # scenario: the base of generated classes
    "Range",
    "Scenario",
    "Unit",
    "any_of",
    "as_type",
    "at_least",
    "at_most",
    "bounded",
    "fixed",
    "inf",
    "member_at",
    "not_given",
    "undefined",
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
    "Trailer",
    "Vehicle",
    # motions: velocity and acceleration
    "Acceleration",
    "OrientationAcceleration",
    "OrientationRate",
    "TranslationalAcceleration",
    "TranslationalVelocity",
    "Velocity",
    # parts: of physical objects
    "Axle",
    "BehavioralModel",
    "BmEngine",
    "BoundingBox",
    "HitchCoupler",
    "HitchReceiver",
    # weather: and light
    "Air",
    "CelestialLightSource",
    "CelestialPosition",
    "Clouds",
    "Fog",
    "GeodeticPosition",
    "Precipitation",
    "Weather",
    "Wind",
    # shapes
    "AnyAccelerationShape",
    "AnyLateralShape",
    "AnyPositionShape",
    "AnyShape",
    "AnySpeedShape",
    "CommonAccelerationShape",
    "CommonLateralShape",
    "CommonPositionShape",
    "CommonSpeedShape",
    "OwnShape",
    # values: paths and points
    "GeodeticPoint",
    "Path",
    "RelativePathOdr",
    "RelativePathPose3d",
    "RelativePathSt",
    "RelativeTrajectoryOdr",
    "RelativeTrajectoryPose3d",
    "RelativeTrajectorySt",
    "Rgb",
    "RoutePoint",
    "Trajectory",
    "XyzPoint",
    # road_parts, crossings: values read from the map
    "CompoundLane",
    "CompoundRoute",
    "Crossing",
    "CrossingType",
    "Junction",
    "Lane",
    "LaneSection",
    "Road",
    "RoadPath",
    "Route",
    # traffic_lights, traffic_cycles, stop_line_parts
    "TrafficLight",
    "TrafficLightBulb",
    "TrafficLightCycle",
    "TrafficLightGroup",
    "TrafficLightPhase",
    "TrafficLightStopLine",
    # behaviour: compositions, directives, conditions
    "Behaviour",
    "Call",
    "Emit",
    "End",
    "Event",
    "Fail",
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
    # driving: an external driver of an actor
    "Control",
    "Driver",
    "LaneView",
    "Observation",
    "OtherActor",
    # action, registry: own actions
    "LATERAL",
    "LONGITUDINAL",
    "Action",
    "Actor",
    "Duration",
    "GlobalAction",
    "Late",
    "Modifier",
    "action",
    "global_action",
    "methods",
    "user_action",
    "value_of",
]
