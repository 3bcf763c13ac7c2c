"""The motion of one actor over one step."""

from __future__ import annotations

import math
from dataclasses import field

from osc2tx_classes import dataclass
from osc2tx_runtime.opendrive import DRIVING, LaneCursor, LanePosition, Pose, RoadMap, Route
from osc2tx_runtime.opendrive.model import new_tuple

from .acceleration import AssignedSpeed
from .actor_dimensions import TYRES, Limits
from .attitude import LEVEL, Tilt, tilt_on
from .attitude_control import Turning
from .commands import SpeedChange, Standstill
from .cruise import Cruise
from .curve_following import Course, Steering
from .friction import held_by
from .friction_circle import Wheels, curvature_ahead
from .lane_neighbours import lane_under, offset_from
from .lane_return import abreast, lane_near, turn_from
from .lateral import (
    SIDEWAYS,
    HoldOffset,
    Lateral,
    Shift,
    shift_profile,
)
from .longitudinal import Longitudinal, ProfileRun, longitudinal_of
from .open_speed import OpenSpeed
from .position_control import PlacedRun
from .protocol import ActorSpec
from .route_following import Way
from .seam_smoothing import Residual, crossed
from .state import ActorState
from .step_inputs import StepInputs

__all__ = ["ALIGNED", "ANY_LANE", "CRUISE", "MovingActor", "cruise_of"]

CRUISE = {"person": 1.4, "animal": 1.4, "movable_object": 1.4}
"""Speed (m/s) at which those who stand set out on a course; vehicles: `CRUISE_VEHICLE`."""

CRUISE_VEHICLE = 5.0


def cruise_of(kind: str) -> float:
    """Speed (m/s) at which an actor of a kind sets out."""
    return CRUISE.get(kind, CRUISE_VEHICLE)


ANY_LANE = DRIVING | {
    "shoulder", "sidewalk", "walking", "biking", "parking", "border", "curb", "median", "stop",
    "restricted", "special1", "special2", "special3", "tram", "rail", "roadWorks",
}  # fmt: skip
"""Lane types on which actors off the lanes are located."""

_NEAR = 0.5  # m: how far outside a lane an actor is still on it
_STILL = 1e-9  # m/s
ALIGNED = 0.3  # rad to its lane with which a vehicle is in it again


