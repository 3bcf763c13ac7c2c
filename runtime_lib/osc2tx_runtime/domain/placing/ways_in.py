"""The search for ways in: from the required position of an actor back to the start of the run."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import ceil, cos, hypot, sin
from typing import TYPE_CHECKING, NamedTuple

from osc2tx_runtime.domain.placing.entries import WayIn
from osc2tx_runtime.errors import PlacementError
from osc2tx_runtime.opendrive import LanePosition, Pose
from osc2tx_runtime.world.actor_dimensions import COMFORT, Limits, Shape
from osc2tx_runtime.world.geometry.attitude import Tilt
from osc2tx_runtime.world.measuring.collision import Box, box_of, overlapped
from osc2tx_runtime.world.state import ActorState
from osc2tx_shared.classes import replace

if TYPE_CHECKING:
    from osc2tx_runtime.opendrive import RoadMap

Boxes = Sequence[dict[str, Box]]
"""The space that actors occupy, at each step from the start of the run."""

_FASTER = (5.0, 10.0, 15.0, 20.0, 25.0)  # m/s above the speed of arrival
_EFFORTS = (COMFORT, 1.0)  # shares of the limits of the actor
_EARLIER = (0.0, 0.25, 0.5, 0.75, 1.0)  # share of the time by which it starts earlier
_NEAR = 1e-6  # m
_SAME = 1e-3  # m, m/s


class Arrival(NamedTuple):
    """Required state of an actor when its first action begins.

    Attributes:
        actor: The actor that enters.
        step: Step of the arrival.
        at: Position on a lane, or pose.
        speed: m/s.
        heading: rad; None along the lane.
        tilt: Pitch and roll.
        fixed: Whether the position is stated; else the actor may start there and arrive at another
            one.
        shape: Its size.
        limits: Its limits of motion.
        follows_lanes: Whether it drives along lanes; other actors move straight.
        source: Source position of its first action.
        can_jump: Whether it is teleported there without a way in.
    """

    actor: str
    step: int
    at: LanePosition | Pose
    speed: float
    heading: float | None
    tilt: Tilt
    fixed: bool
    shape: Shape
    limits: Limits
    follows_lanes: bool
    source: str
    can_jump: bool

    def is_like(self, other: Arrival, road_map: RoadMap) -> bool:
        """Return whether both are equal, if the position is stated."""
        if self.step != other.step or abs(self.speed - other.speed) > _SAME:
            return False
        here, there = self.pose(road_map), other.pose(road_map)
        return not self.fixed or hypot(here.x - there.x, here.y - there.y) < _SAME

    def pose(self, road_map: RoadMap) -> Pose:
        """Return its pose."""
        return road_map.pose(self.at) if isinstance(self.at, LanePosition) else self.at


def way_in(
    arrival: Arrival, road_map: RoadMap, others: Boxes, dt: float, missed: float = 0.0
) -> WayIn | None:
    """Return the first free way in on the map.

    None if there is none and the actor can be teleported.

    Args:
        arrival: The state to arrive in.
        road_map: The map.
        others: The space that the other actors occupy; that of the way in is added.
        dt: Length of a step (s).
        missed: Distance (m) by which this way in was too short in an earlier attempt.

    Raises:
        PlacementError: There is none, and the actor cannot be teleported; the message has the
            reason for the most natural one.
    """
    reasons: list[str] = []
    for speed, changes, changed in _speeds(arrival, dt):
        at, target = arrival.at, arrival.speed
        way = WayIn(
            *(at, at, arrival.step, speed, target, changes, changed),
            *(arrival.heading, arrival.tilt),
        )
        length = way.covered(way.arrives, dt) - missed
        try:
            if arrival.fixed:
                way = replace(way, start=_back(arrival, road_map, length))
            else:
                way = replace(way, goal=_back(arrival, road_map, -length))
            rooms = _rooms(way, arrival, road_map, dt)
        except _NoRoad as error:
            reasons.append(str(error))
            continue
        blocked = _blocked(rooms, arrival.actor, others, dt)
        if blocked is None:
            for boxes, room in zip(others, rooms, strict=False):
                boxes[arrival.actor] = room
            return way
        reasons.append(blocked)
    if arrival.can_jump:
        return None
    raise PlacementError(
        f"{arrival.actor} has no way in to where its first action begins at"
        f" {arrival.step * dt:.2f} s: {reasons[0]}",
        arrival.source,
    )


class _NoRoad(Exception):
    """The map is too short behind the arrival for a way in."""


def _speeds(arrival: Arrival, dt: float) -> Iterator[tuple[float, int, int]]:
    """Yield speeds (m/s) at the start, with the steps between which they change.

    Vehicles keep their speed if possible; other actors wait and start as late as possible.
    """
    target, last = arrival.speed, arrival.step
    steady = (target, last, last)
    turned = arrival.heading is not None and arrival.follows_lanes
    if last == 0 or target < 0.0 or turned:
        yield steady
        return
    rolls = target == 0.0 or (arrival.fixed and arrival.follows_lanes)
    if rolls:
        yield steady
    for effort in _EFFORTS if target > 0.0 else ():
        steps = _steps(target, effort * arrival.limits.acceleration, dt)
        for share in _EARLIER if steps <= last else ():
            begin = round((last - steps) * (1.0 - share))
            yield 0.0, begin, begin + steps
    if not rolls:
        yield steady
    for effort in _EFFORTS if arrival.follows_lanes else ():
        for more in _FASTER:
            steps = _steps(more, effort * arrival.limits.deceleration, dt)
            if steps <= last:
                yield target + more, last - steps, last


def _steps(change: float, rate: float, dt: float) -> int:
    return ceil(change / (rate * dt) - 1e-9)


def _back(arrival: Arrival, road_map: RoadMap, distance: float) -> LanePosition | Pose:
    """Return the position at a distance (m) before that of an arrival.

    Raises:
        _NoRoad: The lane begins after it.
    """
    at = arrival.at
    if isinstance(at, LanePosition) and arrival.follows_lanes and arrival.heading is None:
        step = road_map.advance(at, -distance)
        if abs(step.travelled + distance) > _NEAR:
            raise _NoRoad(
                f"{abs(distance):.1f} m of road are needed, and there are"
                f" {abs(step.travelled):.1f} m"
            )
        return step.position
    if not distance:
        return at
    pose = arrival.pose(road_map)
    h = pose.h if arrival.heading is None else arrival.heading
    if arrival.follows_lanes and isinstance(at, LanePosition):
        raise _NoRoad("its heading deviates from its lane while it moves")
    return Pose(pose.x - distance * cos(h), pose.y - distance * sin(h), pose.z, h)


def _rooms(way: WayIn, arrival: Arrival, road_map: RoadMap, dt: float) -> list[Box]:
    """Return the space that an actor occupies on its way in, at each step up to its arrival."""
    whole, boxes = way.covered(way.arrives, dt), list[Box]()
    from_goal = arrival._replace(at=way.goal)
    for step in range(way.arrives + 1):
        place = _back(from_goal, road_map, whole - way.covered(step, dt))
        pose = road_map.pose(place) if isinstance(place, LanePosition) else place
        h = pose.h if way.heading is None else way.heading
        state = ActorState(pose.x, pose.y, pose.z, h, 0, 0, None, 0, arrival.shape)
        boxes.append(box_of(state))
    return boxes


def _blocked(rooms: Sequence[Box], actor: str, others: Boxes, dt: float) -> str | None:
    """Return the blocking actor, and the time; None if there is none."""
    for step, (room, boxes) in enumerate(zip(rooms, others, strict=False)):
        for other in overlapped(room, boxes):
            if other != actor:
                return f"{other} blocks its path at {step * dt:.2f} s"
    return None
