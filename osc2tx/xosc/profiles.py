"""Profiles of tools that read OpenSCENARIO XML: what each supports."""

from __future__ import annotations

from collections.abc import Mapping

from osc2tx.options import XML_VERSIONS, XmlProfile, XmlVersion
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class ToolProfile:
    """A tool.

    Attributes:
        name: As on the command line.
        versions: The versions that it reads.
        unsupported: Names of actions, conditions and other elements that it does not execute, with
            its behavior instead.
        deviates: Names of those that it executes differently, with its behavior and the deviation.
        has_edges: It evaluates `conditionEdge`, and restarts events.
        has_delays: `delay` counts from when the condition became true, as in the standard, and a
            condition that is no longer true does not count.
        is_lazy: Behind a false condition of a group it evaluates only delayed ones.
        latches_conditions: Each condition of a group is required once, not all at one time.
        has_act_stop: It ends acts by their stop triggers; otherwise it evaluates their events again
            in each step.
        stop_name: Name of the condition that stops the storyboard, if the tool requires one named
            condition on the state of an element.
        needs_lane_range: It finds no lane where a condition names none; in the standard that is
            all.
        has_shapes: It applies the shape of the dynamics.
        takes_speeds_at_once: A new speed is the setpoint from the start of its action.
        has_booleans: It compares variables with `true` and `false`, not only with numbers.
        carries_acceleration: A profile of speeds begins with the present acceleration; by the
            standard it begins without any.
        counts_along_roads: A position by lanes from an actor counts `dsLane`, and a distance in the
            coordinate system of lanes counts, along the road; in the standard it is along the
            lane, which is shorter or longer in a bend.
        commands_speeds: A speed without a direction is the commanded one, along the entity; one
            with `longitudinal` is a part of its motion, to which lateral motion contributes.
        fits_gaps: A gap without limits is the free space between boxes as they stand, with speeds
            that jump, and a time counts at the speed of the reference; in the standard it is along
            the lane, at speeds that the performance allows, and a time counts at the speed of the
            one behind.
        sends_along_lanes: Without a path, walkers and objects with a speed move along the lane; in
            the standard they have no lane.
        guesses_at_forks: An entity that changes lanes, or drives against the traffic, where its
            lane forks may take any of the roads.
        ego_property: Value of the property `type` by which it knows the ego vehicle; empty if it
            needs none.
        person_model: Its model name of a person, if it reads names as its own models.
        signals_by_place: It identifies traffic lights by their position in coordinates of CARLA,
            not by their ids in the map.
        knows_towns: Maps have names for it, not only files.
        begins_with_texts: A variable is the string of its declaration, which equals no number,
            until an action sets it.
        walkers_keep_heading: Whether a walker with a new speed moves along its heading.
        has_middle_origins: Its models have their origins in the middle, and are placed by it.
        moves_maps: Its treatment of the offset in the header of a map; empty if it ignores it.
    """

    name: XmlProfile
    versions: tuple[XmlVersion, ...] = XML_VERSIONS
    unsupported: Mapping[str, str]
    deviates: Mapping[str, tuple[str, str]]
    has_edges: bool = True
    has_delays: bool = True
    is_lazy: bool = False
    latches_conditions: bool = False
    has_act_stop: bool = True
    stop_name: str = ""
    needs_lane_range: bool = False
    has_shapes: bool = True
    takes_speeds_at_once: bool = False
    has_booleans: bool = True
    carries_acceleration: bool = False
    counts_along_roads: bool = False
    commands_speeds: bool = False
    fits_gaps: bool = False
    sends_along_lanes: bool = False
    guesses_at_forks: bool = False
    ego_property: str = ""
    person_model: str = ""
    signals_by_place: bool = False
    knows_towns: bool = False
    moves_maps: str = ""
    begins_with_texts: bool = False
    walkers_keep_heading: bool = False
    has_middle_origins: bool = False


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
    "AbsoluteTargetLane": "the action is not known",
    "AccelerationCondition": "it compares the amount, speeding up or slowing down",
    "AcquirePositionAction": "it raises an error",
    "AssignRouteAction": "it raises an error",
    "CustomCommandAction": "it runs a command of the shell",
    "DistanceCondition/alongRoute": "its planner raises an error on a road that nothing follows",
    "DistanceCondition/freespace": "it counts between reference points",
    "FollowTrajectoryAction/MiscObject": "objects have no controller",
    "FollowTrajectoryAction/Vehicle": "its controller raises an error where the way ends",
    "LaneChangeActionDynamics/time": "only a distance is understood",
    "LateralDistanceAction": "it comes to another distance and never ends",
    "LongitudinalDistanceAction": "it passes the vehicle straight ahead and never ends",
    "ParameterCondition/text": "it compares numbers only",
    "Precipitation/snow": "there is no snow",
    "RelativeTargetLane/entityRef": "lanes are counted from the actor itself",
    "RoutePosition": "it raises an error",
    "SpeedActionDynamics/rate": "the rate is taken for a time",
    "SpeedProfileAction": "the action is not known",
    "TeleportAction/moving": "its controllers go on along the way that they were on",
    "TimeHeadwayCondition": "it divides by the difference of the speeds",
    "TrafficSignalControllerAction": "it raises an error at more than one phase",
    "UserDefinedValueCondition": "it raises an error",
    "VisibilityAction": "the action is not known",
    "state/runningState": "it raises an error",
}
_SCENARIO_RUNNER_DEVIATES = {
    "FollowTrajectoryAction/Pedestrian": (
        "walkers turn to the next point of a way 1 m before each, and walk on behind the last one",
        "off by 1 m at corners and at the end, which comes so much earlier",
    ),
    "LaneChangeActionDynamics": (
        "the change is over when the plan of its way is",
        "it begins at the right time and may be over 2.2 s early, beside the middle of the lane",
    ),
    "LaneOffsetActionDynamics": (
        "the offset is the aim from the start on",
        "it begins at the right time and may be over 1 s early",
    ),
    "RelativeDistanceCondition/freespace": (
        "free space counts between boxes of its models",
        "off by half of what both are longer or shorter there",
    ),
    "RelativeDistanceCondition/longitudinal": (
        "a distance between two roads is the length of the route to the other one",
        "the same while the other one is ahead or on the same road",
    ),
    "SpeedActionDynamics": (
        "the new speed is the aim from the start on, whatever the shape",
        "start and length of the action are exact; the way meanwhile is off by at most half that"
        " length times the change, more where its throttle and brakes are not enough",
    ),
    "SpeedCondition/equalTo": (
        "physics only nearly reaches a commanded speed",
        "true later than it should be, or not at all",
    ),
    "TimeToCollisionCondition": (
        "it is the straight distance by the difference of the speeds",
        "the same while both go the same way in one lane",
    ),
}

