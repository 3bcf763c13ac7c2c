"""One actor over one step."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from osc2tx_runtime.opendrive import DRIVING, LanePosition, Pose, RoadMap, Route

from .catalogue import TYRES, Limits
from .commands import Command, FollowRoute, KeepLane, SpeedChange, Turn
from .courses import TURN_RATE, Course, Steering, course_of
from .curve import turn_between
from .friction import held_by
from .lateral import (
    SIDEWAYS,
    HoldOffset,
    Impossible,
    Lateral,
    Shift,
    lateral_of,
    offset_from,
    shift_profile,
)
from .longitudinal import Longitudinal, acceleration_of, longitudinal_of
from .protocol import PENDING, REACHED, ActorSpec, Progress
from .senses import Senses
from .state import ActorState
from .way import Way
from .wheels import Wheels, curvature_ahead

__all__ = ["ANY_LANE", "CRUISE", "Body"]

CRUISE = {"person": 1.4, "animal": 1.4, "movable_object": 1.4}
"""Speed (m/s) at which those who stand set out on a course; vehicles: `CRUISE_VEHICLE`."""

CRUISE_VEHICLE = 5.0

ANY_LANE = DRIVING | {
    "shoulder", "sidewalk", "walking", "biking", "parking", "border", "curb", "median", "stop",
    "restricted", "special1", "special2", "special3", "tram", "rail", "roadWorks",
}  # fmt: skip
"""Lane types on which actors off the lanes are located."""

_NEAR = 0.5  # m: how far outside a lane an actor is still on it
_STILL = 1e-9  # m/s
_BACK = 5.0  # m beside a lane from where a vehicle returns to it after a course
_ALIGNED = 0.3  # rad to its lane with which a vehicle is in it again


@dataclass(slots=True)
class Body:
    """An actor with its commands at work.

    Attributes:
        spec: What it is.
        state: Snapshot of the present step.
        bound: Lane it follows, with its offset from there; None off the lanes.
        route: Decides at forks; None: the smallest change of heading.
        blocked: Why it cannot go on; None while it can.
        jumped: In the last step it was put somewhere instead of moving there.
        wheels: Its grip on the road; None for those without wheels.
    """

    spec: ActorSpec
    state: ActorState
    bound: LanePosition | None
    route: Route | None = None
    blocked: str | None = None
    jumped: bool = False
    wheels: Wheels | None = None
    _course: Course | None = None
    _home: LanePosition | None = None  # lane it returns to
    _way: Way | None = None
    _speed: Longitudinal | None = None
    _side: Lateral = field(default_factory=HoldOffset)
    _heading: float | None = None

    @property
    def limits(self) -> Limits:
        """What it can do on the road as it is."""
        limits = self.spec.limits
        return limits if self.wheels is None else held_by(limits, self.wheels.road)

    @property
    def tyres(self) -> Limits:
        """What tyres can do there."""
        return TYRES if self.wheels is None else held_by(TYRES, self.wheels.road)

    # --- commands -----------------------------------------------------------------------------

    def pursue_speed(self, command: Command | None) -> None:
        """Puts a longitudinal command to work; None holds the speed."""
        if command is None:
            self._speed = None
            return
        slips = self.wheels is not None and self.wheels.slipping
        now = self.state.a if slips else acceleration_of(self._speed, self.state)
        state = self.state._replace(a=now)
        self._speed = longitudinal_of(command, state, self.limits, self.route)

    def pursue_side(self, command: Command | None, road_map: RoadMap) -> None:
        """Puts a lateral command to work; None keeps the lane, or returns to one."""
        if self._way is not None:
            self.route, self._way = self._way.before, None
        if isinstance(command, FollowRoute):
            self._way = Way(command, road_map, self.route)
            self.route, command = self._way.route, KeepLane()
        course = course_of(command, self.state, self.limits)
        if course is not None:
            self._course, self.bound, self._home = course, None, None
            self._side = HoldOffset()
            return
        returned = self._course is not None
        if returned:
            self._course = None
            self._return_to_lane(road_map)
            if self.bound is not None and (command is None or isinstance(command, KeepLane)):
                return  # on its way to the middle of the lane
        if self._home is not None:
            held = command is None or isinstance(command, KeepLane)
            self._side = HoldOffset() if held else Impossible(f"{self.spec.id} is in no lane yet")
            return
        if self.bound is None:
            self._pursue_heading(command)
            return
        state = self.state
        here, rate = state.lane_position or self.bound, state.lateral_speed
        if returned:
            here, rate = self.bound, state.v * math.sin(self._turn_from(self.bound, road_map))
        self.bound, self._side = lateral_of(
            command,
            road_map,
            self.bound,
            here,
            (state.x, state.y, rate),
            self._side,
            self.limits,
        )

    def _pursue_heading(self, command: Command | None) -> None:
        self._heading = command.heading if isinstance(command, Turn) else None
        self._side = HoldOffset()
        if command is not None and not isinstance(command, KeepLane | Turn):
            self._side = Impossible(
                f"{self.spec.id} is not on a driving lane, so it cannot change or follow one"
            )

    def speed_progress(self) -> Progress:
        """Progress of the longitudinal command."""
        if self._hindrance is not None:
            return Progress(False, self._hindrance)
        progress = REACHED if self._speed is None else self._speed.progress()
        lags = self.wheels is not None and self.wheels.slipping
        return PENDING if lags and progress.done else progress

    @property
    def _hindrance(self) -> str | None:
        """Why it cannot go on; the end of the road is none for who wanted to go to it."""
        sliding = None if self.wheels is None else self.wheels.sliding
        arrived = self._way is not None and self._way.progress().done
        return sliding if arrived else self.blocked or sliding

    def side_progress(self) -> Progress:
        """Progress of the lateral command."""
        if self._hindrance is not None:
            return Progress(False, self._hindrance)
        if self._course is not None:
            return self._course.progress()
        if self._way is not None:
            return self._way.progress()
        lost = isinstance(self._side, Impossible)
        if self.bound is not None or self._home is not None or lost:
            return self._side.progress()
        turned = self._heading is None or abs(turn_between(self.state.h, self._heading)) < 1e-9
        return REACHED if turned else PENDING

    # --- motion -------------------------------------------------------------------------------

    def moved(self, senses: Senses, road_map: RoadMap) -> ActorState:
        """State at the next step; the snapshot itself stays as it is."""
        state, dt = self.state, senses.dt
        if self._course is not None and self._speed is None and state.v == 0.0:
            self.pursue_speed(SpeedChange(CRUISE.get(self.spec.kind, CRUISE_VEHICLE)))
        speed = state.v if self._speed is None else self._speed.speed_after(state, senses)
        if self.wheels is not None and self.wheels.limited:
            way = curvature_ahead(road_map, self.bound, self.route)
            speed = self.wheels.held(speed, state, way, dt)
        path = 0.5 * (state.v + speed) * dt
        self.jumped = False
        if self._home is not None:
            self._return_to_lane(road_map)
        if self.bound is not None:
            return self._along_lane(speed, path, road_map, senses)
        if self._course is not None:
            return self._on_course(self._course, speed, path, road_map, dt)
        if path == 0.0 and self._heading is None:
            return self._standing(speed, dt)
        return self._straight_on(speed, path, road_map, dt)

    def _along_lane(
        self, speed: float, path: float, road_map: RoadMap, senses: Senses
    ) -> ActorState:
        bound, dt = self.bound, senses.dt
        assert bound is not None
        offset, rate = self._side.offset_after(bound.offset, path, self.state, senses)
        aside = offset - bound.offset
        if path == 0.0 and aside == 0.0:
            return self._standing(speed, dt)
        along = path if aside == 0.0 else math.copysign(math.sqrt(max(path**2 - aside**2, 0)), path)
        if along:
            if self._way is not None:
                self._way.look(bound, along)
            ahead = road_map.advance(bound, along, self.route)
            place = ahead.position
            if abs(ahead.travelled - along) > 1e-6:
                speed = self._stop_at_end(place)
            else:
                self.blocked = None
        else:
            place = bound
        if offset != place.offset:
            place = LanePosition(place.road, place.lane, place.s, offset)
        self.bound = place
        return self._state_on_lane(place, speed, rate, (speed - self.state.v) / dt, road_map)

    def _standing(self, speed: float, dt: float) -> ActorState:
        """The same place; the same state if nothing else changes."""
        state, a = self.state, (speed - self.state.v) / dt
        if speed == state.v and a == state.a and state.lateral_speed == 0.0:
            return state
        return state._replace(v=speed, a=a, lateral_speed=0.0)

    def _stop_at_end(self, place: LanePosition) -> float:
        self.blocked = (
            f"{self.spec.id} has come to the end of lane {place.lane} of road {place.road}"
        )
        self._speed = None
        return 0.0

    def _state_on_lane(
        self, bound: LanePosition, speed: float, rate: float, a: float, road_map: RoadMap
    ) -> ActorState:
        pose = road_map.pose(bound)
        h = pose.h
        if rate and abs(speed) > _STILL:
            h += math.asin(min(max(rate / speed, -SIDEWAYS), SIDEWAYS))
            h = math.pi - (math.pi - h) % math.tau
        elif abs(speed) <= _STILL and self._half_way(bound):
            h = self.state.h  # standing half way through a lane change
        under = self._lane_under(bound, pose, road_map) if bound.offset else bound
        return ActorState(pose.x, pose.y, pose.z, h, speed, a, under, rate, self.spec.shape)

    def _half_way(self, bound: LanePosition) -> bool:
        return not self._side.progress().done and bound.road == self.state.road

    @staticmethod
    def _lane_under(bound: LanePosition, pose: Pose, road_map: RoadMap) -> LanePosition:
        """The lane under the reference point: beside the bound one during a lane change."""
        while True:
            half = 0.5 * road_map.lane_width(bound.road, bound.lane, bound.s)
            if abs(bound.offset) <= half:
                return bound
            beside = road_map.neighbour(bound, "left" if bound.offset > 0.0 else "right")
            if beside is None:
                return bound
            offset = offset_from(road_map, beside, pose.x, pose.y)
            if abs(offset) >= abs(bound.offset):
                return bound
            bound = LanePosition(beside.road, beside.lane, beside.s, offset)

    def _straight_on(self, speed: float, path: float, road_map: RoadMap, dt: float) -> ActorState:
        state = self.state
        h = state.h
        if self._home is not None:
            pose = self._towards_lane(self._home, path, road_map)
            return self.free_state(pose, speed, (speed - state.v) / dt, road_map)
        if self._heading is not None:
            turn = turn_between(h, self._heading)
            h += math.copysign(min(abs(turn), TURN_RATE * dt), turn)
            h = math.pi - (math.pi - h) % math.tau
        pose = Pose(state.x + path * math.cos(h), state.y + path * math.sin(h), state.z, h)
        return self.free_state(pose, speed, (speed - state.v) / dt, road_map)

    # --- courses off the lanes ----------------------------------------------------------------

    def _on_course(
        self, course: Course, speed: float, path: float, road_map: RoadMap, dt: float
    ) -> ActorState:
        state = self.state
        pose, speed = course.after(state, speed, path, dt)
        way = math.hypot(pose.x - state.x, pose.y - state.y)
        self.jumped = way > max(abs(path), abs(speed) * dt) + _NEAR
        return self.free_state(pose, speed, (speed - state.v) / dt, road_map)

    def _lane_near(self, road_map: RoadMap) -> LanePosition | None:
        """The driving lane to return to; None if there is none close by in this direction."""
        state = self.state
        if not self.spec.lane_bound:
            return None
        on = road_map.locate(state.x, state.y, state.z, state.h, max_distance=_BACK)
        if on is None or math.cos(self._turn_from(on, road_map)) <= 0.0:
            return None
        return LanePosition(on.road, on.lane, on.s)

    def _abreast(self, lane: LanePosition, road_map: RoadMap) -> LanePosition | None:
        """Where it is along a lane; None behind its end."""
        pose, state = road_map.pose(lane), self.state
        along = (state.x - pose.x) * math.cos(pose.h) + (state.y - pose.y) * math.sin(pose.h)
        step = road_map.advance(lane, along, self.route)
        return step.position if abs(step.travelled - along) < 1e-3 else None

    def _return_to_lane(self, road_map: RoadMap) -> None:
        """Is in its lane again if it stands in it and along it, else on the way there, if any."""
        state, home = self.state, self._home
        home = self._lane_near(road_map) if home is None else self._abreast(home, road_map)
        self._home = home
        if home is None:
            return
        turn = self._turn_from(home, road_map)
        offset = offset_from(road_map, home, state.x, state.y)
        inside = abs(offset) <= 0.5 * road_map.lane_width(home.road, home.lane, home.s)
        if inside and abs(turn) <= (_ALIGNED if state.v > 0.5 else 1e-3):
            rate = state.v * math.sin(turn)
            profile = shift_profile(offset, 0.0, rate, ("none", None, None), self.limits)
            self.bound = LanePosition(home.road, home.lane, home.s, offset)
            self._side, self._home = Shift(profile, 0.0), None

    def _turn_from(self, lane: LanePosition, road_map: RoadMap) -> float:
        return turn_between(road_map.pose(lane).h, self.state.h)

    def _towards_lane(self, home: LanePosition, path: float, road_map: RoadMap) -> Pose:
        """Steers at the centre of the lane, some way ahead."""
        state = self.state
        steering = Steering(state.shape, self.limits)
        ahead = road_map.advance(home, steering.look_ahead(state.v), self.route).position
        goal = road_map.pose(ahead)
        return steering.towards(state, goal.x, goal.y, path)

    def free_state(self, pose: Pose, speed: float, a: float, road_map: RoadMap) -> ActorState:
        """State off the lanes: where it is, and which lane is under it, if any."""
        hint = self.state.lane_position
        heading = pose.h if self.spec.lane_bound else None
        on = road_map.locate(
            pose.x, pose.y, pose.z, heading, hint=hint, lane_types=ANY_LANE, max_distance=_NEAR
        )
        z = pose.z if on is None else road_map.pose(on).z
        return ActorState(pose.x, pose.y, z, pose.h, speed, a, on, 0.0, self.spec.shape)

    def unbind(self) -> None:
        """Is on no lane any more, and goes straight on."""
        self.bound, self._course, self._home = None, None, None

    def rebind(self, bound: LanePosition, speed: float, road_map: RoadMap) -> ActorState:
        """State after a jump to a place on a lane."""
        self.bound, self.blocked = bound, None
        self._course, self._home = None, None
        self._side = HoldOffset()
        return self._state_on_lane(bound, speed, 0.0, 0.0, road_map)
