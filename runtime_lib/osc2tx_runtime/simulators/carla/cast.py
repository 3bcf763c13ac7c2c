"""The state of an actor in CARLA."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any

from osc2tx_runtime.opendrive import Pose
from osc2tx_runtime.world.actor_dimensions import MODELS, Shape
from osc2tx_runtime.world.measuring.measurement import Measurement
from osc2tx_runtime.world.plant.scene import Setpoint
from osc2tx_runtime.world.protocol import EXACT, ActorSpec, ControlMode
from osc2tx_runtime.world.state import ActorState
from osc2tx_shared.classes import dataclass

from .blueprints import SLOW_STARTER
from .frames import measurement_from, transform_of, turning_of, vector_of
from .gains import CAR, GAINS
from .tracking import SpeedControl, Steering, walking

Command = Sequence[Any]
"""Name, number of the actor in CARLA, values; see `client.commands`."""

ABOVE = 0.3
"""Initial height (m) above the ground of actors that physics moves."""

DISPLACED = 0.05
"""Distance (m) from its commanded position beyond which another cause has moved an exact actor."""

SIZE_NOTED = 0.1  # m between the sizes of scenario and simulator that are reported
STILL = 0.05  # m/s
KICKING = 0.5
"""Seconds for which an assigned speed is set in each step, until gear and wheels, which no call
sets, reach it (carla issues 3710 and 4839)."""

NO_WAY = 1e-3  # m: a walker does not move for less
LEAST_SIZE = 0.3  # m of a vehicle or walker
KPH = 3.6  # km/h in a m/s


@dataclass
class CastMember:
    """An actor of the scenario with its actor in CARLA.

    Attributes:
        spec: Its description in the scenario.
        actor: Its number in CARLA.
        blueprint: Its blueprint.
        control: Its control mode.
        ahead: Metres from its origin in CARLA forwards to its reference point.
        up: Metres from the ground to that origin.
        size: Length, width and height (m) in CARLA.
        above: Height (m) above the ground at which it is spawned.
        foreign: Whether another client spawned it.
        removed: It is not in CARLA any more.
        now: The latest measurement; None while it is exactly as commanded.
    """

    spec: ActorSpec
    actor: int
    blueprint: str
    control: ControlMode
    ahead: float
    up: float
    size: tuple[float, float, float]
    steering: Steering
    speed: SpeedControl
    above: float = ABOVE
    foreign: bool = False
    removed: bool = False
    now: Measurement | None = None
    _physics: bool = True
    _gravity: bool = True
    _placed: Sequence[float] | None = None
    _found: Sequence[float] = ()
    _kicking: float = 0.0

    @property
    def is_vehicle(self) -> bool:
        """Whether it has wheels, pedals and lights."""
        return self.blueprint.startswith("vehicle.")

    @property
    def is_measured(self) -> bool:
        """Whether its position may differ from the commanded one."""
        return self.control not in EXACT

    @property
    def other_size(self) -> bool:
        """Whether its sizes in simulator and scenario differ."""
        shape = self.spec.shape
        sizes = zip(self.size, (shape.length, shape.width, shape.height), strict=True)
        return any(abs(theirs - ours) > SIZE_NOTED for theirs, ours in sizes)

    def pose(self, state: ActorState) -> Pose:
        """Its state: as measured, else as commanded."""
        if self.now is not None:
            return self.now.pose
        return Pose(state.x, state.y, state.z, state.h, state.pitch, state.roll)

    def transform(self, state: ActorState) -> list[float]:
        """Its transform in CARLA for a state."""
        pose = Pose(state.x, state.y, state.z, state.h, state.pitch, state.roll)
        return transform_of(pose, self.ahead, self.up)

    def measured(self, state: Sequence[float]) -> Measurement:
        """Note its motion."""
        self.now = measurement_from(state, self.ahead, self.up)
        return self.now

    def deviation(self, state: Sequence[float]) -> float:
        """Return the distance (m) from its commanded position, and note the actual one."""
        self._found = state[:6]
        return 0.0 if self._placed is None else math.dist(self._placed[:3], state[:3])

    # --- commands of a step -------------------------------------------------------------------

    def first(self, setpoint: Setpoint) -> list[Command]:
        """Return the commands that place it at its start, at standstill."""
        if setpoint.towed or self.control in EXACT:
            return self._exact(setpoint)
        x, y, z, *turn = self.transform(setpoint.state)
        commands: list[Command] = [("place", self.actor, x, y, z + self.above, *turn)]
        if self.foreign:
            commands.append(("velocity", self.actor, 0.0, 0.0, 0.0))
        if self.control == "driven" and self.is_vehicle:
            commands.append(("control", self.actor, 0.0, 0.0, 1.0, True, False))
        return commands

    def run_up(self, setpoint: Setpoint, settled: Sequence[float], dt: float) -> list[Command]:
        """Return the commands that move it to its start at its speed, with turning wheels.

        Repeated before the run, gear and wheels reach the speed: in the run, only its own client
        controls it.

        Args:
            setpoint: Its start.
            settled: Its pose on its wheels there.
            dt: Length of a step (s).
        """
        state = setpoint.state
        if self.control != "external" or self.foreign or not self.is_vehicle or not state.v:
            return []
        vx, vy, _ = vector_of(state.v, state.h)
        x, y, *rest = settled[:6]
        return [("place", self.actor, x - vx * dt, y - vy * dt, *rest), self._velocity(state)]

    def kick(self, setpoint: Setpoint) -> list[Command]:
        """Return the commands that set its speed instantly."""
        state = setpoint.state
        if setpoint.towed or self.control in EXACT or self.foreign:
            return []
        self._kicking = KICKING
        return [self._velocity(state)]

    def commands(self, setpoint: Setpoint, dt: float) -> list[Command]:
        """Return the commands that realize its setpoint."""
        if self.removed:
            return []
        if setpoint.towed or self.control == "exact":
            return self._exact(setpoint)
        if self.control == "exact-physics":
            return self._carried(setpoint, dt)
        commands = self._with_physics(True)
        if setpoint.jumps:
            commands.append(("place", self.actor, *self.transform(setpoint.state)))
        if setpoint.jumps or setpoint.kicked:
            self.speed.reset()
            self._kicking = KICKING
            return [*commands, self._velocity(setpoint.state)]
        if self.control == "driven" and self.now is not None:
            if self._kicking > 0.0 and self.is_vehicle and setpoint.state.v:
                commands.append(self._velocity(setpoint.state))
            commands.append(self._driven(setpoint, self.now, dt))
        self._kicking -= dt
        return commands

    def _velocity(self, state: ActorState) -> Command:
        return ("velocity", self.actor, *vector_of(state.v, state.h))

    def _with_physics(self, wanted: bool) -> list[Command]:
        if self._physics == wanted:
            return []
        self._physics = wanted
        return [("physics", self.actor, wanted)]

    def _exact(self, setpoint: Setpoint) -> list[Command]:
        self.now = None
        commands = self._with_physics(False) if self.spec.movable else []
        place = self.transform(setpoint.state)
        if place != self._placed:
            self._placed = place
            commands.append(("place", self.actor, *place))
        return commands

    def _carried(self, setpoint: Setpoint, dt: float) -> list[Command]:
        """Return the commands that move a body with physics to its pose by its velocities.

        It is only placed if it is teleported, or if another cause has moved it.
        """
        goal, start, before = self.transform(setpoint.state), self._found, self._placed
        commands = self._with_physics(True)
        self.now, self._placed = None, goal
        if setpoint.jumps or before is None:
            vx, vy, vz = vector_of(setpoint.state.v, setpoint.state.h)
            start = [goal[0] - vx * dt, goal[1] - vy * dt, goal[2] - vz * dt, *goal[3:]]
            place = True
        else:
            place = math.dist(start[:3], before[:3]) > DISPLACED
            start = before if place else start
        if not self.is_vehicle:
            return [*commands, self._led(start, goal, dt)]
        if self._gravity:
            self._gravity = False
            commands.append(("gravity", self.actor, False))
        if place:
            commands.append(("place", self.actor, *start))
        velocity = [(to - at) / dt for at, to in zip(start[:3], goal[:3], strict=True)]
        commands.append(("velocity", self.actor, *velocity))
        commands.append(("turning", self.actor, *turning_of(start, goal, dt)))
        return commands

    def _led(self, start: Sequence[float], goal: Sequence[float], dt: float) -> Command:
        """Return the commands that make a walker walk between two poses.

        CARLA adds half its height.
        """
        (x, y, z), (pitch, yaw, roll) = start[:3], goal[3:]
        way = math.dist(start[:2], goal[:2])
        speed = way / dt if way > NO_WAY else 0.0
        if speed:  # it walks in the direction of its heading
            yaw = math.degrees(math.atan2(goal[1] - y, goal[0] - x))
        return ("lead", self.actor, x, y, z - self.up, pitch, yaw, roll, speed)

    def _driven(self, setpoint: Setpoint, now: Measurement, dt: float) -> Command:
        if not self.is_vehicle:
            x, y, speed = walking(setpoint, now, dt)
            return ("walk", self.actor, x, -y, speed)
        state, speed = setpoint.state, now.velocity[0]
        pedals = self.speed.pedals(state.v, state.a, speed, dt)
        steer = self.steering.steer(setpoint, now)
        standing = state.v == 0.0 and abs(speed) < STILL
        throttle, brake, reverse = pedals
        return ("control", self.actor, throttle, steer, brake, standing, reverse)


def member_of(
    spec: ActorSpec,
    found: Mapping[str, Any],
    control: ControlMode,
    own_gains: Mapping[str, float] = MappingProxyType({}),
) -> CastMember:
    """Return the member for an actor described by the session.

    Args:
        spec: Its description in the scenario.
        found: Its description by the session.
        control: Its control mode.
        own_gains: Gains that replace those of its category.
    """
    shape = spec.shape
    middle, half_length, half_width, half_height = found["box"]
    if half_length < 0.5 * LEAST_SIZE:  # some blueprints have boxes without size
        middle, half_length = 0.0, 0.5 * shape.length
        half_width, half_height = 0.5 * shape.width, 0.5 * shape.height
    # The boxes of both worlds coincide at the rear end.
    ahead = middle - half_length + shape.rear if shape.wheelbase > 0.0 else 0.0
    gains = GAINS.get(_category(spec), CAR)._replace(**own_gains)
    wheels = found.get("wheels", ())
    largest = math.radians(max((angle for *_, angle in wheels), default=0.0)) or shape.steering
    curve = [(speed / KPH, share) for speed, share in found.get("steering_curve", ())]
    return CastMember(
        spec,
        found["id"],
        found["type"],
        control,
        ahead,
        half_height if found["type"].startswith("walker.") else 0.0,
        (2.0 * half_length, 2.0 * half_width, 2.0 * half_height),
        Steering(_wheelbase(wheels, shape, 2.0 * half_length), largest, gains, curve),
        SpeedControl(gains),
    )


def _category(spec: ActorSpec) -> str:
    """The driving characteristics of a vehicle: by its model, else by its size and strength."""
    if spec.model in MODELS:
        return MODELS[spec.model][0]
    slow = spec.limits.acceleration < SLOW_STARTER
    if spec.shape.width < 1.2:
        return "bicycle" if slow else "motorcycle"
    return "heavy_truck" if slow else "car"


def _wheelbase(wheels: Sequence[Sequence[float]], shape: Shape, length: float) -> float:
    """Return the distance (m) between the axles that steer and the others.

    Places of wheels are in cm. If a server does not report them, or which wheels steer, the
    wheelbase of the scenario is used.
    """
    front = [(x, y) for x, y, angle in wheels if angle > 0.0]
    rear = [(x, y) for x, y, angle in wheels if angle <= 0.0]
    if not front or not rear:
        return shape.wheelbase
    found = 0.01 * math.dist(_middle(front), _middle(rear))
    return found if LEAST_SIZE < found < length else shape.wheelbase


def _middle(points: Sequence[tuple[float, float]]) -> tuple[float, float]:
    count = len(points)
    return sum(x for x, _ in points) / count, sum(y for _, y in points) / count
