"""The protocol of worlds: the embedded one, and adapters of simulators."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, Protocol

from osc2tx_runtime.opendrive import LanePosition, Pose, RoadMap, Route

from .actor_dimensions import Limits, Shape
from .attitude import LEVEL, Tilt
from .commands import Command
from .kinematics import Kinematics
from .state import ActorState
from .sun_and_moon import Sky
from .traffic_light_states import Signals

__all__ = [
    "FOG_LIGHT_RANGE",
    "LATERAL",
    "LONGITUDINAL",
    "LOW_BEAM_SUN_ELEVATION",
    "PENDING",
    "REACHED",
    "ActorSpec",
    "LightMode",
    "LightState",
    "Progress",
    "World",
]

# The same words as in `osc2tx_runtime.language.registry`; a world does not know the registry.
LONGITUDINAL = "longitudinal"
LATERAL = "lateral"

LOW_BEAM_SUN_ELEVATION = 0.2617993877991494
"""Sun elevation (rad, 15 degrees) below which lights in mode `auto` are low beams."""

FOG_LIGHT_RANGE = 100.0
"""Visual range (m) below which they are so, too (UK Highway Code, rule 226)."""

LightMode = Literal["off", "auto", "daytime", "position", "low_beam", "high_beam"]


@dataclass(frozen=True, slots=True)
class ActorSpec:
    """What a world must know to make an actor.

    Attributes:
        id: Name of the actor in the scenario.
        kind: Most derived actor kind of the DSL, e.g. `vehicle`.
        shape: Bounding box and reference point.
        limits: What it can do.
        model: Blueprint or other name of a model; None if the scenario leaves it open.
        lane_bound: True if it follows lanes where it can (vehicles).
        movable: False for stationary objects.
        color: As written in the scenario.
    """

    id: str
    kind: str
    shape: Shape
    limits: Limits
    model: str | None = None
    lane_bound: bool = False
    movable: bool = True
    color: str | None = None


@dataclass(frozen=True, slots=True)
class Progress:
    """How far the command of a slot has got at the present step.

    Attributes:
        done: The goal is reached; the command goes on to hold it.
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
        mode: What was asked for.
        lit: What shines: for mode `auto` "low_beam" or "off", depending on sun and fog.
    """

    mode: LightMode = "off"
    lit: LightMode = "off"


class World(Protocol):
    """A world in steps of fixed length.

    Commands and assignments given at step k act from k to k+1. States, progress, lights and
    environment are those of step k until `step` is called.
    """

    dt: float
    map: RoadMap
    signals: Signals

    def add(self, spec: ActorSpec) -> None:
        """Makes an actor known; it has a state from its placement on."""

    def place(
        self,
        actor: str,
        at: LanePosition | Pose,
        speed: float | None = None,
        heading: float | None = None,
        tilt: Tilt = LEVEL,
        aside: float = 0.0,
    ) -> None:
        """Puts an actor somewhere before step 0; who heads beside its lane is in none yet."""

    def state(self, actor: str) -> ActorState:
        """State of an actor at the present step."""

    def motion(self, actor: str) -> Kinematics:
        """Velocity and acceleration of an actor at the present step, in its own axes."""

    def actors(self) -> Sequence[str]:
        """Ids of the placed actors in the order in which they were added."""

    def command(self, actor: str, slot: str, command: Command | None) -> None:
        """Sets what a slot pursues; None: hold the speed, keep the lane."""

    def progress(self, actor: str, slot: str) -> Progress:
        """Progress of the command in a slot."""

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

    def attach(self, tow: str, trailer: str | None) -> None:
        """Couples a trailer to a vehicle, from the next step on; None uncouples what it tows."""

    def trailer_of(self, tow: str) -> str | None:
        """Id of the trailer that a vehicle tows."""

    def set_route(self, actor: str, route: Route | None) -> None:
        """Decides which branch the actor takes at forks."""

    def limits(self, actor: str, *, of_vehicle: bool = True) -> Limits:
        """What an actor can do on the road as it is; without its own limits what tyres can."""

    def grip(self, me: ActorState) -> float:
        """Largest acceleration (m/s^2) that the road can transmit to wheels in any direction."""

    def set_lights(self, actor: str, mode: LightMode) -> LightState:
        """Switches lights from the next step on; returns what they will be."""

    def lights(self, actor: str) -> LightState:
        """Lights at the present step."""

    def begin_under(self, sky: Sky) -> None:
        """Puts sun and moon where they stand at a place and time, before step 0."""

    def set_environment(self, values: Mapping[str, float]) -> Mapping[str, LightState]:
        """Changes the environment from the next step on; names that are left out stay.

        Returns the actors whose automatic lights switch, with what they will be.
        """

    def environment(self) -> Mapping[str, float]:
        """Environment at the present step, SI units: `sun_azimuth`, `sun_elevation`, ..."""

    def step(self) -> None:
        """Goes from step k to k+1."""

    def collisions(self) -> Sequence[tuple[str, str]]:
        """Pairs of actors (ids sorted) whose contact began during the last step, sorted."""

    def capabilities(self) -> frozenset[str]:
        """Names of the commands (classes) and other features the world carries out."""
