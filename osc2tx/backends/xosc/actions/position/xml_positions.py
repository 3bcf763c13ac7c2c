"""Positions of the XML: on a road, in the world, on the globe."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.conditions.comparisons import distance_to, of_entity
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.facts.maps import LanePosition, Pose, Roads
from osc2tx.backends.xosc.values.constants import Constant, MethodResult, Named, as_number
from osc2tx.losses.bounds import Metres
from osc2tx.losses.entries import Inexpressible
from osc2tx.xosc import elements as xml
from osc2tx_shared.classes import dataclass

REACHED = 1.0
"""Metres from a place that count as being there where it cannot be said more exactly."""

BEFORE = 5.0
"""Metres before a place where another one lies: who is near the one and so far from the other has
come to it. No step is as long."""

SURE = 0.001
"""Metres by which a distance may be short, as 1.0 cannot say `at least`."""

GLOBE = "GeoPosition"

UNKNOWN = "the point is only known during the run"


@dataclass(frozen=True, slots=True)
class XmlPosition:
    """A position of the XML, and what is known of the place.

    Attributes:
        element: Below `Position`.
        lane: The lane it is on; `None` if unknown, or on none.
        pose: Where it is in the world, if that is known.
    """

    element: xml.PositionPart
    lane: LanePosition | None
    pose: Pose | None


def at_world(ctx: Context, x: float, y: float, z: float) -> XmlPosition:
    """Return a position in the world, with the heading of the road."""
    lane = None if ctx.roads is None else ctx.roads.locate(x, y, z)
    heading = 0.0 if ctx.roads is None else ctx.roads.direction_at(x, y, z)
    pose = Pose(x, y, z, heading)
    return XmlPosition(world_position(pose), lane, pose)


def at_place(
    ctx: Context, said: Arguments, actor: str, place: xml.PositionPart, lane: LanePosition | None
) -> tuple[xml.ByEntityCondition, ...]:
    """Return the conditions that an actor has come to a place along its lane; all have to hold.

    What names the place is reported where they say it nearly only. `lane` is the same place on a
    lane of the map, if that is known.
    """
    roads = ctx.roads
    before = None if lane is None or roads is None else roads.ahead(lane, -BEFORE)
    if before is None or lane is None or roads is None or ctx.profile.latches_conditions:
        bound = Metres(REACHED, "before the place, where it counts as there")
        said.approximate("a place is a circle about a point", bound)
        return (of_entity(actor, distance_to(ctx, place, REACHED, "lessThan")),)
    apart = math.dist(
        roads.map.pose(before)[:3], roads.map.pose(lane)[:3]
    )  # less in a bend than on it
    far = distance_to(ctx, lane_place(roads, before), round(apart - SURE, 6), "greaterThan")
    near = distance_to(ctx, place, BEFORE, "lessThan")
    return of_entity(actor, near), of_entity(actor, far)


def lane_place(roads: Roads, place: LanePosition) -> xml.LanePosition:
    """Return the element of a place in a lane of the map and beside its middle."""
    return xml.LanePosition(
        roadId=place.road,
        laneId=place.lane,
        s=round(place.s, 6),
        offset=round(place.offset * (roads.leftwards(place) or 1), 6) or 0.0,
    )


def relative_lane(
    ctx: Context,
    reference: str,
    lanes: int,
    along: float,
    offset: float,
    turn: xml.Orientation | None = None,
) -> xml.RelativeLanePosition:
    """Return the place so many lanes to the left of an actor and so far ahead of it (m).

    1.0 counts along the road, later versions in the direction of travel.
    """
    is_old = ctx.version == "1.0"
    return xml.RelativeLanePosition(
        turn,
        entityRef=reference,
        dLane=lanes,
        dsLane=None if is_old else along,
        ds=along if is_old else None,
        offset=offset,
    )


def world_position(pose: Pose) -> xml.WorldPosition:
    """Return the element of a pose in the world."""
    return xml.WorldPosition(
        x=round(pose.x, 6),
        y=round(pose.y, 6),
        z=round(pose.z, 6),
        h=round(pose.h, 9),
        p=round(pose.pitch, 9) or None,
        r=round(pose.roll, 9) or None,
    )


def on_road(
    ctx: Context, road: Constant | None, lane: Constant | None, s: float, t: float
) -> XmlPosition:
    """Return a place on a road or in a lane, from its coordinates (m)."""
    if not isinstance(road, str):
        raise Inexpressible("the point names no road")
    if not isinstance(lane, str) or lane == "":
        return XmlPosition(xml.RoadPosition(roadId=road, s=s, t=t), None, None)
    if not lane.removeprefix("-").isdecimal():
        raise Inexpressible(f"`{lane}` is no number of a lane")
    number = int(lane)
    place = xml.LanePosition(roadId=road, laneId=number, s=s, offset=t)
    if ctx.roads is None:
        return XmlPosition(place, None, None)
    on = ctx.roads.place(road, number, s, t)
    return XmlPosition(place, on, ctx.roads.map.pose(on))


def on_earth(ctx: Context, latitude: float, longitude: float, altitude: float) -> XmlPosition:
    """Return a place on the globe; where the map says where it lies, its place in the world too.

    Angles are in rad, the altitude in m.
    """
    pose = None if ctx.roads is None else ctx.roads.on_earth(latitude, longitude, altitude)
    if pose is not None and not ctx.can(GLOBE, "1.1"):
        return at_world(ctx, pose.x, pose.y, pose.z)
    ctx.require("a geodetic position", "1.1")
    ctx.require_support(GLOBE)
    lane = None
    if ctx.roads is not None and pose is not None:
        lane = ctx.roads.locate(pose.x, pose.y, pose.z)
    place = xml.GeoPosition(
        latitudeDeg=round(math.degrees(latitude), 9),
        longitudeDeg=round(math.degrees(longitude), 9),
        altitude=altitude or None,
    )
    if ctx.version == "1.1":
        place = xml.GeoPosition(latitude=latitude, longitude=longitude, height=altitude or None)
    return XmlPosition(place, lane, pose)


def parts_of(ctx: Context, value: Constant | None, what: str) -> Callable[..., Constant | None]:
    """Return what gives the parts of a struct by their path, and of what a method makes likewise.

    Raises:
        Inexpressible: It is neither; `what` names it.
    """
    match value:
        case MethodResult():
            return value.get
        case Named(name=name):
            return partial(ctx.values.field, name)
    raise Inexpressible(f"the {what} is only known during the run")


def number_of(value: Constant | None) -> float:
    """Return a coordinate; 0 if it is left out."""
    number = 0.0 if value is None else as_number(value)
    if number is None:
        raise Inexpressible(UNKNOWN)
    return number
