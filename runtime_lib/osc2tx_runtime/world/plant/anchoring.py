"""Measured actors, and the states from which their references continue.

The reference of a driven actor keeps its speed and its lateral position, and is set abreast of the
actor along the path: otherwise half of each speed error would accumulate, and both would diverge.
Of an actor with an external driver, the measured state is the reference.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping

from osc2tx_runtime.opendrive import DRIVING, LanePosition, RoadMap
from osc2tx_runtime.world.geometry.lane_neighbours import seen_along
from osc2tx_runtime.world.geometry.lane_return import abreast
from osc2tx_runtime.world.measuring.deviation import STANDSTILL
from osc2tx_runtime.world.measuring.measurement import MeasuredMotion, Measurement
from osc2tx_runtime.world.motion.actor_motion import CommandedActor
from osc2tx_runtime.world.motion.couplings import Couplings
from osc2tx_runtime.world.protocol import LATERAL, LONGITUDINAL
from osc2tx_runtime.world.state import ActorState
from osc2tx_runtime.world.tracking.tracking import Tracking


def arrive(
    cast: Mapping[str, CommandedActor],
    commanded: list[ActorState],
    found: Mapping[str, Measurement],
    jumped: Collection[str],
    couplings: Couplings,
    road_map: RoadMap,
    dt: float,
) -> list[ActorState]:
    """Set the actors to their new states.

    Args:
        cast: The actors.
        commanded: Their commanded states, in the same order.
        found: The measured states; the other actors are exact.
        jumped: Teleported actors; a teleport is no motion.
        couplings: The trailers; they follow their towing vehicles.
        road_map: The map.
        dt: Length of the step (s); 0 before step 0.

    Returns:
        Their states, in the same order.
    """
    members = tuple(cast.values())
    for actor in jumped:
        cast[actor].motion = None
    measured = {actor for actor in found if not couplings.is_towed(actor)}
    states = [
        (
            measured_state(member, found[member.spec.id], road_map, dt)
            if member.spec.id in measured
            else target
        )
        for member, target in zip(members, commanded, strict=True)
    ]
    if dt:
        couplings.draw(cast, states, dt, road_map)
    for member, state, target in zip(members, states, commanded, strict=True):
        if member.spec.id not in measured:
            member.settle(state)
            member.motion = member.tracking = None
        elif member.follows:
            track(member, state, target, road_map, dt)
        else:
            observe(member, state, road_map)
    return states


def track(
    member: CommandedActor, state: ActorState, commanded: ActorState, road_map: RoadMap, dt: float
) -> None:
    """Set a driven actor to its measured state, and its reference abreast of it."""
    member.state = state
    member.upset()
    member.reference = anchored(member, commanded, road_map)
    if member.tracking is None:
        member.tracking = Tracking()
    wished_progress = {LONGITUDINAL: member.speed_progress(), LATERAL: member.side_progress()}
    member.tracking.step(state, member.reference, wished_progress, dt)


def observe(member: CommandedActor, state: ActorState, road_map: RoadMap) -> None:
    """Set an actor with an external driver to its measured state."""
    member.settle(state)
    place = state.lane_position
    if place is not None and road_map.lane_type(place.road, place.lane, place.s) not in DRIVING:
        place = None
    member.bound = place if member.spec.lane_bound else None


def measured_state(
    member: CommandedActor, found: Measurement, road_map: RoadMap, dt: float
) -> ActorState:
    """State of a measured actor, with its lane and its motion on it."""
    before = member.state
    pose, (forwards, left, up) = found.pose, found.velocity
    forwards = forwards * math.cos(pose.pitch) + up * math.sin(pose.pitch)  # on the ground
    on = member.lane_at(pose, before.lane_position, road_map)
    rate = 0.0
    if on is not None:
        if member.spec.lane_bound:
            on = seen_along(road_map, on, pose.h)
        turn = pose.h - road_map.pose(on).h
        rate = forwards * math.sin(turn) + left * math.cos(turn)
    if member.motion is None or not dt:
        member.motion = MeasuredMotion(found)
    else:
        member.motion.step(found, dt)
    if abs(forwards) < STANDSTILL:
        forwards = 0.0
    x, y, z, h, pitch, roll = pose
    return ActorState(
        x, y, z, h, forwards, member.motion.forwards, on, rate, before.shape, pitch, roll
    )


def anchored(member: CommandedActor, commanded: ActorState, road_map: RoadMap) -> ActorState:
    """The reference of an actor abreast of its measured state.

    Args:
        member: The actor, with its measured state.
        commanded: The reference at the end of the step.
        road_map: The map.
    """
    state = member.state
    along = (state.x - commanded.x) * math.cos(commanded.h) + (state.y - commanded.y) * math.sin(
        commanded.h
    )
    member.slid(along)
    bound = member.bound
    if bound is None:
        x, y = (
            commanded.x + along * math.cos(commanded.h),
            commanded.y + along * math.sin(commanded.h),
        )
        return commanded._replace(x=x, y=y)
    left = member.left or bound
    on = abreast(road_map, LanePosition(left.road, left.lane, left.s), state, member.route)
    if on is None:
        return commanded
    member.bound = LanePosition(on.road, on.lane, on.s, bound.offset)
    return member.on_lane(member.bound, commanded.v, commanded.lateral_speed, commanded.a, road_map)
