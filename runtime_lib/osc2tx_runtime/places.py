"""Where modifiers put an actor: on the map, beside or before another actor, at a point."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple, TypeVar

from osc2tx_runtime import opendrive
from osc2tx_runtime.errors import PlacementError, UnsupportedError
from osc2tx_runtime.modifiers import (
    Lane,
    Lateral,
    Modifier,
    Orient,
    Position,
    Speed,
    Yaw,
    value_of,
)
from osc2tx_runtime.opendrive import LanePosition, MapError, RoadMap
from osc2tx_runtime.values import OdrPoint
from osc2tx_runtime.world.lanes import lane_with_number, number_of_lane
from osc2tx_runtime.world.motion import ANY_LANE

if TYPE_CHECKING:
    from osc2tx_runtime.actors import PhysicalObject
    from osc2tx_runtime.world.protocol import World
    from osc2tx_runtime.world.state import ActorState

__all__ = ["Placer", "Spot", "heading_of", "place_of_odr"]

_MARGIN = 50.0  # m around the lanes that still belong to the map
_EXACT = 1e-7  # m to which a distance along the road is met
ModifierT = TypeVar("ModifierT", bound=Modifier)


class Spot(NamedTuple):
    """A place to be, with the state to be in.

    Attributes:
        at: Place on a lane, or pose of the reference point.
        speed: m/s; None if nothing says.
        heading: rad, for actors off the lanes; None if nothing says.
    """

    at: LanePosition | opendrive.Pose
    speed: float | None
    heading: float | None


class Placer:
    """Finds the place that modifiers describe, among the actors that are placed already."""

    def __init__(self, world: World) -> None:
        self._world = world
        self._map = world.map

    def spot(
        self,
        actor: PhysicalObject,
        modifiers: Sequence[Modifier],
        now: ActorState | None = None,
        *,
        spawn: LanePosition | None = None,
        is_free: Callable[[LanePosition], bool] = lambda _place: True,
    ) -> Spot:
        """Resolves modifiers to a place.

        Args:
            actor: Who is to be placed.
            modifiers: position, lane, lateral, speed, yaw, orientation.
            now: Its present state, if it has one: what modifiers leave open stays.
            spawn: Place given by the settings.
            is_free: Tells whether a default start place can be used.

        Raises:
            PlacementError: There is no such place.
        """
        speed = self._speed(modifiers)
        own_speed = speed if speed is not None else (0.0 if now is None else now.v)
        at = self._place(actor, modifiers, own_speed, now, spawn, is_free)
        lateral = one_of_kind(modifiers, Lateral)
        if lateral is not None and isinstance(at, LanePosition):
            at = LanePosition(at.road, at.lane, at.s, lateral.offset())
        heading = None
        if not (actor.lane_bound and isinstance(at, LanePosition)):
            pose = self._map.pose(at) if isinstance(at, LanePosition) else at
            heading = heading_of(self._world, actor, modifiers, pose)
        return Spot(at, speed, heading)

    # --- kinds of places ----------------------------------------------------------------------

    def _place(
        self,
        actor: PhysicalObject,
        modifiers: Sequence[Modifier],
        speed: float,
        now: ActorState | None,
        spawn: LanePosition | None,
        is_free: Callable[[LanePosition], bool],
    ) -> LanePosition | opendrive.Pose:
        position, lane = one_of_kind(modifiers, Position), one_of_kind(modifiers, Lane)
        if spawn is not None:
            return self._spawned(actor, spawn, lane, position)
        if position is not None and position.absolute:
            return self._at_point(actor, position)
        beside = None if lane is None else lane.reference
        reference = None if position is None else position.reference
        if beside is not None or reference is not None:
            return self._beside(actor, lane, position, speed)
        if now is not None and now.lane_position is not None:
            return self._from_here(actor, now.lane_position, lane, position)
        return self._default(actor, lane, position, is_free)

    def _spawned(
        self,
        actor: PhysicalObject,
        spawn: LanePosition,
        lane: Lane | None,
        position: Position | None,
    ) -> LanePosition:
        if position is not None or (lane is not None and lane.reference is not None):
            raise PlacementError(
                f"{actor.id}: the scenario says where it starts, so it takes no --spawn"
            )
        try:
            self._map.pose(spawn)
        except MapError as error:
            raise PlacementError(f"--spawn {actor.id}: {error.message}") from error
        length = self._map.roads[spawn.road].length
        if not 0.0 <= spawn.s <= length:
            raise PlacementError(
                f"--spawn {actor.id}: road {spawn.road} is {length:.1f} m long, so there is no"
                f" s = {spawn.s:g} m"
            )
        if lane is not None:
            number = number_of_lane(self._map, spawn, lane.from_)
            if number != lane.number:
                raise PlacementError(
                    f"--spawn {actor.id}: lane {spawn.lane} of road {spawn.road} is number"
                    f" {number} from the {lane.from_}, the scenario asks for {lane.number}"
                    if number
                    else f"--spawn {actor.id}: lane {spawn.lane} of road {spawn.road} is no"
                    " driving lane"
                )
        return spawn

    def _at_point(self, actor: PhysicalObject, position: Position) -> LanePosition | opendrive.Pose:
        pose, heading = _pose_of(actor, position)
        west, south, east, north = self._map.bounds()
        if not (
            west - _MARGIN <= pose.x <= east + _MARGIN
            and south - _MARGIN <= pose.y <= north + _MARGIN
        ):
            raise PlacementError(
                f"{actor.id}: ({pose.x:g}, {pose.y:g}) is off the map, which reaches from"
                f" ({west:.0f}, {south:.0f}) to ({east:.0f}, {north:.0f})"
            )
        z = None if position.z is None and position.at_point is None else pose.z
        types = opendrive.DRIVING if actor.lane_bound else ANY_LANE
        on = self._map.locate(pose.x, pose.y, z, heading, lane_types=types, max_distance=1e-3)
        if on is None:
            return pose
        lane = self._map.pose(on)
        if actor.lane_bound and math.cos(lane.h - (lane.h if heading is None else heading)) > 0.0:
            return on
        h = lane.h if heading is None else heading
        return opendrive.Pose(pose.x, pose.y, lane.z if z is None else z, h)

    def _beside(
        self, actor: PhysicalObject, lane: Lane | None, position: Position | None, speed: float
    ) -> LanePosition:
        reference = None if position is None else position.reference
        in_lane_of = None if lane is None else lane.reference
        start = self._centre(in_lane_of or reference, actor)
        if lane is not None and lane.side_of is not None and lane.side is not None:
            beside = self._map.neighbour(start, lane.side, lane.number) if lane.number else start
            if beside is None:
                raise PlacementError(
                    f"{actor.id}: there is no lane to the {lane.side} of {lane.side_of.id},"
                    f" which is in lane {start.lane} of road {start.road}"
                )
            start = beside
        if position is not None and reference is not None:
            start = self._at_distance(actor, start, position, speed)
        elif position is not None:
            start = self._along_road(actor, start, value_of(position.distance or 0.0))
        if lane is not None and in_lane_of is None:
            return self._numbered(actor, start, lane)
        return start

    def _at_distance(
        self, actor: PhysicalObject, start: LanePosition, position: Position, speed: float
    ) -> LanePosition:
        """Moves along the lane of `start` until the distance to the reference is right."""
        reference = position.reference
        assert reference is not None
        origin = self._centre(reference, actor)
        if position.time is not None:
            behind = self._world.state(reference.id).v if position.ahead_of is not None else speed
            wanted = value_of(position.time) * behind
        else:
            wanted = value_of(position.distance or 0.0)
        wanted = wanted if position.ahead_of is not None else -wanted
        place = start
        for _ in range(20):
            measured = self._map.route_distance(origin, place)
            if measured is None:
                break
            if abs(wanted - measured) < _EXACT:
                return place
            step = self._map.advance(place, wanted - measured)
            if abs(step.travelled - (wanted - measured)) > 1e-6:
                break
            place = step.position
        side = "ahead of" if wanted >= 0.0 else "behind"
        raise PlacementError(
            f"{actor.id}: the lane does not reach {abs(wanted):.1f} m {side} {reference.id}"
        )

    def _from_here(
        self,
        actor: PhysicalObject,
        here: LanePosition,
        lane: Lane | None,
        position: Position | None,
    ) -> LanePosition:
        place = LanePosition(here.road, here.lane, here.s)
        if position is not None:
            place = self._along_road(actor, place, value_of(position.distance or 0.0))
        return place if lane is None else self._numbered(actor, place, lane)

    def _default(
        self,
        actor: PhysicalObject,
        lane: Lane | None,
        position: Position | None,
        is_free: Callable[[LanePosition], bool],
    ) -> LanePosition:
        distance = None if position is None else value_of(position.distance or 0.0)
        for candidate in self._candidates(distance):
            place: LanePosition | None = candidate
            if lane is not None:
                place = lane_with_number(self._map, candidate, lane.number, lane.from_)
                if distance is None and place is not None and place.lane != candidate.lane:
                    continue
            if place is not None and is_free(place):
                return place
        wish = "" if lane is None else f" with a lane {lane.number} from the {lane.from_}"
        far = "" if distance is None else f", {distance:g} m from its start"
        raise PlacementError(
            f"{actor.id}: map {self._map.name} has no free place on a road{wish}{far}"
        )

    def _candidates(self, distance: float | None) -> Iterator[LanePosition]:
        """Default start places; with a distance, places so far from the start of each road."""
        if distance is None:
            yield from self._map.spawn_points()
            return
        starts: dict[tuple[str, int], None] = {}
        for point in self._map.spawn_points():
            direction = self._map.travel_direction(point.road, point.lane)
            if (point.road, direction) in starts:
                continue
            starts[point.road, direction] = None
            step = self._map.advance(_entry(self._map, point), distance)
            if abs(step.travelled - distance) < 1e-6:
                yield step.position

    # --- small steps --------------------------------------------------------------------------

    def _along_road(
        self, actor: PhysicalObject, place: LanePosition, distance: float
    ) -> LanePosition:
        start = _entry(self._map, place)
        step = self._map.advance(start, distance)
        if abs(step.travelled - distance) > 1e-6:
            raise PlacementError(
                f"{actor.id}: lane {place.lane} of road {place.road} ends after"
                f" {step.travelled:.1f} m, before {distance:g} m"
            )
        return step.position

    def _numbered(self, actor: PhysicalObject, place: LanePosition, lane: Lane) -> LanePosition:
        found = lane_with_number(self._map, place, lane.number, lane.from_)
        if found is None:
            raise PlacementError(
                f"{actor.id}: road {place.road} has no lane {lane.number} from the {lane.from_}"
                f" at s = {place.s:.1f} m"
            )
        return found

    def _centre(self, of: PhysicalObject | None, actor: PhysicalObject) -> LanePosition:
        """Place of a placed actor, on the centre of its driving lane."""
        assert of is not None
        state = self._world.state(of.id)
        on = self._map.locate(state.x, state.y, state.z, hint=state.lane_position)
        if on is None:
            raise PlacementError(f"{actor.id}: {of.id} is not on a road, so it has no lane")
        return LanePosition(on.road, on.lane, on.s)

    def _speed(self, modifiers: Sequence[Modifier]) -> float | None:
        speed = one_of_kind(modifiers, Speed)
        if speed is None:
            return None
        if speed.reference is None:
            return speed.difference()
        return speed.factor * self._world.state(speed.reference.id).v + speed.difference()


def one_of_kind(modifiers: Sequence[Modifier], kind: type[ModifierT]) -> ModifierT | None:
    """The only modifier of a kind; None without one."""
    found = [modifier for modifier in modifiers if isinstance(modifier, kind)]
    if len(found) > 1:
        raise PlacementError(f"{found[0].name} is given {len(found)} times")
    return found[0] if found else None


def heading_of(
    world: World,
    actor: PhysicalObject,
    modifiers: Sequence[Modifier],
    at: opendrive.Pose | ActorState,
) -> float | None:
    """Heading (rad) that yaw or orientation ask for; None if they are not given.

    Args:
        world: The world.
        actor: Who is to turn.
        modifiers: Those of an action or a placement.
        at: Where the actor is.
    """
    turned = one_of_kind(modifiers, Yaw) or one_of_kind(modifiers, Orient)
    if turned is None:
        return None
    if isinstance(turned, Orient):
        angle, base = value_of(turned.yaw), 0.0
    else:
        angle, base = value_of(turned.angle), _road_heading(world.map, at)
        if turned.measure_by == "relative_to_north":
            base = 0.5 * math.pi
    if turned.relative_to is not None:
        base = world.state(turned.relative_to.id).h
    if actor.lane_bound and not isinstance(at, opendrive.Pose) and at.lane_position is not None:
        raise UnsupportedError(f"{actor.id} follows its lane, so it takes no {turned.name}")
    return base + angle


def _road_heading(road_map: RoadMap, at: opendrive.Pose | ActorState) -> float:
    """Direction of travel of the lane under a point (rad); 0 off the road."""
    on = road_map.locate(at.x, at.y, at.z, lane_types=ANY_LANE, max_distance=1e-3)
    return 0.0 if on is None else road_map.pose(on).h


def _entry(road_map: RoadMap, place: LanePosition) -> LanePosition:
    """Where the lane of a place begins on its road, in direction of travel."""
    length = road_map.roads[place.road].length
    back = place.s if road_map.travel_direction(place.road, place.lane) > 0 else length - place.s
    lane = place
    while back > 0.0:
        step = road_map.advance(lane, -back)
        if step.position.road != place.road or abs(step.travelled) < 1e-9:
            break
        lane = step.position
        rest = lane.s if road_map.travel_direction(place.road, place.lane) > 0 else length - lane.s
        if rest < 1e-6 or rest >= back:
            break
        back = rest
    return LanePosition(lane.road, lane.lane, lane.s)


def _pose_of(actor: PhysicalObject, position: Position) -> tuple[opendrive.Pose, float | None]:
    """Pose of the reference point, and the heading if one is given."""
    if position.at_point is not None:
        point = position.at_point
        return opendrive.Pose(point.x, point.y, point.z, 0.0), None
    x, y, z = position.x or 0.0, position.y or 0.0, position.z or 0.0
    heading = None if position.h is None else float(position.h)
    if position.frame == "world":
        return opendrive.Pose(x, y, z, heading or 0.0), heading
    heading = None if heading is None else -heading
    h = heading or 0.0
    back = actor.shape.centre  # CARLA places the box centre
    return opendrive.Pose(x - back * math.cos(h), -y - back * math.sin(h), z, h), heading


def place_of_odr(road_map: RoadMap, point: OdrPoint) -> LanePosition | opendrive.Pose:
    """Place of a point in road coordinates."""
    try:
        if point.lane_id is None:
            return road_map.road_pose(point.road_id, point.s, point.t)
        lane = int(point.lane_id)
        place = LanePosition(point.road_id, lane, point.s)
        road_map.pose(place)
        left = point.t * road_map.travel_direction(point.road_id, lane)
        return LanePosition(point.road_id, lane, point.s, left)
    except MapError as error:
        raise PlacementError(error.message) from error
