"""Fields and methods of actors as conditions of the XML: motion, times between actors, points.

One entry of `MEASURES` for each field or method of the library. A measure is called with what is
measured and compared, and returns the condition on entities, or raises `Inexpressible`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

from osc2tx.backends.xosc.actions.position.points_and_lines import xml_position
from osc2tx.backends.xosc.conditions.comparisons import (
    MIRRORED,
    Comparison,
    Groups,
    Measure,
    distance_to,
    of_entity,
    relative_distance,
    relative_speed,
)
from osc2tx.backends.xosc.conditions.distances import (
    NO_SIGN,
    along_road,
    in_order,
    note_facing,
    object_distance,
    overhang,
    space_headway,
)
from osc2tx.backends.xosc.context import Context
from osc2tx.losses.entries import Inexpressible
from osc2tx.xosc import elements as xml
from osc2tx.xosc.literals import CoordinateSystem, DirectionalDimension

Motion: TypeAlias = xml.SpeedCondition | xml.AccelerationCondition


def _part_of(condition: type[Motion], direction: DirectionalDimension | None) -> Measure:
    """Return the measure of a speed or an acceleration along an axis of the actor.

    Other parts than that along the actor, and the amount (`None`), need 1.2.
    """

    def measure(ctx: Context, c: Comparison) -> Groups:
        is_along = direction == "longitudinal"
        if not is_along:
            ctx.require("a condition on a part of a motion", "1.2", c.source.span)
        is_commanded = condition is xml.SpeedCondition and ctx.profile.commands_speeds
        part = None if ctx.version < "1.2" or (is_commanded and is_along) else direction
        made = condition(rule=c.rule, value=c.value, direction=part)
        return ((of_entity(c.actor, made),),)

    return measure


def time_headway(ctx: Context, c: Comparison) -> Groups:
    """Compare the time until the front of one is where that of the other is now.

    It is positive if the reference leads.
    """
    if overhang(ctx, c.actor, c.reference()):
        reason = "a time in the XML counts between reference points, not between fronts"
        ctx.report.doubt("time_headway", c.source.span, reason)
    return _between(ctx, c, is_ahead=True, freespace=False)


def time_gap(ctx: Context, c: Comparison) -> Groups:
    """Compare the time until the follower is where the rear of the other one is now.

    It is positive if the reference follows.
    """
    if c.member("direction", "longitudinal") != "longitudinal":
        raise Inexpressible("there is no time across the road in OpenSCENARIO XML", c.source.span)
    return _between(ctx, c, is_ahead=False, freespace=True)


def _between(ctx: Context, c: Comparison, *, is_ahead: bool, freespace: bool) -> Groups:
    """Return the conditions for a time with a sign, which is that of who follows.

    The reference leads, or follows, where the time is positive.
    """
    note_facing(ctx, c, freespace, "lane")
    rule, value = c.rule, c.value
    if value < 0.0:
        is_ahead, rule, value = not is_ahead, MIRRORED[rule], -value
    me, other = c.actor, c.reference()
    behind, ahead = (me, other) if is_ahead else (other, me)
    newer = ctx.version >= "1.1"
    condition = xml.TimeHeadwayCondition(
        entityRef=ahead,
        value=value,
        rule=rule,
        freespace=freespace,
        alongRoute=None if newer else True,
        coordinateSystem="lane" if newer else None,
        relativeDistanceType="longitudinal" if newer else None,
    )
    headway = of_entity(behind, condition)
    groups = in_order(ctx, c, headway, "longitudinal", is_ahead, rule)
    if rule.startswith("less") or c.is_edge or not groups[0][1:]:
        return groups
    # Who stands comes to no place: the time of the XML is undefined, and compares with nothing.
    standing = xml.SpeedCondition(value=TOUCHING, rule="lessThan")
    return (*groups, (of_entity(behind, standing), *groups[0][1:]))


TOUCHING = 0.001
"""Metres between those that touch, and m/s of who stays where it is: 1.0 cannot say `0 or less`."""


def time_to_collision(ctx: Context, c: Comparison) -> Groups:
    """Compare the time until both collide if their speeds stay as they are.

    The XML divides a distance along one axis by the speed along it, so a condition across is
    paired with it: that one is ahead, and not beside. Who moves away is never reached.
    """
    newer = ctx.version >= "1.1"
    target = xml.EntityRef(entityRef=c.reference())
    time = of_entity(
        c.actor,
        xml.TimeToCollisionCondition(
            xml.TimeToCollisionConditionTarget(target),
            value=c.value,
            rule=c.rule,
            freespace=True,
            alongRoute=None if newer else False,
            coordinateSystem="entity" if newer else None,
            relativeDistanceType="longitudinal" if newer else None,
        ),
    )
    reason = "a time in the XML counts along one axis; motion across it does not count"
    ctx.report.doubt(c.name, c.source.span, reason)
    if c.rule.startswith("less"):
        if ctx.profile.latches_conditions:  # it wants each of two conditions once: one has to do
            return ((time,),)
        beside = relative_distance(
            ctx, c._replace(value=TOUCHING, rule="lessThan"), "lateral", "entity", freespace=True
        )
        return ((time, beside), (beside, time)) if c.is_edge else ((time, beside),)
    along: DirectionalDimension | None = "longitudinal" if ctx.version >= "1.2" else None
    apart = relative_distance(
        ctx, c._replace(value=TOUCHING, rule="greaterThan"), "lateral", "entity", freespace=True
    )
    away = relative_speed(c.actor, c.reference(), "lessThan", TOUCHING, along)
    return ((time,), (apart,), *away)


# --- points ---------------------------------------------------------------------------------------


def distance_to_xyz(ctx: Context, c: Comparison) -> Groups:
    """Compare a distance to a point of the world, in the axes of the actor."""
    direction = c.member("direction", "euclidean")
    if direction == "vertical":
        raise Inexpressible("there is no condition on a vertical distance", c.source.span)
    return _distance_to(ctx, c, direction, "entity")


def distance_to_road_point(ctx: Context, c: Comparison) -> Groups:
    """Compare a distance to a point along or across the road or the lane."""
    lane = c.member("route_type", "on_road") == "on_lane"
    return _distance_to(ctx, c, c.member("direction", "longitudinal"), "lane" if lane else "road")


def _distance_to(ctx: Context, c: Comparison, direction: str, system: CoordinateSystem) -> Groups:
    """Return the condition on the distance to a point, which the XML measures without sign."""
    point = xml_position(ctx, c.arguments.get("point"))
    is_free = direction == "euclidean"
    rule, value = c.rule, c.value
    if not is_free:
        if direction == "lateral":
            ctx.require("a lateral distance to a point", "1.1", c.source.span)
        if value < 0.0:
            raise Inexpressible("a point behind by a distance", c.source.span)
        if not (c.is_edge and rule.startswith(("less", "greater")) and value > 0.0):
            ctx.report.doubt(f"sign of {c.name}", c.source.span, NO_SIGN)
    axes, boxes = None if is_free else system, c.is_free
    condition = distance_to(ctx, point.element, value, rule, axes, direction, freespace=boxes)
    return ((of_entity(c.actor, condition),),)


ASIDE = 100.0
"""Metres to the right of a road where nobody is."""


def coordinate(ctx: Context, c: Comparison) -> Groups:
    """Compare the own s along the road, or t across it (§8.7.3).

    It is the distance to where the road begins, or to a line far to the right of it.

    Raises:
        Inexpressible: There are several roads, each with coordinates of its own.
    """
    direction, aside = "longitudinal", 0.0
    if c.name == "get_t_coord":
        ctx.require("a lateral distance to a point", "1.1", c.source.span)
        direction, aside = "lateral", ASIDE
    roads = [] if ctx.roads is None else list(ctx.roads.map.roads)
    if len(roads) != 1 or c.member("route_type", "on_road") != "on_road":
        reason = "a condition on coordinates of a road needs a map with just one road"
        raise Inexpressible(reason, c.source.span)
    place = xml.RoadPosition(roadId=roads[0], s=0.0, t=-aside)
    condition = distance_to(ctx, place, c.value + aside, c.rule, "road", direction)
    return ((of_entity(c.actor, condition),),)


MEASURES: Mapping[str, Measure] = {
    "speed": _part_of(xml.SpeedCondition, "longitudinal"),
    "velocity.translational.x": _part_of(xml.SpeedCondition, "longitudinal"),
    "velocity.translational.y": _part_of(xml.SpeedCondition, "lateral"),
    "velocity.translational.z": _part_of(xml.SpeedCondition, "vertical"),
    "velocity.translational.norm": _part_of(xml.SpeedCondition, None),
    "acceleration.translational.x": _part_of(xml.AccelerationCondition, "longitudinal"),
    "acceleration.translational.y": _part_of(xml.AccelerationCondition, "lateral"),
    "acceleration.translational.z": _part_of(xml.AccelerationCondition, "vertical"),
    "acceleration.translational.norm": _part_of(xml.AccelerationCondition, None),
    "object_distance": object_distance,
    "road_distance": along_road(ahead_is_positive=True),
    "space_gap": along_road(ahead_is_positive=False, freespace=True),
    "ahead_of": along_road(ahead_is_positive=False, freespace=False, direction="longitudinal"),
    "behind": along_road(ahead_is_positive=True, freespace=False, direction="longitudinal"),
    "space_headway": space_headway,
    "time_gap": time_gap,
    "time_headway": time_headway,
    "time_to_collision": time_to_collision,
    "get_s_coord": coordinate,
    "get_t_coord": coordinate,
    "distance_to_xyz_point": distance_to_xyz,
    "distance_to_odr_point": distance_to_road_point,
    "distance_to_route_point": distance_to_road_point,
}
"""Field or method of an actor (§8.7.3, §8.7.6) -> its condition."""

FINITE = frozenset({"time_gap", "time_headway", "time_to_collision"})
"""Measures that are infinite where the XML has no value: a fall of them is the rise of `less`."""
