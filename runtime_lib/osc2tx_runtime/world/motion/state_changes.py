"""Instant changes of a state: speed, position, heading, tilt."""

from __future__ import annotations

from osc2tx_runtime.opendrive import LanePosition, Pose, RoadMap
from osc2tx_runtime.world.geometry.attitude import LEVEL, Tilt
from osc2tx_runtime.world.state import ActorState
from osc2tx_shared.classes import dataclass

from .actor_motion import CommandedActor


@dataclass(frozen=True, slots=True)
class StateChange:
    """Assigned values at one instant; None leaves a value unchanged.

    Attributes:
        speed: m/s.
        acceleration: m/s^2.
        at: Position.
        heading: rad.
        tilt: Pitch and roll.
    """

    speed: float | None = None
    acceleration: float | None = None
    at: LanePosition | Pose | None = None
    heading: float | None = None
    tilt: Tilt = LEVEL

    @property
    def jumps(self) -> bool:
        """Whether it teleports the actor."""
        return self.at is not None

    @property
    def turns(self) -> bool:
        """Whether it turns the actor."""
        return self.heading is not None or self.tilt != LEVEL

    def with_also(
        self,
        speed: float | None,
        acceleration: float | None,
        at: LanePosition | Pose | None,
        heading: float | None,
        tilt: Tilt,
    ) -> StateChange:
        """This change combined with another of the same instant.

        Measured values become plain numbers: the motion does not allow for rounding.
        """
        return StateChange(
            self.speed if speed is None else float(speed),
            self.acceleration if acceleration is None else float(acceleration),
            self.at if at is None else Pose(*map(float, at)) if isinstance(at, Pose) else at,
            self.heading if heading is None else float(heading),
            self.tilt if tilt == LEVEL else tilt,
        )

    def carry_out(self, member: CommandedActor, road_map: RoadMap) -> None:
        """Change the state of an actor, and the start values of its commands."""
        if isinstance(self.at, LanePosition) and member.spec.lane_bound and self.heading is None:
            member.settle(member.rebind(self.at, member.reference.v, road_map))
        elif self.at is not None or self.heading is not None:
            member.settle(self._put(member, road_map))
        member.state = self._applied_to(member.state)
        member.reference = self._applied_to(member.reference)
        if self.tilt != LEVEL:
            member.tilt = self.tilt
            member.upset()
        if self.speed is not None or self.acceleration is not None:
            member.go_on_with(member.reference.v, member.reference.a)

    def _applied_to(self, state: ActorState) -> ActorState:
        """The state with the tilt, speed and acceleration."""
        if self.tilt != LEVEL:
            pitch, roll = self.tilt.over((state.pitch, state.roll))
            state = state._replace(pitch=pitch, roll=roll)
        if self.speed is not None:
            state = state._replace(v=self.speed, a=0.0)
        return state if self.acceleration is None else state._replace(a=self.acceleration)

    def _put(self, member: CommandedActor, road_map: RoadMap) -> ActorState:
        """State off the lanes, or turned out of one."""
        state = member.reference
        pose = Pose(state.x, state.y, state.z, state.h)
        if isinstance(self.at, LanePosition):
            pose = road_map.pose(self.at)
        elif self.at is not None:
            pose = self.at
            member.unbind()
        if self.heading is not None:
            pose = Pose(pose.x, pose.y, pose.z, self.heading)
            if not isinstance(self.at, Pose):
                member.turn_away()
        return member.free_state(pose, state.v, 0.0, road_map)
