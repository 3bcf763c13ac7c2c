"""The motion of one actor over one step."""

from __future__ import annotations

import math

from osc2tx_runtime.opendrive import LanePosition, Pose, RoadMap
from osc2tx_runtime.opendrive.geometry import wrap
from osc2tx_runtime.opendrive.model import new_tuple
from osc2tx_runtime.world.commands import SpeedChange, Standstill
from osc2tx_runtime.world.geometry.attitude import LEVEL
from osc2tx_runtime.world.geometry.lane_neighbours import lane_under
from osc2tx_runtime.world.geometry.seam_smoothing import crossed
from osc2tx_runtime.world.grip.friction import curvature_ahead
from osc2tx_runtime.world.lateral.execution import SIDEWAYS, HoldOffset
from osc2tx_runtime.world.longitudinal.acceleration import ConstantAcceleration
from osc2tx_runtime.world.longitudinal.execution import ProfileRun, longitudinal_of
from osc2tx_runtime.world.longitudinal.position_control import PlacedRun
from osc2tx_runtime.world.state import ActorState
from osc2tx_runtime.world.step_inputs import StepInputs
from osc2tx_shared.classes import dataclass

from .cruise import Cruise
from .moving_body import STILL, MovingBody, cruise_of


@dataclass
class MovingActor(MovingBody):
    """An actor that moves step by step, along its lane if it has one."""

    def moved(self, inputs: StepInputs, road_map: RoadMap) -> ActorState:
        """State at the next step; the snapshot is unchanged."""
        state, dt = self.reference, inputs.dt
        self.still, self.cruise, self.way = False, None, -1.0
        if self._course is not None and self._speed is None and state.v == 0.0:
            setting_out = SpeedChange(cruise_of(self.spec.kind))
            self._speed = longitudinal_of(setting_out, state, self.limits, self.route)
        run = self._stopping or self._speed
        speed = state.v if run is None else run.speed_after(state, inputs)
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
        """State at the next step of an actor in unchanged motion; None if its motion may change."""
        cruise = self.cruise
        if cruise is None:
            return None
        state = cruise.after()
        if state is not None:
            self.left, self.bound, self.way = self.bound, state.lane_position, cruise.way
        return state

    def _standing(self, speed: float, dt: float) -> ActorState:
        """The state at standstill; the same object if nothing changes."""
        state, a = self.reference, (speed - self.reference.v) / dt
        if speed == state.v and a == state.a and state.lateral_speed == 0.0:
            self.still = self.home is None and self.residual is None and self._stays()
            self.way = 0.0
            return state
        return state._replace(v=speed, a=a, lateral_speed=0.0)

    def _stays(self) -> bool:
        """Whether an actor at standstill remains there until a new command."""
        run = self._speed
        held = (
            run is None
            or (isinstance(run, ConstantAcceleration) and run.is_even)
            or (isinstance(run, ProfileRun) and run.progress().done)
        )
        return held and self.is_steady() and isinstance(self._side, HoldOffset)

    def _goes_on(self, state: ActorState) -> bool:
        """Whether a driving actor keeps its present motion until a new command."""
        run, before = self._speed, self.reference
        return (
            type(run) is ProfileRun
            and state.v == before.v
            and state.lateral_speed == 0.0
            and abs(state.v) > STILL
            and run.progress().done
            and self._side.progress().done
            and self.residual is None
            and self.is_steady()
        )

    def is_steady(self) -> bool:
        """Returns whether its commands cannot fail."""
        raise NotImplementedError

    def _cross(self, place: LanePosition, along: float, speed: float, road_map: RoadMap) -> None:
        """Adds the offset of the seams up to a position, and lets it decay."""
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
        """Continues straight beyond the end of its lane, and brakes there."""
        self.blocked = (
            f"{self.spec.id} has reached the end of lane {place.lane} of road {place.road}"
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
        """State at a position in its lane.

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
        if rate and abs(speed) > STILL:
            h += math.asin(min(max(rate / speed, -SIDEWAYS), SIDEWAYS))
            h = wrap(h)
        elif abs(speed) <= STILL and self._half_way(bound):
            h = self.reference.h  # standstill within a lane change
        under = lane_under(road_map, bound, pose) if bound.offset else bound
        pitch = roll = 0.0
        if self.tilt is not LEVEL or pose.pitch or pose.roll:
            pitch, roll = self._tilted(pose, h)
        if residual is not None:
            h = wrap(h)
            rate += residual.drift(speed)
        shape = self.spec.shape
        return new_tuple(
            ActorState,
            (pose.x, pose.y, pose.z, h, speed, a, under, rate, shape, pitch, roll),
        )

    def _half_way(self, bound: LanePosition) -> bool:
        return not self._side.progress().done and bound.road == self.reference.road

    def rebind(self, bound: LanePosition, speed: float, road_map: RoadMap) -> ActorState:
        """State after a teleport to a position on a lane."""
        self.bound, self.left, self.blocked, self.tilt = bound, None, None, LEVEL
        self._course, self.home, self._astray = None, None, False
        self.residual, self._stopping = None, None
        self.upset()
        self._side = HoldOffset()
        return self.on_lane(bound, speed, 0.0, 0.0, road_map)
