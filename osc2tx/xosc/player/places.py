"""Positions of a document as places on a map."""

from __future__ import annotations

import math
from collections.abc import Mapping

from osc2tx.xosc import elements as xml
from osc2tx.xosc.element import Element
from osc2tx.xosc.player.bodies import Body, Pose
from osc2tx.xosc.player.courses import number
from osc2tx.xosc.player.errors import Unplayable
from osc2tx.xosc.player.shapes import Way, lengths_of, on_way, way_of
from osc2tx_runtime.opendrive import Lane, LanePosition, RoadMap

Place = tuple[LanePosition | Pose, float | None]  # with the heading (rad), if it states one


def place_of(node: Element, bodies: Mapping[str, Body], road_map: RoadMap) -> Place:
    """Return the place of the element below `Position`."""
    orientation = node.find(xml.Orientation)
    match node.tag:
        case "LanePosition":
            road, lane = node.said("roadId"), int(number(node, "laneId"))
            s, offset = number(node, "s"), number(node, "offset")
            # the t axis of a lane is that of its road; lane 0 has no width
            where: LanePosition | Pose = (
                LanePosition(road, lane, s, offset * road_map.travel_direction(road, lane))
                if lane
                else _flat(road_map.road_pose(road, s, offset))
            )
        case "RoadPosition":
            road, s, t = node.said("roadId"), number(node, "s"), number(node, "t")
            where = _flat(road_map.road_pose(road, s, t))
        case "WorldPosition":
            where = Pose(number(node, "x"), number(node, "y"), number(node, "h"))
        case "RelativeWorldPosition":
            x, y, h = bodies[node.said("entityRef")].here
            where = Pose(x + number(node, "dx"), y + number(node, "dy"), h)
        case "RelativeObjectPosition":
            x, y, h = bodies[node.said("entityRef")].here
            dx, dy = number(node, "dx"), number(node, "dy")
            where = Pose(
                x + dx * math.cos(h) - dy * math.sin(h), y + dx * math.sin(h) + dy * math.cos(h), h
            )
        case "RelativeRoadPosition":
            lane_ = bodies[node.said("entityRef")].in_lane(road_map)
            t = centre(road_map, lane_) + number(node, "dt")
            where = _flat(road_map.road_pose(lane_.road, lane_.s + number(node, "ds"), t))
        case "RelativeLanePosition":
            where = _beside(node, bodies[node.said("entityRef")], road_map)
        case "RoutePosition":
            where = _on_route(node, bodies, road_map)
        case "TrajectoryPosition":
            where = _on_trajectory(node, bodies, road_map)
        case "GeoPosition":
            latitude, longitude = (_degrees(node, name) for name in ("latitude", "longitude"))
            where = Pose(*road_map.geo_reference.project(latitude, longitude), 0.0)
        case _:
            raise Unplayable(f"<{node.tag}> is not played", node.place)
    return where, _heading(orientation, where, node, bodies, road_map)


def _degrees(node: Element, name: str) -> float:
    degrees = node.get(f"{name}Deg")
    return number(node, name) if degrees is None else math.radians(float(degrees))


def _heading(
    orientation: xml.Orientation | None,
    where: LanePosition | Pose,
    node: Element,
    bodies: Mapping[str, Body],
    road_map: RoadMap,
) -> float | None:
    """Return the heading of a position.

    A relative orientation turns from the direction of the lane or the road, or of the reference.
    """
    if orientation is None:
        return None
    h = orientation.h
    if orientation.type == "absolute":
        return h
    if node.tag == "RelativeWorldPosition":
        return h + bodies[node.said("entityRef")].here.h
    if isinstance(where, Pose):
        return h + where.h
    pose = road_map.pose(where)
    with_s = road_map.travel_direction(where.road, where.lane) > 0
    return h + (pose.h if with_s else pose.h + math.pi)


def _flat(pose: object) -> Pose:
    return Pose(pose.x, pose.y, pose.h)  # type: ignore[attr-defined]


def _beside(node: Element, body: Body, road_map: RoadMap) -> LanePosition:
    """Return a place by lanes and metres from a reference.

    With `dsLane` it counts along the lane of the reference, with `ds` along the road. Some tools
    count both along the road, `dsLane` in the direction of travel.
    """
    from_ = body.in_lane(road_map)._replace(offset=0.0)
    lane = beside(road_map, from_, body.along, int(number(node, "dLane")))
    direction = road_map.travel_direction(from_.road, from_.lane) * body.along
    if node.get("ds") is not None:
        ahead = lane._replace(s=lane.s + number(node, "ds"))
    else:
        on = road_map.advance(from_, number(node, "dsLane") * body.along).position
        if on.road == from_.road:
            along_road = from_.s + number(node, "dsLane") * direction
            ahead = lane._replace(s=along_road if body.counts_along_road else on.s)
        else:
            ahead = beside(road_map, on, body.along, int(number(node, "dLane")))
    return ahead._replace(
        offset=number(node, "offset")
        * direction
        * road_map.travel_direction(ahead.road, ahead.lane)
    )


IN_ROUTES = ("FromLaneCoordinates", "PositionInLaneCoordinates")
"""A place in a lane of a route, in 1.0 and since 1.1."""


