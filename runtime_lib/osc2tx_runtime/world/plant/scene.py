"""The task of a plant in one step: states of the actors, lights, weather, signals."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from osc2tx_runtime.opendrive import LanePosition, Pose, RoadMap, Route
from osc2tx_runtime.world.actor_dimensions import Limits
from osc2tx_runtime.world.grip.friction import ADHESION, RoadCondition
from osc2tx_runtime.world.motion.actor_motion import CommandedActor
from osc2tx_runtime.world.motion.couplings import Couplings
from osc2tx_runtime.world.protocol import ActorSpec, LightState, Note
from osc2tx_runtime.world.state import ActorState
from osc2tx_runtime.world.surroundings.traffic_light_states import Signals

from .weather_effects import Lights, Surroundings

_SLOW = 1.0  # m/s: slower actors look ahead as at this speed


def pose_ahead(member: CommandedActor, state: ActorState, way: float, road_map: RoadMap) -> Pose:
    """The position of an actor after a distance (m) of its commanded motion.

    Args:
        member: The actor, whose commands have reached `state`.
        state: Start of the distance.
        way: Metres along its path; negative: backwards.
        road_map: The map.
    """
    if member.bound is not None:
        return _along_lane(member, member.bound, state, way, road_map)
    ahead = member.course_ahead(way)
    if ahead is not None:
        return ahead
    if member.home is not None:
        on = road_map.advance(member.home, way, member.route)
        return _straight(road_map.pose(on.position), way - on.travelled)
    return _straight(Pose(state.x, state.y, state.z, state.h), way)


def _along_lane(
    member: CommandedActor, lane: LanePosition, state: ActorState, way: float, road_map: RoadMap
) -> Pose:
    on = road_map.advance(lane, way, member.route)
    place = on.position
    seconds = abs(way) / max(abs(state.v), _SLOW)
    offset = member.offset_after(seconds, state.lateral_speed) if way > 0.0 else lane.offset
    pose = road_map.pose(LanePosition(place.road, place.lane, place.s, offset))
    return _straight(pose, way - on.travelled)


def _straight(pose: Pose, way: float) -> Pose:
    if abs(way) < 1e-6:
        return pose
    x, y = pose.x + way * math.cos(pose.h), pose.y + way * math.sin(pose.h)
    return pose._replace(x=x, y=y)


class Setpoint:
    """The command of one actor in a step.

    Attributes:
        spec: Its description.
        now: Its state at the start of the step.
        state: Its commanded state at the end.
        jumps: Whether it is teleported there.
        kicked: Whether its speed is set instantly (`assign_speed`).
        towed: Whether it is towed, and so follows exactly.
        route: Decides at forks; None: the smallest change of heading.
    """

    def __init__(
        self,
        member: CommandedActor,
        state: ActorState,
        road_map: RoadMap,
        *,
        jumps: bool,
        kicked: bool,
        towed: bool,
    ) -> None:
        self.spec: ActorSpec = member.spec
        self.now = member.state
        self.state = state
        self.jumps, self.kicked, self.towed = jumps, kicked, towed
        self.route: Route | None = member.route
        self._member = member
        self._map = road_map

    @property
    def limits(self) -> Limits:
        """Its limits on the present road."""
        return self._member.limits

    @property
    def changes_lane(self) -> bool:
        """Whether it follows another lane than the one below it."""
        bound, below = self._member.bound, self.state.lane_position
        if bound is None or below is None:
            return False
        return (bound.road, bound.lane) != (below.road, below.lane)

    def ahead(self, way: float) -> Pose:
        """Position on its path at a distance (m) from `state`; negative: behind it."""
        return pose_ahead(self._member, self.state, way, self._map)


class Scene:
    """A commanded step; its attributes describe the present step.

    Attributes:
        map: The road map.
        dt: Length of a step (s).
        step: Number of the commanded step; 0 before the first one.
        signals: The traffic lights. `states(id)` is the commanded state of a light; `lit()` lists
            the lights that the scenario has switched, `observe` notes states of the simulator.
    """

    def __init__(
        self,
        road_map: RoadMap,
        dt: float,
        signals: Signals,
        lights: Lights,
        surroundings: Surroundings,
        couplings: Couplings,
    ) -> None:
        self.map, self.dt, self.step = road_map, dt, 0
        self.signals = signals
        self._lights, self._surroundings, self._couplings = lights, surroundings, couplings
        self._members: Sequence[CommandedActor] = ()
        self._commanded: Sequence[ActorState] = ()
        self._jumped: frozenset[str] | set[str] = frozenset()
        self._kicked: frozenset[str] | set[str] = frozenset()
        self._setpoints: Mapping[str, Setpoint] | None = None
        self._notes: list[Note] = []
        self._warnings: dict[str, None] = {}

    def command(
        self,
        members: Sequence[CommandedActor],
        states: Sequence[ActorState],
        jumped: frozenset[str] | set[str],
        kicked: frozenset[str] | set[str],
    ) -> None:
        """Sets the commands of the actors for the next step."""
        self._members, self._commanded = members, states
        self._jumped, self._kicked = jumped, kicked
        self._setpoints = None

    @property
    def setpoints(self) -> Mapping[str, Setpoint]:
        """The command of each actor, in the order of the cast."""
        if self._setpoints is None:  # never read in the embedded world
            self._setpoints = self._make_setpoints()
        return self._setpoints

    def _make_setpoints(self) -> Mapping[str, Setpoint]:
        return {
            member.spec.id: Setpoint(
                member,
                state,
                self.map,
                jumps=member.spec.id in self._jumped,
                kicked=member.spec.id in self._kicked,
                towed=self._couplings.is_towed(member.spec.id),
            )
            for member, state in zip(self._members, self._commanded, strict=True)
        }

    @property
    def lights(self) -> Mapping[str, LightState]:
        """Commanded lights of the vehicles."""
        return self._lights.all

    @property
    def environment(self) -> Mapping[str, float]:
        """Commanded weather and sun, SI units; only stated values."""
        return self._surroundings.values

    @property
    def road(self) -> RoadCondition:
        """Condition of the roads."""
        return self._surroundings.road

    @property
    def adhesion(self) -> float:
        """Coefficient of friction of the roads, where a dry one counts as 1."""
        return ADHESION.get(self._surroundings.road, 1.0)

    def note(self, kind: str, **values: Any) -> None:
        """Writes a line into the trace at the end of this step."""
        self._notes.append((kind, values))

    def note_jack_knife(self, tow: str, trailer: str, angle: float) -> None:
        """Reports a jack-knifed trailer with its angle (rad)."""
        degrees, time = round(math.degrees(angle), 1), self.step * self.dt
        self.note("jack_knife", actor=trailer, tow=tow, angle=degrees)
        self.warn(f"{trailer} jackknifes at {time:.2f} s: its angle to {tow} is {degrees:g}°")

    def warn(self, text: str) -> None:
        """Warns once about an impossible command; the run continues."""
        self._warnings[text] = None

    def warnings(self) -> tuple[str, ...]:
        """The warnings of `warn`, in order."""
        return tuple(self._warnings)

    def take_notes(self) -> Sequence[Note]:
        """Returns the notes since the last call."""
        notes, self._notes = self._notes, []
        return notes
