"""The world that needs no simulator: lane-bound actors on an OpenDRIVE map."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.opendrive import LanePosition, Pose, RoadMap, Route

from .actor_dimensions import Limits
from .actor_motion import Body
from .attitude import LEVEL, Tilt
from .commands import Command, Standstill
from .contacts import Contacts
from .couplings import Couplings
from .distances import along_lanes, lateral_on_road
from .features import FEATURES
from .friction import grip
from .friction_circle import Wheels
from .kinematics import Kinematics, Track
from .obstacles import nearest_ahead
from .projected_motion import projected
from .protocol import (
    LONGITUDINAL,
    ActorSpec,
    LightMode,
    LightState,
    Progress,
)
from .state import ActorState
from .state_changes import Wish
from .stop_lines_ahead import StopLine, StopLines
from .sun_and_moon import Sky
from .traffic_light_states import Signals
from .weather_effects import Lights, Surroundings

__all__ = ["EmbeddedWorld"]


class EmbeddedWorld:
    """Deterministic world with closed-form motion.

    Attributes:
        map: The road map.
        dt: Length of a step (s).
        signals: The traffic lights.
    """

    def __init__(self, road_map: RoadMap, dt: float = 0.05) -> None:
        self.map = road_map
        self.dt = dt
        self.signals = Signals(road_map)
        self._stop_lines = StopLines(road_map, self.signals)
        self._specs: dict[str, ActorSpec] = {}
        self._bodies: dict[str, Body] = {}
        self._wishes: dict[str, Wish] = {}
        self._couplings = Couplings()
        self._lights = Lights()
        self._surroundings = Surroundings(dt)
        self._track = Track()
        self._contacts = Contacts()

    # --- cast ---------------------------------------------------------------------------------

    def add(self, spec: ActorSpec) -> None:
        """Makes an actor known; it has a state from its placement on."""
        self._specs[spec.id] = spec

    def place(
        self,
        actor: str,
        at: LanePosition | Pose,
        speed: float | None = None,
        heading: float | None = None,
        tilt: Tilt = LEVEL,
        aside: float = 0.0,
    ) -> None:
        """Puts an actor somewhere before step 0.

        Lane-bound actors follow the lane if `at` is one; others, and those placed by a pose, go
        straight. With a heading (rad) against it they have to get into it first. `aside` is
        a lateral speed (m/s), which runs out if no command holds it.
        """
        spec = self._specs[actor]
        pose = self.map.pose(at) if isinstance(at, LanePosition) else at
        if heading is not None:
            pose = Pose(pose.x, pose.y, pose.z, heading)
        unplaced = ActorState(pose.x, pose.y, pose.z, pose.h, 0.0, 0.0, None, 0.0, spec.shape)
        body = Body(spec, unplaced, None)
        if spec.shape.wheelbase > 0.0:
            body.wheels = Wheels(self._surroundings.road)
        if spec.lane_bound and isinstance(at, LanePosition) and heading is None:
            body.state = body.rebind(at, speed or 0.0, self.map)
        else:
            if isinstance(at, LanePosition):
                body.turn_away()
            body.state = body.free_state(pose, speed or 0.0, 0.0, self.map)
        if aside:
            body.drift(aside, self.map)
        if tilt != LEVEL:
            body.tilt = tilt
            pitch, roll = tilt.over((body.state.pitch, body.state.roll))
            body.state = body.state._replace(pitch=pitch, roll=roll)
        self._bodies[actor] = body
        self._bodies = {each: self._bodies[each] for each in self._specs if each in self._bodies}
        self._lights.add(actor)
        self._contacts.begin({each: body.state for each, body in self._bodies.items()})

    def actors(self) -> tuple[str, ...]:
        """Ids of the placed actors in the order of the cast."""
        return tuple(self._bodies)

    def set_route(self, actor: str, route: Route | None) -> None:
        """Decides which branch the actor takes at forks."""
        self._body(actor).route = route

    # --- reading ------------------------------------------------------------------------------

    def state(self, actor: str) -> ActorState:
        """State of an actor at the present step."""
        body = self._bodies.get(actor)
        return self._body(actor).state if body is None else body.state

    def motion(self, actor: str) -> Kinematics:
        """Velocity and acceleration of an actor at the present step, in its own axes."""
        return self._track.of(actor, self.state(actor), self.dt)

    def projected(self, state: ActorState, seconds: float) -> ActorState:
        """Where an actor would be after some time if it went on in its lane at its speed."""
        return projected(self.map, state, seconds)

    def along(self, a: ActorState, b: ActorState) -> float | None:
        """Route distance (m) from a to b; None if not connected."""
        return along_lanes(self.map, a, b)

    def aside(self, a: ActorState, b: ActorState) -> float | None:
        """How far (m) b is left of a, across the lane of a; None if not connected."""
        return lateral_on_road(self.map, a, b)

    def obstacle(self, me: ActorState) -> tuple[float, float] | None:
        """Free metres to the nearest actor ahead in the way, and its speed (m/s) along it."""
        others = [body.state for body in self._bodies.values()]
        return nearest_ahead(self.map, me, others, self._surroundings.sight)

    def stop_line(self, me: ActorState, route: Route | None, reach: float) -> StopLine | None:
        """First line within so many metres at which a light asks to stop; None if none does."""
        place = me.lane_position
        if place is None or not self.signals.lit():
            return None
        sight = me.shape.front + self._surroundings.sight
        return self._stop_lines.ahead(place, route, me.shape.front, min(reach, sight))

    def grip(self, me: ActorState) -> float:
        """Largest acceleration (m/s^2) that the road can transmit to wheels in any direction."""
        return grip(self._surroundings.road)

    def limits(self, actor: str, *, of_vehicle: bool = True) -> Limits:
        """What an actor can do on the road as it is; without its own limits what tyres can."""
        body = self._body(actor)
        return body.limits if of_vehicle else body.tyres

    def progress(self, actor: str, slot: str) -> Progress:
        """Progress of the command in a slot."""
        body = self._body(actor)
        return body.speed_progress() if slot == LONGITUDINAL else body.side_progress()

    def lights(self, actor: str) -> LightState:
        """Lights at the present step."""
        return self._lights.of(actor)

    def environment(self) -> Mapping[str, float]:
        """Environment at the present step."""
        return self._surroundings.values

    def collisions(self) -> Sequence[tuple[str, str]]:
        """Pairs of actors (ids sorted) whose contact began during the last step, sorted."""
        return self._contacts.new

    def capabilities(self) -> frozenset[str]:
        """Names of the commands (classes) and other features the world carries out."""
        return FEATURES

    # --- writing ------------------------------------------------------------------------------

    def command(self, actor: str, slot: str, command: Command | None) -> None:
        """Sets what a slot pursues; None: hold the speed, keep the lane."""
        body = self._body(actor)
        if command is not None and self._couplings.is_towed(actor):
            raise ScenarioError(f"{actor} is towed, so it cannot move by itself")
        if slot == LONGITUDINAL:
            body.pursue_speed(command)
        else:
            body.pursue_side(command, self.map)

    def assign(
        self,
        actor: str,
        *,
        speed: float | None = None,
        at: LanePosition | Pose | None = None,
        heading: float | None = None,
        tilt: Tilt = LEVEL,
    ) -> None:
        """Changes a state at once; it can be seen from the next step on."""
        self._body(actor)
        before = self._wishes.get(actor, Wish())
        self._wishes[actor] = before.with_also(speed, at, heading, tilt)

    def attach(self, tow: str, trailer: str | None) -> None:
        """Couples a trailer to a vehicle, from the next step on; None uncouples what it tows."""
        before = self._couplings.attach(tow, trailer)
        if before is not None:
            self._body(before).pursue_speed(Standstill())
        if trailer is not None:
            self._body(trailer).unbind()

    def trailer_of(self, tow: str) -> str | None:
        """Id of the trailer that a vehicle tows."""
        return self._couplings.trailer_of(tow)

    def set_lights(self, actor: str, mode: LightMode) -> LightState:
        """Switches lights from the next step on; returns what they will be."""
        self._body(actor)
        return self._lights.switch(actor, mode, self._surroundings.automatic_light)

    def begin_under(self, sky: Sky) -> None:
        """Puts sun and moon where they stand at a place and time, before step 0."""
        self._surroundings.begin_under(sky)

    def set_environment(self, values: Mapping[str, float]) -> Mapping[str, LightState]:
        """Changes the environment from the next step on; returns the lights that switch."""
        self._surroundings.set(values)
        for body in self._bodies.values():
            if body.wheels is not None:
                body.wheels.road = self._surroundings.road
        return self._lights.follow(self._surroundings.automatic_light)

    # --- time ---------------------------------------------------------------------------------

    def step(self) -> None:
        """Goes from step k to k+1."""
        bodies = tuple(self._bodies.values())
        # All read the snapshot; none is replaced before every actor has moved.
        jumped = {actor for actor, wish in self._wishes.items() if wish.jumps}
        turned = {actor for actor, wish in self._wishes.items() if wish.turns}
        before = {actor: body.state for actor, body in self._bodies.items()}
        states = [self._next_state(body) for body in bodies]
        self._couplings.draw(self._bodies, states, self.dt, self.map)
        for body, state in zip(bodies, states, strict=True):
            body.state = state
            if body.jumped:
                jumped.add(body.spec.id)
        self._track.add(before, frozenset(jumped | turned))
        self._contacts.step(before, states, jumped, self._couplings.pairs())
        self._lights.step()
        self._surroundings.step()
        if self._surroundings.sky is not None:
            self._lights.follow(self._surroundings.automatic_light)
        self.signals.step()

    def _next_state(self, body: Body) -> ActorState:
        if self._couplings.is_towed(body.spec.id):
            return body.state  # what tows it draws it along
        wish = self._wishes.pop(body.spec.id, None)
        if wish is not None:
            return wish.carried_out(body, self, self.map)
        return body.moved(self, self.map) if body.spec.movable else body.state

    def _body(self, actor: str) -> Body:
        body = self._bodies.get(actor)
        if body is None:
            raise ScenarioError(f"{actor} is not placed in the world")
        return body
