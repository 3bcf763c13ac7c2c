"""Expectations of actors with another driver: goals that are measured, not commanded.

An expectation is reached as soon as the actor is measured at the goal of the command, at any time
and along any path; a goal with a duration has to be reached by then. Commands without a goal expect
nothing.
"""

from __future__ import annotations

from collections.abc import Callable

from osc2tx_runtime.opendrive import LanePosition, RoadMap, Route
from osc2tx_runtime.world.commands import (
    Accelerate,
    AccelerationChange,
    Arrive,
    Beside,
    Careful,
    Command,
    Cover,
    FollowCourse,
    FollowRoute,
    FollowSpeed,
    GapCourse,
    KeepGap,
    KeepLane,
    KeepSchedule,
    LaneChange,
    LaneOffset,
    Sideways,
    Slant,
    SpeedChange,
    Standstill,
    Turn,
)
from osc2tx_runtime.world.geometry.curve import turn_between
from osc2tx_runtime.world.geometry.lane_neighbours import lane_beside
from osc2tx_runtime.world.geometry.profiles import Profile
from osc2tx_runtime.world.lateral.route_following import Way
from osc2tx_runtime.world.measuring.deviation import (
    ACCELERATION_TOLERANCE,
    HEADING_TOLERANCE,
    PLACE_TOLERANCE,
    SPEED_TOLERANCE,
)
from osc2tx_runtime.world.measuring.distances import drift, side_gap
from osc2tx_runtime.world.protocol import PENDING, REACHED, Progress
from osc2tx_runtime.world.state import ActorState
from osc2tx_runtime.world.step_inputs import StepInputs

from .timed_expectations import Arrival, Timetable, gap_error, speed_error

_JOINED = 1.0  # m from a path within which an actor is on it

Judge = Callable[[ActorState, StepInputs], Progress]


class Expectation:
    """The expected goal of one slot of an actor.

    Args:
        judge: Evaluates its state after a step.
    """

    def __init__(self, judge: Judge) -> None:
        self._judge = judge
        self._progress = PENDING

    def look(self, state: ActorState, inputs: StepInputs) -> None:
        """Evaluate a step."""
        self._progress = self._judge(state, inputs)

    def progress(self) -> Progress:
        """Reached while the actor is there; failed if that cannot be judged."""
        return self._progress


def expected(
    command: Command | None, state: ActorState, road_map: RoadMap, route: Route | None
) -> Expectation:
    """Return the expectation of a command for an actor that is not commanded.

    Args:
        command: The command.
        state: State of the actor at the command.
        road_map: The map.
        route: Decides at forks.
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
        case SpeedChange() | Standstill() | FollowSpeed() | Accelerate() | AccelerationChange():
            return _speed(command, state)
        case KeepGap() | GapCourse():
            return _gap(command)
        case Arrive():
            return Arrival(command)
        case Cover(course=course):
            return Arrival(Arrive(course.duration, way=_last(course, 0.0)))
        case KeepSchedule():
            return Timetable(command)
        case LaneChange() | LaneOffset():
            return _lane(command, state, road_map)
        case Sideways() | Slant() | Turn():
            return _heading(command, road_map)
        case Beside():
            return _beside(command)
        case FollowRoute():
            return _route(command, road_map, route)
        case FollowCourse():
            return _path(command)
    failed = Progress(False, f"{type(command).__name__} can only be commanded, not expected")
    return lambda me, inputs: failed


def _near(error: float, tolerance: float) -> Progress:
    return REACHED if abs(error) <= tolerance else PENDING


def _last(course: Profile | None, otherwise: float) -> float:
    """The end of a profile; without one, the target."""
    return otherwise if course is None else course.value(course.duration)


def _speed(
    command: SpeedChange | Standstill | FollowSpeed | Accelerate | AccelerationChange,
    state: ActorState,
) -> Judge:
    match command:
        case SpeedChange(target=speed, course=course):
            goal = _last(course, speed)
            return lambda me, inputs: _near(me.v - goal, SPEED_TOLERANCE)
        case Standstill():
            return lambda me, inputs: _near(me.v, 0.0)
        case FollowSpeed():
            return lambda me, inputs: _near(speed_error(command, me, inputs), SPEED_TOLERANCE)
        case Accelerate(acceleration=rate):
            wanted = state.a if rate is None else rate
        case AccelerationChange(target=target, course=course):
            wanted = _last(course, target)
    return lambda me, inputs: _near(me.a - wanted, ACCELERATION_TOLERANCE)


def _gap(command: KeepGap | GapCourse) -> Judge:
    no_way = Progress(False, f"there is no route along lanes to {command.reference}")

    def judge(me: ActorState, inputs: StepInputs) -> Progress:
        if isinstance(command, KeepGap):
            error = gap_error(command, me, inputs)
        else:
            here = inputs.along(inputs.state(command.reference), me)
            error = None if here is None else _last(command.course, 0.0) - here
        return no_way if error is None else _near(error, PLACE_TOLERANCE)

    return judge


def _heading(command: Sideways | Slant | Turn, road_map: RoadMap) -> Judge:
    """Heading of an actor, in the world or relative to its lane, or its lateral motion."""
    match command:
        case Turn(heading=heading, course=course):
            if heading is None and course is None:
                return lambda me, inputs: REACHED  # pitch and roll follow from the road
            goal = _last(course, heading or 0.0)
            return lambda me, inputs: _near(turn_between(goal, me.h), HEADING_TOLERANCE)
        case Sideways():
            return lambda me, inputs: _near(_missing_rate(command, me, inputs), SPEED_TOLERANCE)
        case Slant(angle=angle, course=course):
            goal = _last(course, angle)

    def judge(me: ActorState, inputs: StepInputs) -> Progress:
        if me.lane_position is None:
            return PENDING
        turn = turn_between(road_map.pose(me.lane_position).h, me.h)
        return _near(turn_between(goal, turn), HEADING_TOLERANCE)

    return judge


def _missing_rate(command: Sideways, me: ActorState, inputs: StepInputs) -> float:
    """Missing lateral speed (m/s) of an actor, to the left."""
    other = command.reference
    moving = 0.0 if other is None else command.factor * inputs.state(other).lateral_speed
    return _last(command.course, command.speed) + moving - me.lateral_speed


def _beside(command: Beside) -> Judge:
    no_way = Progress(False, f"there is no route along lanes to {command.reference}")
    low = _last(command.course, command.left or 0.0)

    def judge(me: ActorState, inputs: StepInputs) -> Progress:
        other = inputs.state(command.reference)
        to_left = inputs.aside(me, other)
        if to_left is None:
            return no_way
        if command.time is not None:
            closing = side_gap(to_left, me.shape, other.shape) / command.time
            return _near(drift(me, other) - closing - me.lateral_speed, SPEED_TOLERANCE)
        return _near(-to_left - min(max(-to_left, low), low + command.spread), PLACE_TOLERANCE)

    return judge


def _lane(command: LaneChange | LaneOffset, state: ActorState, road_map: RoadMap) -> Judge:
    here = state.lane_position
    lanes = command.lanes if isinstance(command, LaneChange) else 0
    target = None if here is None else lane_beside(road_map, here, lanes)
    offset = _last(command.course, command.offset)
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
        if ahead is not None:  # the lane continues, whatever its id
            lane = road_map.advance(LanePosition(goal.road, goal.lane, goal.s), ahead).position
            goal = lane._replace(offset=goal.offset)
        there = (place.road, place.lane) == (goal.road, goal.lane)
        return _near(place.offset - goal.offset - offset, PLACE_TOLERANCE) if there else PENDING

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
