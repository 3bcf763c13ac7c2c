"""The world that needs no simulator: lane-bound actors on an OpenDRIVE map."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.opendrive import LanePosition, Pose, RoadMap, Route

from .catalogue import Limits
from .collision import Box, box_of, swept_contacts
from .commands import Command, Standstill
from .distances import along_lanes, lateral_on_road
from .environment import Lights, Surroundings
from .friction import grip
from .motion import Body
from .obstacles import nearest_ahead
from .protocol import (
    LONGITUDINAL,
    ActorSpec,
    LightMode,
    LightState,
    Progress,
)
from .signals import Signals
from .state import ActorState
from .stop_lines import StopLine, StopLines
from .towing import drawn
from .tracking import projected
from .wheels import Wheels

__all__ = ["EmbeddedWorld"]

_CAPABILITIES = frozenset(
    {
        "Accelerate",
        "AccelerationChange",
        "Arrive",
        "Beside",
        "Careful",
        "FollowCourse",
        "FollowRoute",
        "FollowSpeed",
        "KeepGap",
        "KeepLane",
        "KeepSchedule",
        "LaneChange",
        "LaneOffset",
        "ReplayCourse",
        "ReplayTrajectory",
        "Sideways",
        "Slant",
        "SpeedChange",
        "Standstill",
        "Turn",
        "assign_orientation",
        "assign_position",
        "assign_speed",
        "collisions",
        "environment",
        "lights",
        "signals",
        "trailers",
    }
)


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
        self._boxes: list[Box] = []
        self._assigned: dict[str, dict[str, float | LanePosition | Pose]] = {}
        self._towed: dict[str, str] = {}  # towing vehicle to trailer
        self._lights = Lights()
        self._surroundings = Surroundings()
        self._touching: frozenset[tuple[int, int]] = frozenset()
        self._collisions: tuple[tuple[str, str], ...] = ()

    # --- cast ---------------------------------------------------------------------------------

    def add(self, spec: ActorSpec) -> None:
        """Makes an actor known; it has a state from its placement on."""
        self._specs[spec.id] = spec

    def place(
        self, actor: str, at: LanePosition | Pose, speed: float = 0.0, heading: float | None = None
    ) -> None:
        """Puts an actor somewhere before step 0.

        Lane-bound actors follow the lane if `at` is one; others, and those placed by a pose, go
        straight. `heading` (rad) turns an actor that is not lane-bound.
        """
        spec = self._specs[actor]
        pose = self.map.pose(at) if isinstance(at, LanePosition) else at
        if heading is not None:
            pose = Pose(pose.x, pose.y, pose.z, heading)
        unplaced = ActorState(pose.x, pose.y, pose.z, pose.h, 0.0, 0.0, None, 0.0, spec.shape)
        body = Body(spec, unplaced, None)
        if spec.shape.wheelbase > 0.0:
            body.wheels = Wheels(self._surroundings.road)
        if spec.lane_bound and isinstance(at, LanePosition):
            body.state = body.rebind(at, speed, self.map)
        else:
            body.state = body.free_state(pose, speed, 0.0, self.map)
        self._bodies[actor] = body
        self._bodies = {each: self._bodies[each] for each in self._specs if each in self._bodies}
        self._lights.add(actor)
        self._boxes = [box_of(each.state) for each in self._bodies.values()]

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
        return self._collisions

    def capabilities(self) -> frozenset[str]:
        """Names of the commands (classes) and other features the world carries out."""
        return _CAPABILITIES

    # --- writing ------------------------------------------------------------------------------

    def command(self, actor: str, slot: str, command: Command | None) -> None:
        """Sets what a slot pursues; None: hold the speed, keep the lane."""
        body = self._body(actor)
        if command is not None and actor in self._towed.values():
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
    ) -> None:
        """Changes a state at once; it can be seen from the next step on."""
        self._body(actor)
        wishes = self._assigned.setdefault(actor, {})
        for name, value in (("speed", speed), ("at", at), ("heading", heading)):
            if value is not None:
                wishes[name] = value

    def attach(self, tow: str, trailer: str | None) -> None:
        """Couples a trailer to a vehicle, from the next step on; None uncouples what it tows."""
        before = self._towed.pop(tow, None)
        if before is not None:
            self._body(before).pursue_speed(Standstill())
        if trailer is not None:
            self._body(trailer).unbind()
            self._towed[tow] = trailer

    def trailer_of(self, tow: str) -> str | None:
        """Id of the trailer that a vehicle tows."""
        return self._towed.get(tow)

    def set_lights(self, actor: str, mode: LightMode) -> LightState:
        """Switches lights from the next step on; returns what they will be."""
        self._body(actor)
        return self._lights.switch(actor, mode, self._surroundings.automatic_light)

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
        jumped = {actor for actor, wishes in self._assigned.items() if "at" in wishes}
        states = [self._next_state(body) for body in bodies]
        if self._towed:
            self._draw_trailers(states)
        boxes = []
        for i, (body, state) in enumerate(zip(bodies, states, strict=True)):
            boxes.append(self._boxes[i] if state is body.state else box_of(state))
            body.state = state
            if body.jumped or body.spec.id in jumped:
                self._boxes[i] = boxes[i]  # a jump touches nothing on its way
        self._find_collisions(boxes)
        self._boxes = boxes
        self._lights.step()
        self._surroundings.step()
        self.signals.step()

    def _draw_trailers(self, states: list[ActorState]) -> None:
        """Puts trailers behind the new states of what tows them, the foremost first."""
        place = {actor: i for i, actor in enumerate(self._bodies)}
        waiting = [tow for tow in self._towed if tow not in self._towed.values()]
        for tow in waiting:
            trailer = self._towed[tow]
            body, new = self._bodies[trailer], states[place[tow]]
            pose, speed = drawn(body.state, new, self._bodies[tow].state, self.dt)
            a = (speed - body.state.v) / self.dt
            states[place[trailer]] = body.free_state(pose, speed, a, self.map)
            if trailer in self._towed:
                waiting.append(trailer)

    def _next_state(self, body: Body) -> ActorState:
        if self._towed and body.spec.id in self._towed.values():
            return body.state  # `_draw_trailers` moves it
        wishes = self._assigned.pop(body.spec.id, None) if self._assigned else None
        if wishes is None:
            return body.moved(self, self.map) if body.spec.movable else body.state
        speed, at, heading = (wishes.get(name) for name in ("speed", "at", "heading"))
        if isinstance(speed, float):
            body.pursue_speed(None)
        if at is None and heading is None:
            state = body.moved(self, self.map)
        elif isinstance(at, LanePosition) and body.spec.lane_bound:
            state = body.rebind(at, body.state.v, self.map)
        else:
            state = self._jump(body, at, heading)
        return state._replace(v=speed, a=0.0) if isinstance(speed, float) else state

    def _jump(self, body: Body, at: object, heading: object) -> ActorState:
        state = body.state
        pose = Pose(state.x, state.y, state.z, state.h)
        if isinstance(at, LanePosition):
            pose = self.map.pose(at)
        elif isinstance(at, Pose):
            pose = at
            body.unbind()
        if isinstance(heading, float):
            pose = Pose(pose.x, pose.y, pose.z, heading)
        return body.free_state(pose, state.v, 0.0, self.map)

    def _find_collisions(self, boxes: list[Box]) -> None:
        ids = tuple(self._bodies)
        touching = swept_contacts(self._boxes, boxes)
        before = self._touching | {
            (min(ids.index(one), ids.index(two)), max(ids.index(one), ids.index(two)))
            for one, two in self._towed.items()  # coupled ones may touch
        }
        self._collisions = tuple(
            sorted(
                (min(ids[i], ids[j]), max(ids[i], ids[j]))
                for i, j in touching
                if (i, j) not in before
            )
        )
        self._touching = frozenset(touching)

    def _body(self, actor: str) -> Body:
        body = self._bodies.get(actor)
        if body is None:
            raise ScenarioError(f"{actor} is not placed in the world")
        return body
