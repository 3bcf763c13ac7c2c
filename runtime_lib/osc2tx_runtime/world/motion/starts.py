"""Initial states of actors, before step 0."""

from __future__ import annotations

from typing import NamedTuple

from osc2tx_runtime.opendrive import LanePosition, Pose, RoadMap
from osc2tx_runtime.world.geometry.attitude import LEVEL, Tilt
from osc2tx_runtime.world.grip.friction import RoadCondition, Wheels
from osc2tx_runtime.world.protocol import ActorSpec
from osc2tx_runtime.world.state import ActorState

from .actor_motion import CommandedActor


class Start(NamedTuple):
    """Initial position and motion of an actor.

    Attributes:
        at: Lane-bound actors follow the lane of a lane position; others, and those placed by a
            pose, move straight.
        speed: m/s.
        heading: rad; with a heading against the lane an actor first has to align with it.
        tilt: Pitch and roll.
        aside: Lateral speed (m/s), which decays unless a command holds it.
    """

    at: LanePosition | Pose
    speed: float = 0.0
    heading: float | None = None
    tilt: Tilt = LEVEL
    aside: float = 0.0


def placed(spec: ActorSpec, start: Start, road_map: RoadMap, road: RoadCondition) -> CommandedActor:
    """Return an actor at its start.

    Args:
        spec: Its description.
        start: Its start position.
        road_map: The map.
        road: Condition of the roads.
    """
    at = start.at
    pose = road_map.pose(at) if isinstance(at, LanePosition) else at
    if start.heading is not None:
        pose = Pose(pose.x, pose.y, pose.z, start.heading)
    unplaced = ActorState(pose.x, pose.y, pose.z, pose.h, 0.0, 0.0, None, 0.0, spec.shape)
    member = CommandedActor(spec, unplaced, unplaced, None, road_map.cursor())
    if spec.shape.wheelbase > 0.0:
        member.wheels = Wheels(road)
    if spec.lane_bound and isinstance(at, LanePosition) and start.heading is None:
        member.settle(member.rebind(at, start.speed, road_map))
    else:
        if isinstance(at, LanePosition):
            member.turn_away()
        member.settle(member.free_state(pose, start.speed, 0.0, road_map))
    if start.aside:
        member.drift(start.aside, road_map)
    if start.tilt != LEVEL:
        member.tilt = start.tilt
        pitch, roll = start.tilt.over((member.state.pitch, member.state.roll))
        member.settle(member.state._replace(pitch=pitch, roll=roll))
    return member
