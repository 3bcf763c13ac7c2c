"""What is expected of an actor that somebody else drives: goals that are measured, not commanded.

An expectation is reached as soon as the actor was measured where the command wants it, in its own
time; what has a duration has to be reached by then, as always. Standing or going on is expected of
nobody.
"""

from __future__ import annotations

from collections.abc import Callable

from osc2tx_runtime.opendrive import LanePosition, RoadMap, Route

from .commands import (
    Careful,
    Command,
    FollowCourse,
    FollowRoute,
    FollowSpeed,
    KeepGap,
    KeepLane,
    LaneChange,
    LaneOffset,
    SpeedChange,
    Standstill,
    Turn,
)
from .curve import turn_between
from .gap_control import allowed_gap
from .lane_neighbours import neighbouring
from .protocol import PENDING, REACHED, Progress
from .route_following import Way
from .state import ActorState
from .step_inputs import StepInputs
from .tolerances import HEADING_TOLERANCE, PLACE_TOLERANCE, SPEED_TOLERANCE

__all__ = ["Expectation", "expected"]

_JOINED = 1.0  # m from a path at which one is on it

Judge = Callable[[ActorState, StepInputs], Progress]


class Expectation:
    """What one slot of an actor is expected to come to.

    Args:
        judge: Looks at its state after a step.
    """

    def __init__(self, judge: Judge) -> None:
        self._judge = judge
        self._progress = PENDING

    def look(self, state: ActorState, inputs: StepInputs) -> None:
        """See how far it is after a step."""
        self._progress = self._judge(state, inputs)

    def progress(self) -> Progress:
        """Reached while the actor is there; failed if that cannot be judged."""
        return self._progress


def expected(
    command: Command | None, state: ActorState, road_map: RoadMap, route: Route | None
) -> Expectation:
    """Return what a command means for somebody who is not commanded.

    Args:
        command: The command.
        state: Of the actor, when it is given.
        road_map: The map.
        route: What decides at forks.
    """
    return Expectation(_judge(command, state, road_map, route))


def _judge(
    command: Command | None, state: ActorState, road_map: RoadMap, route: Route | None
) -> Judge:
    match command:
        case None | KeepLane():
            return lambda me, inputs: REACHED
        case Careful():
            return _judge(command.course, state, road_map, route)
        case SpeedChange():
            return lambda me, inputs: _near(me.v - command.target, SPEED_TOLERANCE)
        case Standstill():
            return lambda me, inputs: _near(me.v, 0.0)
        case FollowSpeed():
            return lambda me, inputs: _speed_of_another(command, me, inputs)
        case KeepGap():
            return lambda me, inputs: _gap(command, me, inputs)
        case LaneChange() | LaneOffset():
            return _lane(command, state, road_map)
        case Turn(heading=heading) if heading is not None:
            return lambda me, inputs: _near(turn_between(heading, me.h), HEADING_TOLERANCE)
        case FollowRoute():
            return _route(command, road_map, route)
        case FollowCourse():
            return _path(command)
    failed = Progress(False, f"{type(command).__name__} can only be commanded, not expected")
    return lambda me, inputs: failed


def _near(error: float, tolerance: float) -> Progress:
    return REACHED if abs(error) <= tolerance else PENDING


def _speed_of_another(command: FollowSpeed, me: ActorState, inputs: StepInputs) -> Progress:
    least = inputs.state(command.reference).v * command.factor + command.difference
    return _near(me.v - min(max(me.v, least), least + command.spread), SPEED_TOLERANCE)


def _gap(command: KeepGap, me: ActorState, inputs: StepInputs) -> Progress:
    found = allowed_gap(command, me, inputs.state(command.reference), me.v, inputs)
    if found is None:
        return Progress(False, f"there is no way along lanes to {command.reference}")
    here, low, high = found
    return _near(here - min(max(here, low), high), PLACE_TOLERANCE)


def _lane(command: LaneChange | LaneOffset, state: ActorState, road_map: RoadMap) -> Judge:
    here = state.lane_position
    lanes = command.lanes if isinstance(command, LaneChange) else 0
    target = None if here is None else neighbouring(road_map, here, lanes)
    if target is None:
        failed = Progress(False, "there is no such lane where it is")
        return lambda me, inputs: failed
    goal = target

    def judge(me: ActorState, inputs: StepInputs) -> Progress:
        nonlocal goal
        place = me.lane_position
        if place is None:
            return PENDING
        ahead = road_map.route_distance(goal, place)
        if ahead is not None:  # the lane goes on, under whatever number
            goal = road_map.advance(LanePosition(goal.road, goal.lane, goal.s), ahead).position
        there = (place.road, place.lane) == (goal.road, goal.lane)
        return _near(place.offset - command.offset, PLACE_TOLERANCE) if there else PENDING

    return judge


def _route(command: FollowRoute, road_map: RoadMap, before: Route | None) -> Judge:
    way = Way(command, road_map, before)

    def judge(me: ActorState, inputs: StepInputs) -> Progress:
        if me.lane_position is not None:
            way.look(me.lane_position, abs(me.v) * inputs.dt)
        return way.progress()

    return judge


def _path(command: FollowCourse) -> Judge:
    along, joined = command.begin, False

    def judge(me: ActorState, inputs: StepInputs) -> Progress:
        nonlocal along, joined
        along = command.curve.nearest(me.x, me.y, along, max(2.0 * abs(me.v) * inputs.dt, 1.0))
        away = command.curve.distance_to(me.x, me.y, along)
        joined = joined or away <= _JOINED
        over = along >= command.end - PLACE_TOLERANCE
        return REACHED if joined and over and away <= _JOINED else PENDING

    return judge
