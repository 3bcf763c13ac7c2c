"""The protocol of worlds: the embedded one, and adapters of simulators."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any, Literal, Protocol, get_args

from osc2tx_runtime.opendrive import LanePosition, Pose, RoadMap, Route
from osc2tx_runtime.world.geometry.attitude import LEVEL, Tilt
from osc2tx_runtime.world.grip.overload import Overload
from osc2tx_runtime.world.measuring.deviation import Deviation
from osc2tx_runtime.world.measuring.kinematics import Motion
from osc2tx_runtime.world.surroundings.stop_lines_ahead import StopLine
from osc2tx_runtime.world.surroundings.sun_and_moon import Sky
from osc2tx_runtime.world.surroundings.traffic_light_states import Signals
from osc2tx_shared.classes import dataclass

from .actor_dimensions import Limits, Shape
from .commands import Command
from .state import ActorState

Feature = Literal["driver_starts", "lanes", "lights", "map", "towing", "traffic_lights", "weather"]
"""Capability of a world that an action or modifier may require.

`driver_starts`: at step 0 position and speed can be assigned to actors with external drivers.
"""

FEATURES: frozenset[Feature] = frozenset(get_args(Feature))


# As in `language.actions.registry`, which a world does not import.
LONGITUDINAL = "longitudinal"
LATERAL = "lateral"

LOW_BEAM_SUN_ELEVATION = 0.2617993877991494
"""Sun elevation (rad, 15 degrees) below which lights in mode `auto` are low beams."""

FOG_LIGHT_RANGE = 100.0
"""Visual range (m) below which they are low beams as well (UK Highway Code, rule 226)."""

ControlMode = Literal["exact", "exact-physics", "driven", "external", "autopilot"]
"""Control of an actor: exactly as commanded, without or with rigid-body physics in the simulator;
by a controller that follows the commands; by another driver, external or of the simulator."""
EXACT: frozenset[ControlMode] = frozenset({"exact", "exact-physics"})
"""The modes in which an actor has the commanded state, and nothing is measured."""
EXTERNAL: frozenset[ControlMode] = frozenset({"external", "autopilot"})
"""The modes with another driver."""

Note = tuple[str, Mapping[str, Any]]
"""Kind of a line of the trace, and its fields."""

LightMode = Literal["off", "auto", "daytime", "position", "low_beam", "high_beam"]


@dataclass(frozen=True, slots=True)
class ActorSpec:
    """Description of an actor for a world.

    Attributes:
        id: Name of the actor in the scenario.
        kind: Most derived actor kind of the DSL, e.g. `vehicle`.
        shape: Bounding box and reference point.
        limits: Its limits.
        model: Blueprint or other name of a model; None if the scenario leaves it open.
        lane_bound: Whether it follows lanes (vehicles).
        movable: False for stationary objects.
        color: As stated in the scenario.
        role: Name for other clients of a simulator; None: its id.
    """

    id: str
    kind: str
    shape: Shape
    limits: Limits
    model: str | None = None
    lane_bound: bool = False
    movable: bool = True
    color: str | None = None
    role: str | None = None


@dataclass(frozen=True, slots=True)
class Progress:
    """Progress of the command of a slot at the present step.

    Attributes:
        done: The goal is reached; the command continues to hold it.
        failed: Why the goal cannot be reached; None while it can.
    """

    done: bool = False
    failed: str | None = None


PENDING = Progress()
REACHED = Progress(True)


@dataclass(frozen=True, slots=True)
class LightState:
    """Lights of a vehicle.

    Attributes:
        mode: The requested mode.
        lit: The shining lights: in mode `auto` "low_beam" or "off", depending on sun and fog.
    """

    mode: LightMode = "off"
    lit: LightMode = "off"


class World(Protocol):
    """A world in steps of fixed length.

    Commands given at step k act from k to k+1; progress is that of step k until `step` is called.
    Values that are assigned, attached, switched or set at step k are valid and readable at step k.
    """

    dt: float
    map: RoadMap
    signals: Signals

    @property
    def name(self) -> str:
        """Name of its plant: `embedded`, or a simulator."""

    def control(self, actor: str) -> ControlMode:
        """The control mode of an actor."""

    def begin(self) -> None:
        """Sets the actors to their start, before step 0."""

    def close(self) -> None:
        """Closes the simulator, if there is one."""

    def add(self, spec: ActorSpec) -> None:
        """Adds an actor; it has a state after its placement."""

    def place(
        self,
        actor: str,
        at: LanePosition | Pose,
        speed: float | None = None,
        heading: float | None = None,
        tilt: Tilt = LEVEL,
        aside: float = 0.0,
    ) -> None:
        """Places an actor before step 0.

        An actor that is not aligned with a lane is not in it yet.
        """

    def state(self, actor: str) -> ActorState:
        """State of an actor at the present step."""

    def reference(self, actor: str) -> ActorState:
        """State that commands start from: the commanded one, abreast of the actor."""

    def deviation(self, actor: str, slots: Sequence[str]) -> Deviation | None:
        """Deviation of an actor from its reference; None unless it is driven."""

    def motion(self, actor: str) -> Motion:
        """Velocity and acceleration of an actor at the present step, in its own axes."""

    def actors(self) -> Sequence[str]:
        """Ids of the placed actors in the order in which they were added."""

    def command(self, actor: str, slot: str, command: Command | None) -> None:
        """Sets the command of a slot; None: hold the speed, keep the lane."""

    def progress(self, actor: str, slot: str) -> Progress:
        """Progress of the command in a slot."""

    def changed(self) -> Collection[str]:
        """Actors of which the progress of a command may have changed in the last step."""

    def unsteady(self) -> Collection[str]:
        """Actors whose speed, lane or offset may have changed since the step before."""

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
        """Changes a state instantly; assignments of one instant are combined."""

    def attach(self, tow: str, trailer: str | None) -> None:
        """Couples a trailer to a vehicle; None uncouples its trailer."""

    def trailer_of(self, tow: str) -> str | None:
        """Id of the trailer that a vehicle tows."""

    def set_route(self, actor: str, route: Route | None) -> None:
        """Sets the route that decides at forks."""

    def limits(self, actor: str, *, of_vehicle: bool = True) -> Limits:
        """Limits of an actor on the present road: of its vehicle and tyres, or of tyres alone."""

    def grip(self, me: ActorState) -> float:
        """Largest acceleration (m/s^2) that the road can transmit to wheels in any direction."""

    def stop_line(self, me: ActorState, route: Route | None, reach: float) -> StopLine | None:
        """First line within a distance (m) at which a light requires a stop; None without one."""

    def set_lights(self, actor: str, mode: LightMode) -> LightState:
        """Switches lights; returns their new states."""

    def lights(self, actor: str) -> LightState:
        """Lights at the present step."""

    def begin_under(self, sky: Sky) -> None:
        """Sets sun and moon to their positions at a place and time, before step 0."""

    def set_environment(self, values: Mapping[str, float]) -> Mapping[str, LightState]:
        """Changes the environment instantly; other values are unchanged.

        Returns the actors whose automatic lights switch, with their new states.
        """

    def environment(self) -> Mapping[str, float]:
        """Environment at the present step, SI units: `sun_azimuth`, `sun_elevation`, ..."""

    def step(self) -> None:
        """Advances from step k to k+1."""

    def collisions(self) -> Sequence[tuple[str, str]]:
        """Pairs of actors (ids sorted) whose contact began during the last step, sorted."""

    def overloads(self) -> Sequence[Overload]:
        """Motions so far beyond the grip or rollover limit, in order of time."""

    def warnings(self) -> Sequence[str]:
        """Deviations of the world from the commands so far, in a run that continues."""

    def take_notes(self) -> Sequence[Note]:
        """Returns lines for the trace, as kind and values, since the last call."""

    def capabilities(self) -> frozenset[Feature]:
        """Its capabilities besides moving actors."""
