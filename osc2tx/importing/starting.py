"""Where the entities of a document begin, and what lies ahead of them."""

from __future__ import annotations

import math
from collections.abc import Iterator

from osc2tx.xosc.element import Element
from osc2tx.xosc.player.bodies import Body
from osc2tx_runtime.opendrive import LanePosition, MapError, RoadMap

STRAIGHT = 1e-4  # rad
LOOK, MOST_LOOKS = 10.0, 300  # m: how a lane is looked along where it is not even


def privates(root: Element) -> list[Element]:
    """Return the actions of `Init`, by entity."""
    board = next((each for each in root.children if each.tag == "Storyboard"), None)
    init = (
        None
        if board is None
        else next((each for each in board.children if each.tag == "Init"), None)
    )
    return [] if init is None else [node for node in init.walk() if node.tag == "Private"]


def teleports(private: Element) -> list[Element]:
    """Return the place at which an entity is put, if it is."""
    return [
        position
        for action in private.walk()
        if action.tag == "TeleportAction"
        for position in action.children
        if position.tag == "Position"
    ][-1:]


def behind_teleports(private: Element) -> Iterator[Element]:
    """Yield the elements of a private behind its last teleport, which ends ways before it."""
    nodes = list(private.walk())
    last = max((at for at, each in enumerate(nodes) if each.tag == "TeleportAction"), default=-1)
    yield from nodes[last + 1 :]


def speed_at_start(private: Element) -> float:
    """Return the speed (m/s) that a resolved private sets; 0 if it is none by itself."""
    speeds = [each for each in private.walk() if each.tag == "AbsoluteTargetSpeed"]
    try:
        return float(speeds[-1].get("value") or 0.0) if speeds else 0.0
    except ValueError:
        return 0.0


def is_ahead(body: Body, other: Body) -> bool:
    """Whether an entity begins ahead of another one."""
    (x, y, h), there = other.here, body.here
    return (there.x - x) * math.cos(h) + (there.y - y) * math.sin(h) > 0.0


def is_straight_ahead(road_map: RoadMap | None, body: Body | None, *, beside: bool) -> bool:
    """Whether the lane of an entity leads straight on from its place at the start.

    Args:
        road_map: The map.
        body: The entity.
        beside: Whether the lanes beside it have to as well, to which it may change.
    """
    if road_map is None or body is None or body.place is None:
        return False
    try:
        return _is_straight(road_map, body.place, body, set() if beside else None)
    except (MapError, LookupError):
        return False


def _is_straight(
    road_map: RoadMap, place: LanePosition, body: Body, known: set[tuple[str, int]] | None
) -> bool:
    """Whether a lane leads straight on.

    Args:
        road_map: The map.
        place: Where the lane begins to count.
        body: The entity.
        known: The lanes that are looked along already, if those beside each one count.
    """
    heading, cursor = road_map.pose(place).h, road_map.cursor()
    for _ in range(MOST_LOOKS):
        for other in () if known is None else _beside(road_map, place, body.along, known):
            if not _is_straight(road_map, other, body, known):
                return False
        look, even = LOOK, cursor.stretch(place._replace(offset=0.0))
        if even is not None and even.curvature == 0.0:
            is_along_s = even.direction * body.along > 0
            look = max(LOOK, even.end - place.s if is_along_s else place.s - even.begin)
        ahead = road_map.advance(place, look * body.along)
        place = ahead.position
        if abs(wrapped(road_map.pose(place).h - heading)) > STRAIGHT:
            return False
        if abs(ahead.travelled) < look:
            return True
    return False


def _beside(
    road_map: RoadMap, place: LanePosition, along: int, known: set[tuple[str, int]]
) -> Iterator[LanePosition]:
    """Yield where other lanes of the same direction begin on the rest of a road, if not known.

    Those of exits begin behind the place.
    """
    known.add((place.road, place.lane))
    goes_up = road_map.travel_direction(place.road, place.lane) * along > 0
    for section in road_map.roads[place.road].sections:
        if section.end <= place.s if goes_up else section.begin > place.s:
            continue
        s = max(section.begin, place.s) if goes_up else min(section.end, place.s)
        for lane in section.lanes.values():
            is_beside = lane.id * place.lane > 0 and lane.type == "driving"
            if is_beside and (place.road, lane.id) not in known:
                known.add((place.road, lane.id))
                yield LanePosition(place.road, lane.id, s)


def wrapped(angle: float) -> float:
    """Return an angle (rad) between -pi and pi."""
    return math.atan2(math.sin(angle), math.cos(angle))
