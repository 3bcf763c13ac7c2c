"""A plant for tests: vehicles that follow their setpoints as imperfectly as it is told."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from osc2tx_runtime.opendrive import Pose
from osc2tx_runtime.world import ActorSpec, Shape
from osc2tx_runtime.world.geometry.curve import turn_between
from osc2tx_runtime.world.measuring.measurement import Measurement
from osc2tx_runtime.world.plant.scene import Scene, Setpoint
from osc2tx_runtime.world.protocol import FEATURES, ControlMode, Feature


@dataclass
class FollowingPlant:
    """Kinematic bicycles: first-order lag of the speed, pure pursuit across the way.

    Those on foot lag in their speed alone.

    Attributes:
        lag: Time constant of the speed (s).
        gain: Share of the wished speed that it reaches.
        most: Largest speed (m/s).
        drift: m/s to the left that the controller does not know of.
        features: What it has beside moving actors.
        exact: Actors that are where they are wished.
        calls: What was called, in order.
    """

    lag: float = 0.2
    gain: float = 1.0
    most: float = math.inf
    drift: float = 0.0
    features: frozenset[Feature] = FEATURES
    exact: tuple[str, ...] = ()
    name: str = "following 1.0"
    calls: list[str] = field(default_factory=list)
    poses: dict[str, Pose] = field(default_factory=dict)
    speeds: dict[str, float] = field(default_factory=dict)

    def control(self, actor: str) -> ControlMode:
        return "exact" if actor in self.exact else "driven"

    def capabilities(self) -> frozenset[Feature]:
        return self.features

    def shape(self, spec: ActorSpec) -> Shape | None:
        self.calls.append(f"shape {spec.id}")
        return None

    def begin(self, scene: Scene) -> Mapping[str, Measurement]:
        self.calls.append("begin")
        for actor, setpoint in scene.setpoints.items():
            state = setpoint.state
            self.poses[actor] = Pose(state.x, state.y, state.z, state.h)
            self.speeds[actor] = state.v
        return {}

    def moved(self, scene: Scene) -> Mapping[str, Measurement]:
        self.calls.append("moved")
        return {
            actor: self.follow(actor, setpoint, scene.dt)
            for actor, setpoint in scene.setpoints.items()
            if actor not in self.exact and setpoint.spec.movable and not setpoint.towed
        }

    def close(self) -> None:
        self.calls.append("close")

    def follow(self, actor: str, setpoint: Setpoint, dt: float) -> Measurement:
        wished, pose, speed = setpoint.state, self.poses[actor], self.speeds[actor]
        if setpoint.jumps or not setpoint.spec.shape.wheelbase:
            pose = Pose(wished.x, wished.y, wished.z, wished.h)
        if setpoint.jumps or setpoint.kicked:
            speed = wished.v
        else:
            goal = min(self.gain * wished.v, self.most)
            after = goal + (speed - goal) * math.exp(-dt / self.lag)
            way, speed = 0.5 * (speed + after) * dt, after
            if setpoint.spec.shape.wheelbase:
                look = max(2.5 * setpoint.spec.shape.wheelbase, 0.6 * abs(speed))
                pose = self.steered(pose, setpoint.ahead(math.copysign(look, way)), way, dt)
        self.poses[actor], self.speeds[actor] = pose, speed
        attitude = {"pitch": wished.pitch, "roll": wished.roll}
        return self.measurement(pose._replace(z=wished.z, **attitude), speed)

    def steered(self, pose: Pose, goal: Pose, way: float, dt: float) -> Pose:
        far = math.hypot(goal.x - pose.x, goal.y - pose.y)
        turn = turn_between(pose.h, math.atan2(goal.y - pose.y, goal.x - pose.x))
        h = pose.h + way * 2.0 * math.sin(turn) / far
        middle, aside = 0.5 * (pose.h + h), self.drift * dt
        return Pose(
            pose.x + way * math.cos(middle) - aside * math.sin(middle),
            pose.y + way * math.sin(middle) + aside * math.cos(middle),
            goal.z,
            turn_between(0.0, h),
        )

    def measurement(self, pose: Pose, speed: float) -> Measurement:
        return Measurement(pose, (speed, self.drift, 0.0))
