"""The world: actors on an OpenDRIVE map, moved in closed form or by the plant of a simulator."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.opendrive import LanePosition, Pose, RoadMap, Route
from osc2tx_runtime.world.checks.values import in_words, problem_of
from osc2tx_runtime.world.geometry.attitude import LEVEL, Tilt
from osc2tx_runtime.world.grip.friction import GRAVITY, adhesion_of, grip
from osc2tx_runtime.world.grip.overload import Overload
from osc2tx_runtime.world.longitudinal.bends_ahead import BendsAhead
from osc2tx_runtime.world.measuring.contacts import Contacts
from osc2tx_runtime.world.measuring.deviation import Deviation
from osc2tx_runtime.world.measuring.distances import along_lanes, lateral_on_road
from osc2tx_runtime.world.measuring.kinematics import Motion, Track
from osc2tx_runtime.world.measuring.obstacles import nearest_ahead
from osc2tx_runtime.world.measuring.projected_motion import projected
from osc2tx_runtime.world.motion.actor_motion import CommandedActor
from osc2tx_runtime.world.motion.couplings import Couplings
from osc2tx_runtime.world.motion.feasibility import FrictionWatch
from osc2tx_runtime.world.motion.starts import Start, placed
from osc2tx_runtime.world.motion.state_changes import StateChange
from osc2tx_runtime.world.plant.anchoring import arrive
from osc2tx_runtime.world.plant.plant import CheckedPlant, Identity, Plant
from osc2tx_runtime.world.plant.scene import Scene
from osc2tx_runtime.world.plant.weather_effects import Lights, Surroundings
from osc2tx_runtime.world.step_inputs import Outlook
from osc2tx_runtime.world.surroundings.stop_lines_ahead import StopLine, StopLines
from osc2tx_runtime.world.surroundings.sun_and_moon import Sky
from osc2tx_runtime.world.surroundings.traffic_light_states import Signals
from osc2tx_shared.classes import replace
from osc2tx_shared.steps import DEFAULT_STEP

from .actor_dimensions import Limits
from .commands import Command, Standstill
from .protocol import (
    EXTERNAL,
    ActorSpec,
    ControlMode,
    Feature,
    LightMode,
    LightState,
    Note,
    Progress,
)
from .state import ActorState

NOBODY: frozenset[str] = frozenset()


class EmbeddedWorld:
    """Turns commands into states in closed form, and reads the measured states.

    Args:
        road_map: The road map.
        dt: Length of a step (s).
        plant: The plant that moves the actors; default: they follow the closed forms exactly.

    Attributes:
        map: The road map.
        dt: Length of a step (s).
        signals: The traffic lights.
    """

    def __init__(
        self, road_map: RoadMap, dt: float = DEFAULT_STEP, plant: Plant | None = None
    ) -> None:
        self.map = road_map
        self.dt = dt
        self.signals = Signals(road_map)
        self._stop_lines = StopLines(road_map, self.signals)
        self._bends = BendsAhead(road_map)
        self._specs: dict[str, ActorSpec] = {}
        self._cast: dict[str, CommandedActor] = {}
        self._ids: tuple[str, ...] = ()
        self._members: tuple[CommandedActor, ...] = ()
        self._changes: dict[str, StateChange] = {}
        self._commanding: Sequence[ActorState] = ()  # at the next step, as far as computed
        self._changed: Sequence[str] = ()
        self._unsteady: Sequence[str] = ()
        self._outside: tuple[CommandedActor, ...] = ()  # external drivers and autopilots
        self._couplings = Couplings()
        self._lights = Lights()
        self._surroundings = Surroundings(dt)
        self._track = Track()
        self._contacts = Contacts()
        self._friction = FrictionWatch(dt)
        self._plant: Plant = Identity() if plant is None else CheckedPlant(plant)
        self._scene = Scene(
            road_map, dt, self.signals, self._lights, self._surroundings, self._couplings
        )

    # --- life ---------------------------------------------------------------------------------

    @property
    def name(self) -> str:
        """Name of its plant: `embedded`, or a simulator."""
        return self._plant.name

    def control(self, actor: str) -> ControlMode:
        """The control mode of an actor."""
        return self._plant.control(actor)

    def begin(self) -> None:
        """Sets the actors to their start, before step 0."""
        members = self._members
        for member in members:
            member.follows = self._plant.control(member.spec.id) not in EXTERNAL
        self._outside = tuple(member for member in members if not member.follows)
        self._scene.command(members, [member.state for member in members], frozenset(), frozenset())
        found = self._plant.begin(self._scene)
        if found:
            placed = [member.state for member in members]
            arrive(self._cast, placed, found, (), self._couplings, self.map, 0.0)
            self._contacts.begin()

    def close(self) -> None:
        """Closes the simulator, if there is one."""
        self._plant.close()

    # --- cast ---------------------------------------------------------------------------------

    def add(self, spec: ActorSpec) -> None:
        """Adds an actor; it has a state after its placement."""
        shape = self._plant.shape(spec)
        self._specs[spec.id] = spec if shape is None else replace(spec, shape=shape)

    def place(
        self,
        actor: str,
        at: LanePosition | Pose,
        speed: float | None = None,
        heading: float | None = None,
        tilt: Tilt = LEVEL,
        aside: float = 0.0,
    ) -> None:
        """Places an actor before step 0; `Start` describes the arguments."""
        start = Start(at, speed or 0.0, heading, tilt, aside)
        self._cast[actor] = placed(self._specs[actor], start, self.map, self._surroundings.road)
        self._cast = {each: self._cast[each] for each in self._specs if each in self._cast}
        self._ids, self._members = tuple(self._cast), tuple(self._cast.values())
        self._lights.add(actor)
        self._contacts.begin()

    def actors(self) -> tuple[str, ...]:
        """Ids of the placed actors in the order of the cast."""
        return self._ids

    def set_route(self, actor: str, route: Route | None) -> None:
        """Sets the route that decides at forks."""
        self._member(actor).route = route

    # --- reading ------------------------------------------------------------------------------

    def state(self, actor: str) -> ActorState:
        """State of an actor at the present step."""
        member = self._cast.get(actor)
        return self._member(actor).state if member is None else member.state

    def motion(self, actor: str) -> Motion:
        """Velocity and acceleration of an actor at the present step, in its own axes."""
        member = self._member(actor)
        lies = member.tilt is LEVEL and member.state.lane_position is not None
        return member.motion or self._track.of(actor, member.state, self.dt, lies=lies)

    def projected(self, state: ActorState, seconds: float) -> ActorState:
        """The position of an actor after a time if it continued in its lane at its speed."""
        return projected(self.map, state, seconds)

    def outlook(self, actor: str, steps: int) -> Outlook | None:
        """The expected motion of an actor over a number of steps.

        None if its command does not determine it.
        """
        moved = self._ids.index(actor) < len(self._commanding)
        return self._member(actor).outlook(steps, self.dt, moved=moved)

    def along(self, a: ActorState, b: ActorState) -> float | None:
        """Route distance (m) from a to b; None if not connected."""
        return along_lanes(self.map, a, b)

    def aside(self, a: ActorState, b: ActorState) -> float | None:
        """Lateral distance (m) of b to the left of a, in the lane of a; None if not connected."""
        return lateral_on_road(self.map, a, b)

    def obstacle(self, me: ActorState) -> tuple[float, float] | None:
        """Gap (m) to the nearest actor ahead on the path, and its speed (m/s) along it."""
        cast = self._cast.values()
        others = [me if member.reference is me else member.state for member in cast]
        return nearest_ahead(self.map, me, others, self._surroundings.sight)

    def stop_line(self, me: ActorState, route: Route | None, reach: float) -> StopLine | None:
        """First line within a distance (m) at which a light requires a stop; None without one."""
        place = me.lane_position
        if place is None or not self.signals.lit():
            return None
        sight = me.shape.front + self._surroundings.sight
        return self._stop_lines.ahead(place, route, me.shape.front, min(reach, sight))

    def bend(self, me: ActorState, route: Route | None, limits: Limits) -> float:
        """Speed (m/s) at the next step at which a driver approaches the bends ahead."""
        most = adhesion_of(self._surroundings.road) * GRAVITY
        return self._bends.fastest(me, route, limits, most, me.v * self.dt)

    def grip(self, me: ActorState) -> float:
        """Largest acceleration (m/s^2) that the road can transmit to wheels in any direction."""
        return grip(self._surroundings.road)

    def limits(self, actor: str, *, of_vehicle: bool = True) -> Limits:
        """Limits of an actor on the present road: of its vehicle and tyres, or of tyres alone."""
        member = self._member(actor)
        return member.limits if of_vehicle else member.tyres

    def progress(self, actor: str, slot: str) -> Progress:
        """Progress of the command in a slot."""
        return self._member(actor).progress(slot)

    def changed(self) -> Sequence[str]:
        """Actors of which the progress of a command may have changed in the last step."""
        return self._changed

    def unsteady(self) -> Collection[str]:
        """Actors whose speed, lane or offset may have changed since the step before."""
        return (*self._unsteady, *self._changes) if self._changes else self._unsteady

    def reference(self, actor: str) -> ActorState:
        """State that commands start from: the commanded one, abreast of the actor."""
        return self._member(actor).reference

    def deviation(self, actor: str, slots: Sequence[str]) -> Deviation | None:
        """Deviation of an actor from its reference; None unless it is driven."""
        tracking = self._member(actor).tracking
        return None if tracking is None else tracking.deviation(slots)

    def lights(self, actor: str) -> LightState:
        """Lights at the present step."""
        return self._lights.of(actor)

    def environment(self) -> Mapping[str, float]:
        """Environment at the present step."""
        return self._surroundings.values

    def collisions(self) -> Sequence[tuple[str, str]]:
        """Pairs of actors (ids sorted) whose contact began during the last step, sorted."""
        return self._contacts.new

    def overloads(self) -> Sequence[Overload]:
        """Motions so far beyond the grip or rollover limit."""
        return self._friction.overloads

    def warnings(self) -> Sequence[str]:
        """Deviations of a simulator from the commands so far."""
        return self._scene.warnings()

    def capabilities(self) -> frozenset[Feature]:
        """Its capabilities besides moving actors."""
        return self._plant.capabilities()

    def take_notes(self) -> Sequence[Note]:
        """Returns the reports of a simulator since the last call."""
        return self._scene.take_notes()

    # --- writing ------------------------------------------------------------------------------

    def command(self, actor: str, slot: str, command: Command | None) -> None:
        """Sets the command of a slot; None: hold the speed, keep the lane."""
        member = self._member(actor)
        if command is not None and self._couplings.is_towed(actor):
            raise ScenarioError(f"{actor} is towed, so it cannot move by itself")
        member.pursue(slot, command, self.map)

    def assign(
        self,
        actor: str,
        *,
        speed: float | None = None,
        acceleration: float | None = None,
        at: LanePosition | Pose | None = None,
        heading: float | None = None,
        tilt: Tilt = LEVEL,
    ) -> None:
        """Changes a state instantly; assignments of one instant are combined.

        Raises:
            ScenarioError: The actor has an external driver, and has started.
        """
        member = self._member(actor)
        is_start = self._scene.step == 0 and "driver_starts" in self.capabilities()
        if not member.follows and not is_start:
            raise ScenarioError(
                f"{actor} is under external control, so nothing can be assigned to it"
            )
        for name, value, wanted in (
            ("speed", speed, float | None),
            ("acceleration", acceleration, float | None),
            ("at", at, LanePosition | Pose | None),
            ("heading", heading, float | None),
        ):
            problem = problem_of(value, wanted)
            if problem:
                raise ScenarioError(f"{actor}: invalid assignment: {in_words(name, problem)}")
        before = self._changes.get(actor, StateChange())
        change = before.with_also(speed, acceleration, at, heading, tilt)
        self._changes[actor] = change
        change.carry_out(member, self.map)
        if change.jumps or change.turns:
            member.motion = None
            self._track.interrupt(actor)
            self._contacts.turn()
        if change.jumps:
            self._contacts.put(self._ids.index(actor), member.state)

    def attach(self, tow: str, trailer: str | None) -> None:
        """Couples a trailer to a vehicle; None uncouples its trailer."""
        before = self._couplings.attach(tow, trailer)
        if before is not None:
            self._member(before).pursue_speed(Standstill())
        if trailer is not None:
            self._member(trailer).unbind()

    def trailer_of(self, tow: str) -> str | None:
        """Id of the trailer that a vehicle tows."""
        return self._couplings.trailer_of(tow)

    def set_lights(self, actor: str, mode: LightMode) -> LightState:
        """Switches lights; returns their new states."""
        self._member(actor)
        return self._lights.switch(actor, mode, self._surroundings.automatic_light)

    def begin_under(self, sky: Sky) -> None:
        """Sets sun and moon to their positions at a place and time, before step 0."""
        self._surroundings.begin_under(sky)

    def set_environment(self, values: Mapping[str, float]) -> Mapping[str, LightState]:
        """Changes the environment instantly; returns the lights that switch."""
        self._surroundings.set(values)
        for member in self._cast.values():
            if member.wheels is not None:
                member.wheels.road = self._surroundings.road
                member.upset()
        return self._lights.follow(self._surroundings.automatic_light)

    # --- time ---------------------------------------------------------------------------------

    def step(self) -> None:
        """Advances from step k to k+1."""
        members, ids = self._members, self._ids
        # All actors read the snapshot; it is replaced after all have moved.
        before = [member.state for member in members]
        coupled = self._couplings.pairs()
        towed = self._couplings.towed() if coupled else NOBODY
        commanded: list[ActorState] = []
        others: list[CommandedActor] = []
        self._commanding = commanded
        for member in members:
            state = member.reference if member.still else member.cruised()
            if state is None:
                others.append(member)
                state = self._commanded(member, towed)
            commanded.append(state)
        if coupled:
            self._couplings.draw(self._cast, commanded, self.dt, self.map)
        jumped = frozenset([m.spec.id for m in others if m.jumped]) if others else NOBODY
        put, kicked = self._take_changes() if self._changes else (NOBODY, NOBODY)
        elsewhere = put | jumped
        self._scene.command(members, commanded, elsewhere, kicked)
        found = self._plant.moved(self._scene)
        self._scene.step += 1
        states = commanded
        if found:
            states = arrive(
                self._cast, commanded, found, elsewhere, self._couplings, self.map, self.dt
            )
        else:
            for member, state in zip(members, commanded, strict=True):
                member.state = member.reference = state
        if coupled:
            for tow, trailer, angle in self._couplings.take_folded():
                self._scene.note_jack_knife(tow, trailer, angle)
        self._track.add(ids, before, jumped)
        ways = [member.way for member in members]
        self._contacts.step(ids, before, states, ways, jumped, coupled)
        self._friction.step(members, elsewhere, self._surroundings.road)
        for member in self._outside:
            member.observe(self)
        self._changed = [member.spec.id for member in others if member.has_news()]
        self._unsteady = ids if found or coupled else [member.spec.id for member in others]
        self._surroundings.step()
        if self._surroundings.sky is not None:
            self._lights.follow(self._surroundings.automatic_light)

    def _take_changes(self) -> tuple[frozenset[str], frozenset[str]]:
        """Returns the actors that were placed or turned, and those with an assigned speed."""
        changes, self._changes = self._changes, {}
        return (
            frozenset([each for each, change in changes.items() if change.jumps or change.turns]),
            frozenset([each for each, change in changes.items() if change.speed is not None]),
        )

    def _commanded(self, member: CommandedActor, towed: Collection[str]) -> ActorState:
        """Commanded state of an actor at the next step; trailers are moved later."""
        if member.follows and member.spec.movable and member.spec.id not in towed:
            return member.moved(self, self.map)
        return member.state

    def _member(self, actor: str) -> CommandedActor:
        member = self._cast.get(actor)
        if member is None:
            raise ScenarioError(f"{actor} is not placed in the world")
        return member
