"""Instant changes of a state: speed, place, heading, tilt."""

from __future__ import annotations

from dataclasses import dataclass

from osc2tx_runtime.opendrive import LanePosition, Pose, RoadMap

from .actor_motion import Body
from .attitude import LEVEL, Tilt
from .state import ActorState
from .step_inputs import Senses

__all__ = ["Wish"]


@dataclass(frozen=True, slots=True)
class Wish:
    """What is to be at the next step; None leaves it to the motion.

    Attributes:
        speed: m/s.
        at: Where.
        heading: rad.
        tilt: Pitch and roll.
    """

    speed: float | None = None
    at: LanePosition | Pose | None = None
    heading: float | None = None
    tilt: Tilt = LEVEL

    @property
    def jumps(self) -> bool:
        """Whether it puts the actor somewhere."""
        return self.at is not None

    @property
    def turns(self) -> bool:
        """Whether it turns the actor."""
        return self.heading is not None or self.tilt != LEVEL

    def with_also(
        self,
        speed: float | None,
        at: LanePosition | Pose | None,
        heading: float | None,
        tilt: Tilt,
    ) -> Wish:
        """This wish and another one of the same instant.

        What a scenario measured becomes a plain number: the motion does not allow for rounding.
        """
        return Wish(
            self.speed if speed is None else float(speed),
            self.at if at is None else Pose(*map(float, at)) if isinstance(at, Pose) else at,
            self.heading if heading is None else float(heading),
            self.tilt if tilt == LEVEL else tilt,
        )

    def carried_out(self, body: Body, senses: Senses, road_map: RoadMap) -> ActorState:
        """State of an actor at the next step."""
        if self.speed is not None:
            body.pursue_speed(None)
        if self.at is None and self.heading is None:
            state = body.moved(senses, road_map)
        elif isinstance(self.at, LanePosition) and body.spec.lane_bound and self.heading is None:
            state = body.rebind(self.at, body.state.v, road_map)
        else:
            state = self._put(body, road_map)
        if self.tilt != LEVEL:
            body.tilt = self.tilt
            pitch, roll = self.tilt.over((state.pitch, state.roll))
            state = state._replace(pitch=pitch, roll=roll)
        return state if self.speed is None else state._replace(v=self.speed, a=0.0)

    def _put(self, body: Body, road_map: RoadMap) -> ActorState:
        """State beside the lanes, or turned out of one."""
        state = body.state
        pose = Pose(state.x, state.y, state.z, state.h)
        if isinstance(self.at, LanePosition):
            pose = road_map.pose(self.at)
        elif self.at is not None:
            pose = self.at
            body.unbind()
        if self.heading is not None:
            pose = Pose(pose.x, pose.y, pose.z, self.heading)
            if not isinstance(self.at, Pose):
                body.turn_away()
        return body.free_state(pose, state.v, 0.0, road_map)
