"""Projected motion of a reference (DSL 8.9.21, `track: projected`)."""

from __future__ import annotations

import math

from osc2tx_runtime.opendrive import LanePosition, RoadMap
from osc2tx_runtime.world.state import ActorState
from osc2tx_runtime.world.step_inputs import StepInputs


def projected(road_map: RoadMap, state: ActorState, seconds: float) -> ActorState:
    """State after a time at the same speed: in the same lane, off the lanes straight ahead."""
    way, place = state.v * seconds, state.lane_position
    if place is None:
        x, y = state.x + way * math.cos(state.h), state.y + way * math.sin(state.h)
        return state._replace(x=x, y=y, a=0.0)
    on = road_map.advance(place, way).position
    pose = road_map.pose(LanePosition(on.road, on.lane, on.s, place.offset))
    return state._replace(
        x=pose.x,
        y=pose.y,
        z=pose.z,
        h=pose.h,
        a=0.0,
        lane_position=LanePosition(on.road, on.lane, on.s, place.offset),
        lateral_speed=0.0,
    )


class Tracked:
    """A reference of a command: its actual motion, or the projected one from the first call."""

    __slots__ = ("_actor", "_first", "_projected", "_steps")

    def __init__(self, actor: str, projected: bool) -> None:
        self._actor = actor
        self._projected = projected
        self._first: ActorState | None = None
        self._steps = 0

    def state(self, inputs: StepInputs) -> ActorState:
        """Its state at the present step; called once per step."""
        if not self._projected:
            return inputs.state(self._actor)
        if self._first is None:
            self._first = inputs.state(self._actor)
        self._steps += 1
        return inputs.projected(self._first, (self._steps - 1) * inputs.dt)
