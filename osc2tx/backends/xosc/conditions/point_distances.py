"""Distances to points as conditions."""

from __future__ import annotations

from collections.abc import Mapping

from osc2tx.backends.xosc.actions.position.points_and_lines import xml_position
from osc2tx.backends.xosc.conditions.comparisons import Comparison, Groups, of_entity
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.report import Inexpressible
from osc2tx.xosc import elements as xml
from osc2tx.xosc.literals import CoordinateSystem, RelativeDistanceType


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
    newer, is_free = ctx.version >= "1.1", direction == "euclidean"
    rule, value = c.rule, c.value
    if not is_free:
        if direction == "lateral":
            ctx.require("a lateral distance to a point", "1.1", c.source.span)
        if value < 0.0:
            raise Inexpressible("a point behind by a distance", c.source.span)
        if not (c.is_edge and rule.startswith(("less", "greater")) and value > 0.0):
            ctx.report.approximate(
                f"sign of {c.name}",
                c.source.span,
                "conditions on distances have no sign",
                f"differs only once the point is passed by more than {value:g} m",
            )
    condition = xml.DistanceCondition(
        xml.Position(point.element),
        value=value,
        rule=rule,
        freespace=c.member("mode", "reference_points") == "bounding_boxes",
        alongRoute=None if newer else not is_free,
        coordinateSystem=system if newer and not is_free else None,
        relativeDistanceType=_KINDS[direction] if newer else None,
    )
    return ((of_entity(c.actor, condition),),)


_KINDS: Mapping[str, RelativeDistanceType] = {
    "euclidean": "euclidianDistance",
    "longitudinal": "longitudinal",
    "lateral": "lateral",
}


ASIDE = 100.0
"""Metres to the right of a road where nobody is."""


def s_coordinate(ctx: Context, c: Comparison) -> Groups:
    """Compare the own s along the road: the distance to where the road begins (§8.7.3)."""
    return _coordinate(ctx, c, "longitudinal", 0.0)


def t_coordinate(ctx: Context, c: Comparison) -> Groups:
    """Compare the own t across the road: the distance to a line far to the right of it."""
    ctx.require("a lateral distance to a point", "1.1", c.source.span)
    return _coordinate(ctx, c, "lateral", ASIDE)


def _coordinate(ctx: Context, c: Comparison, direction: str, aside: float) -> Groups:
    """Return the condition on the distance to a line that is so far (m) to the right of the road.

    Raises:
        Inexpressible: There are several roads, each with coordinates of its own.
    """
    road = None if ctx.roads is None else ctx.roads.only_road()
    if road is None or c.member("route_type", "on_road") != "on_road":
        reason = "a condition on coordinates of a road needs a map with just one road"
        raise Inexpressible(reason, c.source.span)
    newer = ctx.version >= "1.1"
    condition = xml.DistanceCondition(
        xml.Position(xml.RoadPosition(roadId=road, s=0.0, t=-aside)),
        value=c.value + aside,
        rule=c.rule,
        freespace=False,
        alongRoute=None if newer else True,
        coordinateSystem="road" if newer else None,
        relativeDistanceType=_KINDS[direction] if newer else None,
    )
    return ((of_entity(c.actor, condition),),)
