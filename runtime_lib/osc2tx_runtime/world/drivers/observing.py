"""Observations of an external driver, from the state of the world."""

from __future__ import annotations

import math

from osc2tx_runtime.opendrive import LanePosition, Pose, Route
from osc2tx_runtime.world.geometry.curve import turn_between
from osc2tx_runtime.world.measuring.distances import along_lanes, lateral_straight_on
from osc2tx_runtime.world.plant.scene import Scene, Setpoint
from osc2tx_runtime.world.state import ActorState
from osc2tx_runtime.world.surroundings.stop_lines_ahead import StopLines

from .driving import LaneView, Observation, OtherActor

ROUTE_STEP = 2.0
"""Metres between the positions of a route."""
ROUTE_LENGTH = 100.0
"""Length (m) of the route ahead."""
SIGHT = 200.0
"""Visual range (m) of other actors; in fog that of the weather counts."""


def observe(scene: Scene, setpoint: Setpoint, lines: StopLines) -> Observation:
    """The observation of the driver of an actor at the start of a step."""
    me, sight = setpoint.now, min(SIGHT, scene.environment.get("visual_range", math.inf))
    place, route = me.lane_position, setpoint.route
    return Observation(
        time=scene.step * scene.dt,
        speed=me.v,
        acceleration=me.a,
        pose=Pose(me.x, me.y, me.z, me.h, me.pitch, me.roll),
        shape=me.shape,
        limits=setpoint.limits,
        lane=None if place is None else _lane(scene, me, place),
        route=() if place is None else _route(scene, place, route),
        others=tuple(_others(scene, setpoint, sight)),
        stop_line=None if place is None else lines.ahead(place, route, me.shape.front, sight),
        lights=scene.lights[setpoint.spec.id],
    )


def _lane(scene: Scene, me: ActorState, place: LanePosition) -> LaneView:
    width = scene.map.lane_width(place.road, place.lane, place.s)
    return LaneView(place, width, turn_between(scene.map.pose(place).h, me.h))


def _route(scene: Scene, place: LanePosition, route: Route | None) -> tuple[Pose, ...]:
    centre = LanePosition(place.road, place.lane, place.s)
    places = []
    for _ in range(round(ROUTE_LENGTH / ROUTE_STEP)):
        step = scene.map.advance(centre, ROUTE_STEP, route)
        if step.travelled < ROUTE_STEP - 1e-3:
            break
        centre = step.position
        places.append(scene.map.pose(centre))
    return tuple(places)


def _others(scene: Scene, mine: Setpoint, sight: float) -> list[OtherActor]:
    found, me = [], mine.now
    for actor, other in scene.setpoints.items():
        state = other.now
        if other.spec is mine.spec or math.hypot(state.x - me.x, state.y - me.y) > sight:
            continue
        ahead, left = along_lanes(scene.map, me, state), lateral_straight_on(scene.map, me, state)
        pose = Pose(state.x, state.y, state.z, state.h, state.pitch, state.roll)
        found.append(OtherActor(actor, other.spec.kind, pose, state.v, state.shape, ahead, left))
    return found