def waypoints(node: Element, bodies: Mapping[str, Body], road_map: RoadMap) -> list[LanePosition]:
    """Return the places that a route leads along, in lanes.

    Raises:
        Unplayable: A place is in none.
    """
    found = []
    for waypoint in node.below(xml.Waypoint):
        where, _ = place_of(waypoint.one(xml.Position).inner, bodies, road_map)
        if isinstance(where, Pose):
            lane = road_map.locate(where.x, where.y)
            if lane is None:
                raise Unplayable("the route leads to no lane", waypoint.place)
            where = lane
        found.append(where)
    return found


def _on_route(node: Element, bodies: Mapping[str, Body], road_map: RoadMap) -> LanePosition | Pose:
    """Return a place by the metres along a route."""
    route = node.children[0]
    (where,) = [each for each in node.children if each.tag in ("InRoutePosition", "Position")]
    position = where.inner
    if position.get("entityRef") is not None:
        return bodies[position.said("entityRef")].here
    stops = waypoints(route, bodies, road_map)
    at, left = stops[0], number(position, "pathS")
    for goal in stops[1:]:
        length = road_map.route_distance(at, goal)
        if length is None:
            raise Unplayable("there is no way between points of a route", node.place)
        if left <= length or goal is stops[-1]:
            at = road_map.advance(at, left, road_map.route_to(goal)).position
            break
        at, left = goal, left - length
    if position.tag in IN_ROUTES:
        lane = int(number(position, "laneId", at.lane))
        offset = number(position, "laneOffset") * road_map.travel_direction(at.road, lane)
        return LanePosition(at.road, lane, at.s, offset)
    return _flat(road_map.road_pose(at.road, at.s, number(position, "t")))


def trajectory_way(
    node: Element, bodies: Mapping[str, Body], road_map: RoadMap, here: Pose | None = None
) -> Way:
    """Return the corners of the trajectory in an element.

    Args:
        node: The element.
        bodies: All bodies.
        road_map: The map.
        here: Where the body is that follows it: a curve without a first position begins there.
    """

    def pose_of(position: Element) -> Pose:
        where, h = place_of(position.inner, bodies, road_map)
        pose = where if isinstance(where, Pose) else _flat(road_map.pose(where))
        return pose if h is None else pose._replace(h=h)

    shape = next((each for each in node.walk() if each.tag == "Shape"), None)
    if shape is None:
        raise Unplayable("its trajectory is in no catalog", node.place)
    return way_of(shape, pose_of, here)


def _on_trajectory(node: Element, bodies: Mapping[str, Body], road_map: RoadMap) -> Pose:
    """Return a place by metres along a trajectory, and across it."""
    way = trajectory_way(node.one(xml.TrajectoryRef), bodies, road_map)
    x, y, h = on_way(way, lengths_of(way), number(node, "s"))
    t = number(node, "t")
    return Pose(x - t * math.sin(h), y + t * math.cos(h), h)


def beside(road_map: RoadMap, from_: LanePosition, along: int, count: int) -> LanePosition:
    """Return the position `count` lanes to the left of an entity.

    Lanes count by their numbers, of which 0 is none.

    Args:
        road_map: The map.
        from_: Where the entity is.
        along: 1 if it looks in the direction of travel, -1 against it.
        count: Lanes to its left.

    Raises:
        AssertionError: There is no such lane.
    """
    up = road_map.travel_direction(from_.road, from_.lane) * along
    target = from_.lane + count * up
    if from_.lane * target <= 0:
        target += up if count > 0 else -up
    section = road_map.roads[from_.road].section_at(from_.s)
    if target not in section.lanes:
        raise Unplayable(f"no lane {target} beside {from_}")
    return LanePosition(from_.road, target, from_.s)


def centre(road_map: RoadMap, place: LanePosition) -> float:
    """Return the t of a place."""
    lane = _lane(road_map, place)
    return lane.centre.value(place.s) + place.offset * lane.direction


def target_of(node: Element, bodies: Mapping[str, Body], road_map: RoadMap) -> LanePosition | Pose:
    """Return the place to which a distance is measured.

    One in coordinates of a road counts on this road, however far aside of its lanes it is.
    """
    if node.tag != "RoadPosition":
        return place_of(node, bodies, road_map)[0]
    road, s, t = node.said("roadId"), number(node, "s"), number(node, "t")
    lanes = road_map.roads[road].section_at(s).lanes
    places = [LanePosition(road, lane, s, 0.0) for lane in sorted(lanes) if lane]
    nearest = min(places, key=lambda each: abs(t - centre(road_map, each)))
    aside = (t - centre(road_map, nearest)) * _lane(road_map, nearest).direction
    return nearest._replace(offset=aside)


def _lane(road_map: RoadMap, place: LanePosition) -> Lane:
    return road_map.roads[place.road].section_at(place.s).lanes[place.lane]


def offset_of(road_map: RoadMap, lane: LanePosition, pose: Pose) -> float:
    """Return how far (m) a place lies to the left of a lane, in its direction of travel."""
    at = road_map.pose(lane._replace(offset=0.0))
    return (pose.y - at.y) * math.cos(at.h) - (pose.x - at.x) * math.sin(at.h)
