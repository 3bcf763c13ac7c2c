"""A plant in which some vehicles have external drivers; all others are exact."""

from __future__ import annotations

import math
from collections.abc import Mapping

from osc2tx_runtime.errors import OwnCode, ScenarioError, SettingsError, name_of
from osc2tx_runtime.opendrive import LanePosition, Pose
from osc2tx_runtime.world.actor_dimensions import Limits, Shape
from osc2tx_runtime.world.checks.values import problem_of
from osc2tx_runtime.world.drivers.driving import Control, Driver
from osc2tx_runtime.world.drivers.observing import observe
from osc2tx_runtime.world.geometry.attitude import tilt_on
from osc2tx_runtime.world.geometry.curve import turn_between
from osc2tx_runtime.world.grip.friction import GRAVITY, adhesion_of
from osc2tx_runtime.world.measuring.measurement import Measurement
from osc2tx_runtime.world.plant.scene import Scene, Setpoint
from osc2tx_runtime.world.protocol import FEATURES, ActorSpec, ControlMode, Feature
from osc2tx_runtime.world.surroundings.stop_lines_ahead import StopLines


class SingleTrack:
    """One vehicle.

    Attributes:
        pose: Pose of the middle of its rear axle, level.
        speed: m/s, never negative.
        yaw_rate: rad/s over the last step.
    """

    def __init__(self, pose: Pose, speed: float, shape: Shape) -> None:
        self.pose, self.speed, self.yaw_rate = pose, speed, 0.0
        self._shape = shape

    def step(self, control: Control, limits: Limits, grip: float, dt: float) -> None:
        """Advance by a time.

        Args:
            control: The controls of its driver.
            limits: The limits of the vehicle.
            grip: Acceleration (m/s^2) that the road transmits in all directions together.
            dt: Seconds.
        """
        bend = self._bend(control.steering, grip)
        across = min(abs(bend) * self.speed**2, grip)
        left = math.sqrt(grip**2 - across**2)
        most, least = min(limits.acceleration, left), -min(limits.deceleration, left)
        rate = min(max(control.acceleration, least), most)
        after = max(self.speed + rate * dt, 0.0)
        way = 0.5 * (self.speed + after) * dt
        if after == 0.0 and rate < 0.0:
            way = -0.5 * self.speed**2 / rate  # it reaches standstill within the step
        self._go(way, bend * way)
        self.speed, self.yaw_rate = after, bend * way / dt

    def _bend(self, steering: float, grip: float) -> float:
        """Curvature (1/m) of its path, within the limits of steering and road."""
        most = self._shape.steering
        bend = math.tan(min(max(steering, -most), most)) / self._shape.wheelbase
        limit = grip / self.speed**2 if self.speed > 0.0 else math.inf
        return min(max(bend, -limit), limit)

    def _go(self, way: float, turn: float) -> None:
        half = 0.5 * turn
        chord = way * math.sin(half) / half if abs(half) > 1e-9 else way
        h = self.pose.h + half
        self.pose = Pose(
            self.pose.x + chord * math.cos(h),
            self.pose.y + chord * math.sin(h),
            self.pose.z,
            turn_between(0.0, self.pose.h + turn),
        )


class DriversPlant:
    """The embedded world with external drivers.

    Args:
        drivers: The drivers, by the id of their actor.
    """

    name = "embedded"

    def __init__(self, drivers: Mapping[str, Driver]) -> None:
        self._drivers = dict(drivers)
        self._vehicles: dict[str, SingleTrack] = {}
        self._lines: StopLines | None = None

    def control(self, actor: str) -> ControlMode:
        """`external` for actors with a driver."""
        return "external" if actor in self._drivers else "exact"

    def capabilities(self) -> frozenset[Feature]:
        """All there are."""
        return FEATURES

    def shape(self, spec: ActorSpec) -> Shape | None:
        """The shape of the scenario."""
        return None

    def begin(self, scene: Scene) -> Mapping[str, Measurement]:
        """Place the vehicles at their start.

        Raises:
            SettingsError: A driver has no vehicle.
        """
        setpoints = scene.setpoints
        for actor in self._drivers:
            setpoint = setpoints.get(actor)
            if setpoint is None or not setpoint.spec.shape.wheelbase:
                raise SettingsError(f"--ego {actor}: {actor} is not a vehicle of the scenario")
            self._put(setpoint)
        self._lines = StopLines(scene.map, scene.signals)
        return {actor: self._measured(scene, setpoints[actor]) for actor in self._drivers}

    def moved(self, scene: Scene) -> Mapping[str, Measurement]:
        """Call the drivers, and advance their vehicles by one step.

        Raises:
            ScenarioError: A driver raises an exception, or does not return a `Control`.
        """
        setpoints = scene.setpoints
        for actor in self._drivers if scene.step == 0 else ():
            if setpoints[actor].jumps or setpoints[actor].kicked:
                self._put(setpoints[actor])
        controls = {actor: self._control(actor, scene, setpoints[actor]) for actor in self._drivers}
        found = {}
        for actor, control in controls.items():
            setpoint = setpoints[actor]
            grip = adhesion_of(scene.road) * GRAVITY
            self._vehicles[actor].step(control, setpoint.limits, grip, scene.dt)
            found[actor] = self._measured(scene, setpoint)
        return found

    def close(self) -> None:
        """Nothing to leave."""

    def _put(self, setpoint: Setpoint) -> None:
        """Place a vehicle at its start."""
        state = setpoint.state
        pose = Pose(state.x, state.y, state.z, state.h)
        self._vehicles[setpoint.spec.id] = SingleTrack(pose, state.v, state.shape)

    def _control(self, actor: str, scene: Scene, setpoint: Setpoint) -> Control:
        driver = self._drivers[actor]
        assert self._lines is not None
        observation = observe(scene, setpoint, self._lines)
        name = f"the driver of {actor}, {name_of(type(driver))},"
        with OwnCode(f"{name} raised"):
            control = driver.step(observation, scene.dt)
            if not isinstance(control, Control):
                raise ScenarioError(f"{name} returns a {type(control).__name__}, not a Control")
            if problem := problem_of(control, Control):
                raise ScenarioError(f"{name} returns a Control whose {problem}")
            return Control(float(control.acceleration), float(control.steering))

    def _measured(self, scene: Scene, setpoint: Setpoint) -> Measurement:
        vehicle, place = self._vehicles[setpoint.spec.id], setpoint.now.lane_position
        pose = _on_ground(scene, vehicle.pose, place)
        forwards = vehicle.speed / math.cos(pose.pitch)
        return Measurement(pose, (forwards, 0.0, 0.0), None, (0.0, 0.0, vehicle.yaw_rate))


def _on_ground(scene: Scene, pose: Pose, hint: LanePosition | None) -> Pose:
    """A pose with the height and the tilt of the road under it."""
    on = scene.map.locate(pose.x, pose.y, pose.z, pose.h, hint=hint, max_distance=1.0)
    if on is None:
        return pose
    ground = scene.map.pose(on)
    pitch, roll = tilt_on(ground, pose.h)
    return Pose(pose.x, pose.y, ground.z, pose.h, pitch, roll)
