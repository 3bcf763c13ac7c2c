"""Distances and times between two actors (OpenSCENARIO DSL 8.7.3.1, 8.7.6.1).

Signs: `object_distance` and `road_distance` are positive if the reference is ahead of (left of,
above) the caller. Gaps are positive if the caller is ahead (left), headways if it follows.
"""

from __future__ import annotations

import math

from osc2tx_runtime.enums import DistanceDirection, DistanceMode
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.opendrive import DRIVING, LanePosition, Pose, RoadMap
from osc2tx_runtime.world.actor_dimensions import Shape
from osc2tx_runtime.world.state import ActorState

from .collision import Box, box_of, contact_interval

# --- in the axes of an object ------------------------------------------------------------------


def object_distance(
    caller: ActorState, reference: ActorState, direction: DistanceDirection, mode: DistanceMode
) -> float:
    """Position of the reference in the axes of the caller, or its distance (m).

    With `bounding_boxes` the distance is between the nearest faces along the axis (0 if the boxes
    overlap on it), or between the nearest points for `euclidean`.
    """
    if mode == "bounding_boxes":
        return _box_distance(caller, reference, direction)
    dx, dy, dz = reference.x - caller.x, reference.y - caller.y, reference.z - caller.z
    match direction:
        case "longitudinal":
            return dx * math.cos(caller.h) + dy * math.sin(caller.h)
        case "lateral":
            return dy * math.cos(caller.h) - dx * math.sin(caller.h)
        case "vertical":
            return dz
        case "euclidean":
            return math.sqrt(dx * dx + dy * dy + dz * dz)
    raise ScenarioError(f"`{direction}` is not a direction of a distance")


def _box_distance(caller: ActorState, reference: ActorState, direction: DistanceDirection) -> float:
    a, b = box_of(caller), box_of(reference)
    if direction == "vertical":
        return _between(a.low, a.high, b.low, b.high)
    if direction == "euclidean":
        return math.hypot(_flat_distance(a, b), _between(a.low, a.high, b.low, b.high))
    across = direction == "lateral"
    ux, uy = (-a.sin, a.cos) if across else (a.cos, a.sin)
    own = a.half_width if across else a.half_length
    middle = (b.x - a.x) * ux + (b.y - a.y) * uy
    reach = b.half_length * abs(b.cos * ux + b.sin * uy)
    reach += b.half_width * abs(b.cos * uy - b.sin * ux)
    return _between(-own, own, middle - reach, middle + reach)


def _between(low_a: float, high_a: float, low_b: float, high_b: float) -> float:
    """Signed distance from interval a to interval b; 0 if they overlap."""
    if low_b > high_a:
        return low_b - high_a
    return high_b - low_a if high_b < low_a else 0.0


def _flat_distance(a: Box, b: Box) -> float:
    """Distance between two boxes on the ground: from each corner to the other box."""
    if contact_interval(a, b, 0.0, 0.0) is not None:
        return 0.0
    return min(_corner_distance(a, b), _corner_distance(b, a))


def _corner_distance(a: Box, b: Box) -> float:
    nearest = math.inf
    for i in (-1.0, 1.0):
        for j in (-1.0, 1.0):
            dx = b.x + i * b.half_length * b.cos - j * b.half_width * b.sin - a.x
            dy = b.y + i * b.half_length * b.sin + j * b.half_width * b.cos - a.y
            out_x = max(abs(dx * a.cos + dy * a.sin) - a.half_length, 0.0)
            out_y = max(abs(dy * a.cos - dx * a.sin) - a.half_width, 0.0)
            nearest = min(nearest, math.hypot(out_x, out_y))
    return nearest


# --- along the lanes ---------------------------------------------------------------------------


def along_lanes(road_map: RoadMap, a: ActorState, b: ActorState) -> float | None:
    """Route distance (m) between reference points, positive if b is ahead; None without a route."""
    place_a, place_b = a.lane_position, b.lane_position
    if place_a is not None and place_b is not None:
        along = road_map.route_distance(place_a, place_b)
        if along is not None:
            return along
    # An actor is beside the driving lanes (a person on a sidewalk): its nearest driving lane
    # counts.
    place_a, place_b = _on_lane(road_map, a), _on_lane(road_map, b)
    if place_a is None or place_b is None:
        return None
    return road_map.route_distance(place_a, place_b)


def _on_lane(road_map: RoadMap, state: ActorState) -> LanePosition | None:
    """The position of an actor; beside the driving lanes the nearest position on one of them."""
    place = state.lane_position
    if place is not None and road_map.lane_type(place.road, place.lane, place.s) in DRIVING:
        return place
    return road_map.locate(state.x, state.y, state.z)


def lateral_on_road(road_map: RoadMap, a: ActorState, b: ActorState) -> float | None:
    """Lateral distance (m) of b to the left of a, in the lane of a abreast of b.

    On other roads that is the lane on the route between them.
    """
    place, there = _on_lane(road_map, a), _on_lane(road_map, b)
    along = along_lanes(road_map, a, b)
    if place is None or there is None:
        return None
    if along is None:
        beside = _beside_oncoming(place, there, road_map)
        return None if beside is None else _left_of(road_map.pose(beside), b)
    if place.road == there.road:
        return _left_of(road_map.pose(road_map.advance(place, along).position), b)
    if along < 0.0:  # the route forks towards a
        return -_left_of(_on_way_to(road_map, there, -along, place), a)
    return _left_of(_on_way_to(road_map, place, along, there), b)


