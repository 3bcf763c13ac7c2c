"""What tools that read OpenSCENARIO XML can and cannot do, as data."""

from __future__ import annotations

from collections.abc import Mapping

from osc2tx.light_dataclass import dataclass
from osc2tx.options import XmlProfile, XmlVersion


@dataclass(frozen=True, slots=True, kw_only=True)
class ToolProfile:
    """A tool.

    Attributes:
        name: As on the command line.
        versions: What it reads.
        unsupported: Names of actions, conditions and other elements that it does not carry out,
            with what it does instead.
        has_edges: It looks at `conditionEdge`.
        has_delays: `delay` counts from when the condition came true, as in the standard.
        has_act_stop: It ends acts by their stop triggers.
        has_shapes: It looks at the shape of the dynamics.
    """

    name: XmlProfile
    versions: tuple[XmlVersion, ...] = ("1.0", "1.1", "1.2", "1.3")
    unsupported: Mapping[str, str]
    has_edges: bool = True
    has_delays: bool = True
    has_act_stop: bool = True
    has_shapes: bool = True


_ESMINI_IGNORES = {
    "CustomCommandAction": "it is logged and never ends",
    "GeoPosition": "the position is not understood",
    "ParameterAction/ModifyAction": "parameters can only be set",
    "RelativeAngleCondition": "the condition is not known",
    "TimeOfDayCondition": "the condition is dropped",
    "TrafficSignalControllerAction": "the action is ignored",
    "UserDefinedValueCondition": "the condition is dropped",
}
_SCENARIO_RUNNER_IGNORES = {
    "RoutePosition": "it raises an error",
    "SpeedProfileAction": "the action is not known",
    "VisibilityAction": "the action is not known",
    "LongitudinalDistanceAction/timeGap": "it raises an error",
    "Vertex/time": "times of vertices are ignored",
    "state/runningState": "it raises an error",
}

PROFILES: Mapping[XmlProfile, ToolProfile] = {
    "generic": ToolProfile(name="generic", unsupported={}),
    "esmini": ToolProfile(name="esmini", unsupported=_ESMINI_IGNORES),
    "scenario_runner": ToolProfile(
        name="scenario_runner",
        versions=("1.0",),
        unsupported=_SCENARIO_RUNNER_IGNORES,
        has_edges=False,
        has_delays=False,
        has_act_stop=False,
        has_shapes=False,
    ),
}