PROFILES: Mapping[XmlProfile, ToolProfile] = {
    "generic": ToolProfile(name="generic", unsupported={}, deviates={}),
    "esmini": ToolProfile(
        name="esmini",
        versions=("1.0", "1.1", "1.2", "1.3"),
        unsupported=_ESMINI_IGNORES,
        deviates={},
        carries_acceleration=True,
        counts_along_roads=True,
        commands_speeds=True,
        fits_gaps=True,
        sends_along_lanes=True,
        guesses_at_forks=True,
        is_lazy=True,
        needs_lane_range=True,
        moves_maps=(
            "positions are without the offset in the header of the map; esmini adds it to the map"
            " and, from version 2.41.1 on, to positions as well; with `--ignore_odr_offset` to none"
        ),
    ),
    "scenario_runner": ToolProfile(
        name="scenario_runner",
        versions=("1.0",),
        unsupported=_SCENARIO_RUNNER_IGNORES,
        deviates=_SCENARIO_RUNNER_DEVIATES,
        has_edges=False,
        has_delays=False,
        latches_conditions=True,
        has_act_stop=False,
        stop_name="criteria_end",
        has_shapes=False,
        takes_speeds_at_once=True,
        has_booleans=False,
        ego_property="ego_vehicle",
        person_model="walker.pedestrian.0001",
        signals_by_place=True,
        knows_towns=True,
        begins_with_texts=True,
        walkers_keep_heading=True,
        has_middle_origins=True,
    ),
}