@dataclass
class MovingActor:
    """An actor over its steps, with its commands at work.

    Attributes:
        spec: What it is.
        state: Snapshot of the present step: what all read of it.
        reference: State that its commands start from. The same, unless somebody measures the actor:
            then it keeps the speed and the place in the lane that were commanded, abreast of it.
        bound: Lane it follows, with its offset from there; None off the lanes.
        cursor: Goes along that lane with it.
        route: Decides at forks; None: the smallest change of heading.
        blocked: Why it cannot go on; None while it can.
        jumped: In the last step it was put somewhere instead of moving there.
        way: Metres that no corner of it moved more than in the last step; negative: nobody knows.
        wheels: Its grip on the road; None for those without wheels.
        tilt: Pitch and roll that it was told; wheels that roll forget them.
        left: Where it was in its lane before the last step.
        home: Lane that it returns to; None: it is in one, or goes to none.
        residual: What seams of the map have left it beside its lane; None: nothing.
        steady: What it is told cannot fail, and nothing was told since that was found.
        still: It stood in the last step, and stands on until it is upset.
        cruise: How it went in the last step, and goes on until it is upset; None: otherwise.
    """

    spec: ActorSpec
    state: ActorState
    reference: ActorState
    bound: LanePosition | None
    cursor: LaneCursor
    route: Route | None = None
    blocked: str | None = None
    jumped: bool = False
    way: float = -1.0
    wheels: Wheels | None = None
    tilt: Tilt = LEVEL
    left: LanePosition | None = None
    home: LanePosition | None = None
    residual: Residual | None = None
    steady: bool = False
    still: bool = False
    cruise: Cruise | None = None
    _stopping: Longitudinal | None = None  # behind the end of its lane
    _course: Course | None = None
    _way: Way | None = None
    _speed: Longitudinal | None = None
    _open: OpenSpeed = field(default_factory=OpenSpeed)  # while there is no command for it
    _side: Lateral = field(default_factory=HoldOffset)
    _turning: Turning | None = None
    _unphysical: set[str] = field(default_factory=set)  # slots in which physics need not hold
    _astray: bool = False  # turned where it stands, so that it is in no lane any more

    @property
    def limits(self) -> Limits:
        """What it can do on the road as it is."""
        limits = self.spec.limits
        return limits if self.wheels is None else held_by(limits, self.wheels.road)

    @property
    def tyres(self) -> Limits:
        """What tyres can do there."""
        return TYRES if self.wheels is None else held_by(TYRES, self.wheels.road)

    # --- motion -------------------------------------------------------------------------------

    def moved(self, inputs: StepInputs, road_map: RoadMap) -> ActorState:
        """State at the next step; the snapshot itself stays as it is."""
        state, dt = self.reference, inputs.dt
        self.still, self.cruise, self.way = False, None, -1.0
        if self._course is not None and self._speed is None and state.v == 0.0:
            setting_out = SpeedChange(cruise_of(self.spec.kind))
            self._speed = longitudinal_of(setting_out, state, self.limits, self.route)
        run = self._stopping or self._speed
        if run is None or isinstance(run, AssignedSpeed):
            speed = self._unsaid(inputs)
        else:
            speed = run.speed_after(state, inputs)
        path: float | None = self._speed.path if isinstance(self._speed, PlacedRun) else None
        if self.wheels is not None and self.wheels.road != "dry":
            way = curvature_ahead(road_map, self.bound, self.route)
            speed = self.wheels.held(speed, state, way, dt)
            path = None if self.wheels.slipping else path
        if path is None:
            path = 0.5 * (state.v + speed) * dt
        self.jumped = False
        if self.home is not None or self._astray:
            self._return_to_lane(road_map)
        if path and self.wheels is not None:
            self.tilt = LEVEL
        if self.bound is not None:
            return self._along_lane(speed, path, road_map, inputs)
        if self._course is not None:
            return self._on_course(self._course, speed, path, road_map, dt)
        if path == 0.0 and self._turning is None:
            return self._standing(speed, dt)
        return self._straight_on(speed, path, road_map, dt)

    def _unsaid(self, inputs: StepInputs) -> float:
        """Speed at the next step where no command says any."""
        state = self.reference
        if self.bound is None or self._unphysical or not state.shape.wheelbase or state.v <= 0.0:
            return state.v
        return self._open.speed_after(state, inputs, self.route, self.limits)

    def _along_lane(
        self, speed: float, path: float, road_map: RoadMap, inputs: StepInputs
    ) -> ActorState:
        bound, dt = self.bound, inputs.dt
        assert bound is not None
        self.left = bound
        offset, rate = self._side.offset_after(bound.offset, path, self.reference, inputs)
        aside = offset - bound.offset
        if path == 0.0 and aside == 0.0:
            return self._standing(speed, dt)
        along = path if aside == 0.0 else math.copysign(math.sqrt(max(path**2 - aside**2, 0)), path)
        if along:
            if self.residual is not None:
                along *= self.residual.share
            if self._way is not None:
                self._way.look(bound, along)
            on = self.cursor.moved(bound, along, offset)
            if on is None:
                ahead = road_map.advance(bound, along, self.route)
                on = ahead.position
                if abs(ahead.travelled - along) > 1e-6:
                    return self._over_the_end(on, along - ahead.travelled, speed, road_map, dt)
            place = on
            self.blocked = None
            if self.residual is not None or road_map.has_seams(bound, place):
                abreast_of = place._replace(offset=bound.offset)
                self._cross(abreast_of, along, speed, road_map)
        else:
            place = bound
        if offset != place.offset:
            place = LanePosition(place.road, place.lane, place.s, offset)
        self.bound = place
        state = self.on_lane(place, speed, rate, (speed - self.reference.v) / dt, road_map)
        if rate == 0.0 and self._goes_on(state):
            stretch = self.cursor.stretch(place)
            self.cruise = None if stretch is None else Cruise(place, stretch, path, state)
        return state

    def cruised(self) -> ActorState | None:
        """State at the next step of one who goes on as before; None if it may not."""
        cruise = self.cruise
        if cruise is None:
            return None
        state = cruise.after()
        if state is not None:
            self.left, self.bound, self.way = self.bound, state.lane_position, cruise.way
        return state

    def _standing(self, speed: float, dt: float) -> ActorState:
        """The same place; the same state if nothing else changes."""
        state, a = self.reference, (speed - self.reference.v) / dt
        if speed == state.v and a == state.a and state.lateral_speed == 0.0:
            self.still = self.home is None and self.residual is None and self._stays()
            self.way = 0.0
            return state
        return state._replace(v=speed, a=a, lateral_speed=0.0)

    def _stays(self) -> bool:
        """Whether one who stands does so until it is told something."""
        run = self._speed
        held = (
            run is None
            or isinstance(run, AssignedSpeed)
            or (isinstance(run, ProfileRun) and run.progress().done)
        )
        return held and self.is_steady() and isinstance(self._side, HoldOffset)

    def _goes_on(self, state: ActorState) -> bool:
        """Whether one who drives goes on as it has come to a state, until it is told something."""
        run, before = self._speed, self.reference
        return (
            type(run) is ProfileRun
            and state.v == before.v
            and state.lateral_speed == 0.0
            and abs(state.v) > _STILL
            and run.progress().done
            and self._side.progress().done
            and self.residual is None
            and self.is_steady()
        )

    def is_steady(self) -> bool:
        """Sees whether what it is told cannot fail."""
        raise NotImplementedError

    def _cross(self, place: LanePosition, along: float, speed: float, road_map: RoadMap) -> None:
        """Takes with it what the seams up to a place leave, and lets it run out."""
        bound = self.bound
        assert bound is not None
        if self.residual is not None and not self.residual.driven(along):
            self.residual = None
        self.residual = crossed(
            road_map, bound, place, self.residual, math.copysign(speed, along), self.limits.lateral
        )

    def _over_the_end(
        self, place: LanePosition, rest: float, speed: float, road_map: RoadMap, dt: float
    ) -> ActorState:
        """Goes straight on behind the end of its lane, and brakes there."""
        self.blocked = (
            f"{self.spec.id} has come to the end of lane {place.lane} of road {place.road}"
        )
        end = road_map.pose(place)
        if self.residual is not None:
            end = self.residual.on(end)
        self.unbind()
        self._stopping = longitudinal_of(
            Standstill(), self.reference._replace(v=speed), self.limits
        )
        pose = Pose(end.x + rest * math.cos(end.h), end.y + rest * math.sin(end.h), end.z, end.h)
        return self.free_state(pose, speed, (speed - self.reference.v) / dt, road_map)

    def on_lane(
        self, bound: LanePosition, speed: float, rate: float, a: float, road_map: RoadMap
    ) -> ActorState:
        """State at a place in its lane.

        Args:
            bound: The place.
            speed: m/s.
            rate: m/s to the left.
            a: m/s^2.
            road_map: The map.
        """
        pose = self.cursor.pose(bound)
        h, residual = pose.h, self.residual
        if residual is not None:
            pose = residual.on(pose)
            h += math.atan(residual.slope)
            bound = bound._replace(offset=bound.offset + residual.aside)
        if rate and abs(speed) > _STILL:
            h += math.asin(min(max(rate / speed, -SIDEWAYS), SIDEWAYS))
            h = math.pi - (math.pi - h) % math.tau
        elif abs(speed) <= _STILL and self._half_way(bound):
            h = self.reference.h  # standing half way through a lane change
        under = lane_under(road_map, bound, pose) if bound.offset else bound
        pitch = roll = 0.0
        if self.tilt is not LEVEL or pose.pitch or pose.roll:
            pitch, roll = self._tilted(pose, h)
        if residual is not None:
            h = math.pi - (math.pi - h) % math.tau
            rate += residual.drift(speed)
        shape = self.spec.shape
        return new_tuple(
            ActorState,
            (pose.x, pose.y, pose.z, h, speed, a, under, rate, shape, pitch, roll),
        )

    def _tilted(self, ground: Pose, heading: float) -> tuple[float, float]:
        """Pitch and roll on the ground, or as it was told."""
        if self.tilt is LEVEL and not (ground.pitch or ground.roll):
            return 0.0, 0.0  # nearly always
        return self.tilt.over(tilt_on(ground, heading))

    def _half_way(self, bound: LanePosition) -> bool:
        return not self._side.progress().done and bound.road == self.reference.road

    def _straight_on(self, speed: float, path: float, road_map: RoadMap, dt: float) -> ActorState:
        state = self.reference
        h = state.h
        if self.home is not None:
            pose = self._towards_lane(self.home, path, road_map)
            return self.free_state(pose, speed, (speed - state.v) / dt, road_map)
        if self._turning is not None:
            h, self.tilt = self._turning.after(state, self.tilt, dt)
        pose = Pose(state.x + path * math.cos(h), state.y + path * math.sin(h), state.z, h)
        return self.free_state(pose, speed, (speed - state.v) / dt, road_map)

    # --- courses off the lanes ----------------------------------------------------------------

    def _on_course(
        self, course: Course, speed: float, path: float, road_map: RoadMap, dt: float
    ) -> ActorState:
        state = self.reference
        pose, speed = course.after(state, speed, path, dt)
        way = math.hypot(pose.x - state.x, pose.y - state.y)
        self.jumped = way > max(abs(path), abs(speed) * dt) + _NEAR
        return self.free_state(pose, speed, (speed - state.v) / dt, road_map)

    def _return_to_lane(self, road_map: RoadMap) -> None:
        """Is in its lane again if it stands in it and along it, else on the way there, if any."""
        state, home, self._astray = self.reference, self.home, False
        if not self.spec.lane_bound:
            return
        if home is None:
            home = lane_near(road_map, state)
        else:
            home = abreast(road_map, home, state, self.route)
        self.home = home
        if home is None:
            return
        turn = turn_from(road_map, home, state)
        offset = offset_from(road_map, home, state.x, state.y)
        inside = abs(offset) <= 0.5 * road_map.lane_width(home.road, home.lane, home.s)
        if inside and abs(turn) <= (ALIGNED if state.v > 0.5 else 1e-3):
            rate = state.v * math.sin(turn)
            profile = shift_profile(offset, 0.0, rate, ("none", None, None), self.limits)
            self.bound = LanePosition(home.road, home.lane, home.s, offset)
            self._side, self.home = Shift(profile, 0.0), None

    def _towards_lane(self, home: LanePosition, path: float, road_map: RoadMap) -> Pose:
        """Steers at the centre of the lane, some way ahead."""
        state = self.reference
        steering = Steering(state.shape, self.limits)
        ahead = road_map.advance(home, steering.look_ahead(state.v), self.route).position
        goal = road_map.pose(ahead)
        return steering.towards(state, goal.x, goal.y, path)

    def lane_at(
        self, pose: Pose, hint: LanePosition | None, road_map: RoadMap
    ) -> LanePosition | None:
        """The lane under a place; None off the lanes."""
        heading = pose.h if self.spec.lane_bound else None
        return road_map.locate(
            pose.x, pose.y, pose.z, heading, hint=hint, lane_types=ANY_LANE, max_distance=_NEAR
        )

    def free_state(self, pose: Pose, speed: float, a: float, road_map: RoadMap) -> ActorState:
        """State off the lanes: where it is, and which lane is under it, if any."""
        on = self.lane_at(pose, self.reference.lane_position, road_map)
        ground = Pose(pose.x, pose.y, pose.z, pose.h) if on is None else road_map.pose(on)
        pitch, roll = self._tilted(ground, pose.h)
        return ActorState(
            pose.x, pose.y, ground.z, pose.h, speed, a, on, 0.0, self.spec.shape, pitch, roll
        )

    def unbind(self) -> None:
        """Is on no lane any more, and goes straight on."""
        self.bound, self._course, self.home = None, None, None
        self.residual, self._stopping = None, None
        self.upset()

    def upset(self) -> None:
        """Is told or befallen by something: how it goes on is to be found anew."""
        self.steady, self.still, self.cruise, self.way = False, False, None, -1.0

    def turn_away(self) -> None:
        """Is turned by force: a vehicle goes back to its lane from there."""
        self.unbind()
        self._astray = self.spec.lane_bound

    def rebind(self, bound: LanePosition, speed: float, road_map: RoadMap) -> ActorState:
        """State after a jump to a place on a lane."""
        self.bound, self.left, self.blocked, self.tilt = bound, None, None, LEVEL
        self._course, self.home, self._astray = None, None, False
        self.residual, self._stopping = None, None
        self.upset()
        self._side = HoldOffset()
        return self.on_lane(bound, speed, 0.0, 0.0, road_map)