def lateral_straight_on(road_map: RoadMap, a: ActorState, b: ActorState) -> float | None:
    """As `lateral_on_road`, in the lane in which a gets abreast of b without lane changes."""
    place, along = _on_lane(road_map, a), along_lanes(road_map, a, b)
    if place is None or along is None:
        return None
    return _left_of(road_map.pose(road_map.advance(place, along).position), b)


def _on_way_to(road_map: RoadMap, place: LanePosition, along: float, goal: LanePosition) -> Pose:
    return road_map.pose(road_map.advance(place, along, road_map.route_to(goal)).position)


def _left_of(pose: Pose, state: ActorState) -> float:
    left = (state.y - pose.y) * math.cos(pose.h) - (state.x - pose.x) * math.sin(pose.h)
    return left / math.cos(pose.roll) if pose.roll else left


def along_own_lane(road_map: RoadMap, a: ActorState, b: ActorState) -> float | None:
    """As `along_lanes`; to an actor in a lane of oncoming traffic along the lane of a."""
    along = along_lanes(road_map, a, b)
    place, there = _on_lane(road_map, a), _on_lane(road_map, b)
    if along is not None or place is None or there is None:
        return along
    beside = _beside_oncoming(place, there, road_map)
    return None if beside is None else road_map.route_distance(place, beside)


def _beside_oncoming(
    place: LanePosition, there: LanePosition, road_map: RoadMap
) -> LanePosition | None:
    """The position in a lane abreast of one in a lane of oncoming traffic on its road."""
    if there.road != place.road or there.lane * place.lane > 0:
        return None
    section = road_map.roads[place.road].section_at(there.s)
    return place._replace(s=there.s) if place.lane in section.lanes else None


def is_oncoming(a: ActorState, b: ActorState) -> bool:
    """Whether two actors are in lanes of opposite direction on one road."""
    here, there = a.lane_position, b.lane_position
    if here is None or there is None:
        return False
    return here.road == there.road and here.lane * there.lane < 0


def drift(a: ActorState, b: ActorState) -> float:
    """The lateral speed (m/s) of b, to the left in the direction of a."""
    return -b.lateral_speed if is_oncoming(a, b) else b.lateral_speed


def along_road(road_map: RoadMap, a: ActorState, b: ActorState) -> float | None:
    """Difference of s (m) on one road, positive if b is ahead of a; None on different roads."""
    found = _on_one_road(road_map, a, b)
    if found is None:
        return None
    place_a, place_b = found
    return road_map.travel_direction(place_a.road, place_a.lane) * (place_b.s - place_a.s)


def across_road(road_map: RoadMap, a: ActorState, b: ActorState) -> float | None:
    """Difference of t (m) on one road, positive if b is left of a; None on different roads."""
    found = _on_one_road(road_map, a, b)
    if found is None:
        return None
    place_a, place_b = found
    difference = _beside_reference(road_map, place_b, b) - _beside_reference(road_map, place_a, a)
    return road_map.travel_direction(place_a.road, place_a.lane) * difference


def _on_one_road(
    road_map: RoadMap, a: ActorState, b: ActorState
) -> tuple[LanePosition, LanePosition] | None:
    place_a, place_b = _on_lane(road_map, a), _on_lane(road_map, b)
    if place_a is None or place_b is None or place_a.road != place_b.road:
        return None
    return place_a, place_b


def _beside_reference(road_map: RoadMap, place: LanePosition, state: ActorState) -> float:
    """The t (m) of an actor: to the left of the reference line of its road, on the surface."""
    return _left_of(road_map.road_pose(place.road, place.s, 0.0), state)


def gap_between(along: float, caller: Shape, other: Shape) -> float:
    """Space gap (m) from facing end to facing end; positive if the caller is ahead.

    Args:
        along: Route distance from the other actor to the caller (m).
        caller: Shape of the caller.
        other: Shape of the other actor.
    """
    if along >= 0.0:
        return max(along - caller.rear - other.front, 0.0)
    return min(along + caller.front + other.rear, 0.0)


def headway_between(along: float, caller: Shape, other: Shape) -> float:
    """Distance (m) from front to front, positive if the caller is ahead; `along` as above.

    Note the sign: `space_headway` of the DSL is the negative of it.
    """
    return along + caller.front - other.front


def side_gap(lateral: float, caller: Shape, other: Shape) -> float:
    """Space (m) between facing sides; positive if the caller is to the left of the other actor.

    Args:
        lateral: Lateral distance of the other actor to the left of the caller (m).
        caller: Shape of the caller.
        other: Shape of the other actor.
    """
    reach = 0.5 * (caller.width + other.width)
    if abs(lateral) <= reach:
        return 0.0
    return -lateral - math.copysign(reach, -lateral)


def time_to_cover(distance: float, speed: float) -> float:
    """Distance over speed (s); infinite with the sign of the distance at standstill."""
    if distance == 0.0:
        return 0.0
    return math.copysign(math.inf, distance) if speed <= 0.0 else distance / speed


def time_to_collision(caller: ActorState, reference: ActorState) -> float:
    """Time (s) until both boxes touch if both keep their velocity; infinite if they never do."""
    a, b = box_of(caller), box_of(reference)
    if a.low > b.high or b.low > a.high:
        return math.inf
    dx = reference.v * b.cos - caller.v * a.cos
    dy = reference.v * b.sin - caller.v * a.sin
    found = contact_interval(a, b, dx, dy)
    if found is None or found[1] < 0.0:
        return math.inf
    return max(found[0], 0.0)
