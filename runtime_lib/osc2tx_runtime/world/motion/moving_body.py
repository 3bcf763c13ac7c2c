"""The state of an actor between two steps, and its motion off the lanes."""

from __future__ import annotations

import math
from dataclasses import field

from osc2tx_runtime.opendrive import DRIVING, LaneCursor, LanePosition, Pose, RoadMap, Route
from osc2tx_runtime.world.actor_dimensions import TYRES, Limits
from osc2tx_runtime.world.geometry.attitude import LEVEL, Tilt, tilt_on
from osc2tx_runtime.world.geometry.lane_neighbours import offset_from
from osc2tx_runtime.world.geometry.lane_return import abreast, lane_near, turn_from
from osc2tx_runtime.world.geometry.seam_smoothing import Residual
from osc2tx_runtime.world.grip.friction import Wheels, held_by
from osc2tx_runtime.world.lateral.attitude_control import Turning
from osc2tx_runtime.world.lateral.curve_following import Course, Steering
from osc2tx_runtime.world.lateral.execution import (
    HEADING_LIMIT,
    HoldOffset,
    Impossible,
    Lateral,
    Shift,
    shift_profile,
)
from osc2tx_runtime.world.lateral.route_following import Way
from osc2tx_runtime.world.longitudinal.execution import Longitudinal
from osc2tx_runtime.world.motion.cruise import Cruise
from osc2tx_runtime.world.protocol import ActorSpec
from osc2tx_runtime.world.state import ActorState
from osc2tx_shared.classes import dataclass

CRUISE = {"person": 1.4, "animal": 1.4, "movable_object": 1.4}
"""Speed (m/s) at which actors at standstill start on a course; vehicles: `CRUISE_VEHICLE`."""

CRUISE_VEHICLE = 5.0


def cruise_of(kind: str) -> float:
    """Speed (m/s) at which an actor of a kind starts."""
    return CRUISE.get(kind, CRUISE_VEHICLE)


ANY_LANE = DRIVING | {
    "shoulder", "sidewalk", "walking", "biking", "parking", "border", "curb", "median", "stop",
    "restricted", "special1", "special2", "special3", "tram", "rail", "roadWorks",
}  # fmt: skip
"""Lane types on which actors off the lanes are located."""

_NEAR = 0.5  # m outside a lane within which an actor is still on it
STILL = 1e-9  # m/s
ALIGNED = 0.3  # rad: a vehicle with a smaller angle to its lane is in it again


@dataclass
class MovingBody:
    """The state of an actor from one step to the next, with the execution of its commands.

    Attributes:
        spec: Its description.
        state: Snapshot of the present step, for all readers.
        reference: State that its commands start from. The same, unless the actor is measured: then
            it keeps the commanded speed and lateral position, abreast of the actor.
        bound: Lane it follows, with its offset from there; None off the lanes.
        cursor: The cursor on that lane.
        route: Decides at forks; None: the smallest change of heading.
        blocked: Why it cannot continue; None while it can.
        jumped: Whether it was teleported in the last step.
        way: Upper bound of the distance (m) that its corners moved in the last step; negative:
            unknown.
        wheels: Its grip on the road; None without wheels.
        tilt: Commanded pitch and roll; rolling wheels reset them.
        left: Its position in its lane before the last step.
        home: Lane that it returns to; None: none.
        residual: Its remaining offset from seams of the map; None: nothing.
        steady: Whether its commands cannot fail, and are unchanged since this was found.
        still: Whether it was at standstill in the last step, and remains so until it is upset.
        cruise: Its motion in the last step, which continues until it is upset; None: otherwise.
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
    _stopping: Longitudinal | None = None  # beyond the end of its lane
    _course: Course | None = None
    _way: Way | None = None
    _speed: Longitudinal | None = None
    _side: Lateral = field(default_factory=HoldOffset)
    _turning: Turning | None = None
    _unphysical: set[str] = field(default_factory=set)  # slots in which physics need not hold
    _astray: bool = False  # turned at standstill, so that it is no longer in a lane

    @property
    def limits(self) -> Limits:
        """Its limits on the present road."""
        limits = self.spec.limits
        return limits if self.wheels is None else held_by(limits, self.wheels.road)

    @property
    def tyres(self) -> Limits:
        """The limits of tyres there."""
        return TYRES if self.wheels is None else held_by(TYRES, self.wheels.road)

    def _tilted(self, ground: Pose, heading: float) -> tuple[float, float]:
        """Pitch and roll of the ground, or as commanded."""
        if self.tilt is LEVEL and not (ground.pitch or ground.roll):
            return 0.0, 0.0  # nearly always
        return self.tilt.over(tilt_on(ground, heading))

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

    def _return_to_lane(self, road_map: RoadMap, *, at_angle: bool = False) -> None:
        """Rejoins its lane if it is in it and aligned with it, else moves towards it, if any.

        Args:
            road_map: The map.
            at_angle: Whether it has to keep an angle to its lane.
        """
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
        most = ALIGNED if state.v > 0.5 else 1e-3
        if inside and abs(turn) <= (HEADING_LIMIT if at_angle else most):
            rate = state.v * math.sin(turn)
            profile = shift_profile(offset, 0.0, rate, ("none", None, None), self.limits)
            self.bound = LanePosition(home.road, home.lane, home.s, offset)
            self.home = None
            if not isinstance(self._side, Impossible):  # still to be reported
                self._side = Shift(profile, 0.0)

    def _towards_lane(self, home: LanePosition, path: float, road_map: RoadMap) -> Pose:
        """Steers towards the lane centre ahead."""
        state = self.reference
        steering = Steering(state.shape, self.limits)
        ahead = road_map.advance(home, steering.look_ahead(state.v), self.route).position
        goal = road_map.pose(ahead)
        return steering.towards(state, goal.x, goal.y, path)

    def lane_at(
        self, pose: Pose, hint: LanePosition | None, road_map: RoadMap
    ) -> LanePosition | None:
        """The lane under a position; None off the lanes."""
        heading = pose.h if self.spec.lane_bound else None
        return road_map.locate(
            pose.x, pose.y, pose.z, heading, hint=hint, lane_types=ANY_LANE, max_distance=_NEAR
        )

    def free_state(self, pose: Pose, speed: float, a: float, road_map: RoadMap) -> ActorState:
        """State off the lanes: its pose, and the lane under it, if any."""
        on = self.lane_at(pose, self.reference.lane_position, road_map)
        ground = Pose(pose.x, pose.y, pose.z, pose.h) if on is None else road_map.pose(on)
        pitch, roll = self._tilted(ground, pose.h)
        return ActorState(
            pose.x, pose.y, ground.z, pose.h, speed, a, on, 0.0, self.spec.shape, pitch, roll
        )

    def unbind(self) -> None:
        """Leaves its lane, and continues straight."""
        self.bound, self._course, self.home = None, None, None
        self.residual, self._stopping = None, None
        self.upset()

    def upset(self) -> None:
        """Notes a command or a disturbance: its further motion is computed anew."""
        self.steady, self.still, self.cruise, self.way = False, False, None, -1.0

    def turn_away(self) -> None:
        """Turns it instantly: a vehicle then returns to its lane."""
        self.unbind()
        self._astray = self.spec.lane_bound
