"""What can be measured of an actor, as conditions of the XML.

One entry of `MEASURES` for each field or method of the library. A measure is called with what is
measured and compared, and returns the condition on entities, or raises `Inexpressible`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import NamedTuple, TypeAlias

from osc2tx import ir
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.points import spot_of
from osc2tx.backends.xosc.report import Inexpressible, Remedy
from osc2tx.backends.xosc.tree import Element, element
from osc2tx.backends.xosc.values import Constant, Member, Named


class Comparison(NamedTuple):
    """A measure compared with a constant.

    Attributes:
        actor: Whose measure.
        owner: Type that declares the field or method.
        name: The field or method.
        arguments: By parameter.
        rule: Literal of `Rule`.
        value: The constant, in SI units.
        is_edge: Only the moment at which it changes counts.
        source: The expression.
    """

    actor: str
    owner: str
    name: str
    arguments: Mapping[str, Constant]
    rule: str
    value: float
    is_edge: bool
    source: ir.Expression

    def reference(self, parameter: str = "reference") -> str:
        """Return the name of the other actor."""
        value = self.arguments.get(parameter)
        if not isinstance(value, Named):
            raise Inexpressible(f"{self.name} needs `{parameter}`", self.source.span)
        return value.name

    def member(self, parameter: str, default: str) -> str:
        """Return the member of an enum."""
        value = self.arguments.get(parameter)
        return value.name if isinstance(value, Member) else default


Groups: TypeAlias = tuple[tuple[Element, ...], ...]
"""Conditions: an OR of ANDs; an edge belongs to the first one of a group."""

Measure: TypeAlias = Callable[[Context, Comparison], Groups]


def of_entity(actor: str, condition: Element) -> Element:
    """Return the condition on one entity."""
    return element(
        "ByEntityCondition",
        element(
            "TriggeringEntities",
            element("EntityRef", entityRef=actor),
            triggeringEntitiesRule="any",
        ),
        element("EntityCondition", condition),
    )


def _speed(ctx: Context, c: Comparison) -> Groups:
    direction = "longitudinal" if ctx.version >= "1.2" else None
    condition = element("SpeedCondition", rule=c.rule, value=c.value, direction=direction)
    return ((of_entity(c.actor, condition),),)


def _acceleration(ctx: Context, c: Comparison) -> Groups:
    direction = "longitudinal" if ctx.version >= "1.2" else None
    condition = element("AccelerationCondition", rule=c.rule, value=c.value, direction=direction)
    return ((of_entity(c.actor, condition),),)


def _object_distance(ctx: Context, c: Comparison) -> Groups:
    direction = c.member("direction", "euclidean")
    freespace = c.member("mode", "reference_points") == "bounding_boxes"
    if direction != "euclidean":
        ctx.require(f"a {direction} distance in the axes of an object", "1.1", c.source.span)
        if direction == "vertical":
            raise Inexpressible("there is no condition on a vertical distance", c.source.span)
        return _signed(ctx, c, direction, freespace, "entity", ahead_is_positive=True)
    kind = "euclidianDistance" if ctx.version >= "1.1" else "cartesianDistance"
    condition = element(
        "RelativeDistanceCondition",
        entityRef=c.reference(),
        relativeDistanceType=kind,
        value=c.value,
        freespace=freespace,
        rule=c.rule,
    )
    return ((of_entity(c.actor, condition),),)


def _road_distance(ctx: Context, c: Comparison) -> Groups:
    freespace = c.member("mode", "reference_points") == "bounding_boxes"
    direction = c.member("direction", "longitudinal")
    return _signed(ctx, c, direction, freespace, "road", ahead_is_positive=True)


def _space_gap(ctx: Context, c: Comparison) -> Groups:
    direction = c.member("direction", "longitudinal")
    return _signed(ctx, c, direction, True, "road", ahead_is_positive=False)


def _ahead_of(ctx: Context, c: Comparison) -> Groups:
    return _signed(ctx, c, "longitudinal", False, "road", ahead_is_positive=False)


def _behind(ctx: Context, c: Comparison) -> Groups:
    return _signed(ctx, c, "longitudinal", False, "road", ahead_is_positive=True)


FAR = 10000.0
"""Metres that no pair of actors is apart."""

MANY_LANES = 100
"""Lanes that no road has; without a range esmini finds no lane at all."""


def _signed(
    ctx: Context,
    c: Comparison,
    direction: str,
    freespace: bool,
    system: str,
    *,
    ahead_is_positive: bool,
) -> Groups:
    """Return the conditions for a distance with a sign, which the XML measures without.

    Args:
        ctx: The context.
        c: The comparison.
        direction: `longitudinal` or `lateral`.
        freespace: Between bounding boxes.
        system: Coordinate system of the XML.
        ahead_is_positive: The distance is positive if the reference is ahead of the actor.
    """
    me, other = c.actor, c.reference()
    behind, ahead = (me, other) if ahead_is_positive else (other, me)
    rule, value = c.rule, c.value
    if value < 0.0:
        behind, ahead, rule, value = ahead, behind, _MIRRORED[rule], -value
    has_order = direction == "longitudinal" and ctx.can("RelativeClearanceCondition", "1.2")
    if value == 0.0 and not freespace:  # only the order counts
        if not has_order:
            remedy = Remedy(version="1.2") if direction == "longitudinal" else Remedy()
            reason = (
                "conditions on distances have no sign, so they cannot ask for that of a distance"
            )
            raise Inexpressible(reason, c.source.span, remedy)
        first, second = (ahead, behind) if rule.startswith("less") else (behind, ahead)
        return ((_is_ahead(first, second),),)
    distance = of_entity(
        me,
        element(
            "RelativeDistanceCondition",
            entityRef=other,
            relativeDistanceType=direction,
            coordinateSystem=system if ctx.version >= "1.1" else None,
            value=value,
            freespace=freespace,
            rule=rule,
        ),
    )
    if has_order:
        if rule.startswith("less") and not c.is_edge:
            return ((distance,), (_is_ahead(ahead, behind),))
        return ((distance, _is_ahead(behind, ahead)),)
    span = c.source.span
    ctx.report.approximate(
        f"sign of {c.name}",
        span,
        "conditions on distances have no sign",
        f"differs only while {behind} is on the other side of {ahead} by more than {value:g} m",
        Remedy(version="1.2") if direction == "longitudinal" else Remedy(),
    )
    return ((distance,),)


_MIRRORED = {
    "greaterThan": "lessThan",
    "greaterOrEqual": "lessOrEqual",
    "lessThan": "greaterThan",
    "lessOrEqual": "greaterOrEqual",
    "equalTo": "equalTo",
    "notEqualTo": "notEqualTo",
}


def _is_ahead(behind: str, ahead: str) -> Element:
    """Return the condition that one actor is not behind another one, on whatever lane."""
    return of_entity(
        behind,
        element(
            "RelativeClearanceCondition",
            element("RelativeLaneRange", from_=-MANY_LANES, to=MANY_LANES),
            element("EntityRef", entityRef=ahead),
            distanceForward=0.0,
            distanceBackward=FAR,
            freeSpace=False,
            oppositeLanes=True,
        ),
    )


# --- headways and times -------------------------------------------------------------------------


def _space_headway(ctx: Context, c: Comparison) -> Groups:
    """From front to front; the XML counts between reference points."""
    shifted = c._replace(value=c.value + _overhang(ctx, c.actor, c.reference()))
    return _signed(ctx, shifted, "longitudinal", False, "road", ahead_is_positive=True)


def _overhang(ctx: Context, behind: str, ahead: str) -> float:
    """Return by how much (m) reference points are farther apart than fronts."""
    shapes = {member.name: member.shape for member in ctx.cast.values()}
    return round(shapes[behind].front - shapes[ahead].front, 9)


def _time_headway(ctx: Context, c: Comparison) -> Groups:
    behind, ahead, rule, value = c.actor, c.reference(), c.rule, c.value
    if value < 0.0:
        behind, ahead, rule, value = ahead, behind, _MIRRORED[rule], -value
    overhang = _overhang(ctx, behind, ahead)
    if overhang:
        ctx.report.approximate(
            "time_headway",
            c.source.span,
            "a time in the XML counts between reference points, not between fronts",
            f"off by the time for {abs(overhang):.2g} m",
        )
    return ((_headway(ctx, behind, ahead, rule, value, freespace=False),),)


def _time_gap(ctx: Context, c: Comparison) -> Groups:
    if c.member("direction", "longitudinal") != "longitudinal":
        raise Inexpressible("there is no time across the road in OpenSCENARIO XML", c.source.span)
    # Positive if the caller is ahead: the other one follows.
    behind, ahead, rule, value = c.reference(), c.actor, c.rule, c.value
    if value < 0.0:
        behind, ahead, rule, value = ahead, behind, _MIRRORED[rule], -value
    return ((_headway(ctx, behind, ahead, rule, value, freespace=True),),)


def _headway(
    ctx: Context, behind: str, ahead: str, rule: str, value: float, *, freespace: bool
) -> Element:
    newer = ctx.version >= "1.1"
    condition = element(
        "TimeHeadwayCondition",
        entityRef=ahead,
        value=value,
        rule=rule,
        freespace=freespace,
        alongRoute=None if newer else True,
        coordinateSystem="road" if newer else None,
        relativeDistanceType="longitudinal" if newer else None,
    )
    return of_entity(behind, condition)


def _time_to_collision(ctx: Context, c: Comparison) -> Groups:
    newer = ctx.version >= "1.1"
    condition = element(
        "TimeToCollisionCondition",
        element("TimeToCollisionConditionTarget", element("EntityRef", entityRef=c.reference())),
        value=c.value,
        rule=c.rule,
        freespace=True,
        alongRoute=None if newer else True,
        coordinateSystem="lane" if newer else None,
        relativeDistanceType="longitudinal" if newer else None,
    )
    return ((of_entity(c.actor, condition),),)


def relative_speed(ctx: Context, actor: str, other: str, rule: str, value: float) -> Groups:
    """Return the condition on the difference (m/s) of the speeds of two actors."""
    condition = element(
        "RelativeSpeedCondition",
        entityRef=other,
        rule=rule,
        value=value,
        direction="longitudinal" if ctx.version >= "1.2" else None,
    )
    return ((of_entity(actor, condition),),)


# --- points -------------------------------------------------------------------------------------


def _distance_to_xyz(ctx: Context, c: Comparison) -> Groups:
    direction = c.member("direction", "euclidean")
    if direction == "vertical":
        raise Inexpressible("there is no condition on a vertical distance", c.source.span)
    return _distance_to(ctx, c, direction, "entity")


def _distance_to_road_point(ctx: Context, c: Comparison) -> Groups:
    lane = c.member("route_type", "on_road") == "on_lane"
    return _distance_to(ctx, c, c.member("direction", "longitudinal"), "lane" if lane else "road")


def _distance_to(ctx: Context, c: Comparison, direction: str, system: str) -> Groups:
    """Return the condition on the distance to a point, which the XML measures without sign."""
    spot = spot_of(ctx, c.arguments.get("point"))
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
    condition = element(
        "DistanceCondition",
        element("Position", spot.element),
        value=value,
        rule=rule,
        freespace=c.member("mode", "reference_points") == "bounding_boxes",
        alongRoute=None if newer else not is_free,
        coordinateSystem=system if newer and not is_free else None,
        relativeDistanceType=_KINDS[direction] if newer else None,
    )
    return ((of_entity(c.actor, condition),),)


_KINDS = {
    "euclidean": "euclidianDistance",
    "longitudinal": "longitudinal",
    "lateral": "lateral",
}

MEASURES: Mapping[str, Measure] = {
    "speed": _speed,
    "velocity.translational.x": _speed,
    "acceleration.translational.x": _acceleration,
    "object_distance": _object_distance,
    "road_distance": _road_distance,
    "space_gap": _space_gap,
    "ahead_of": _ahead_of,
    "behind": _behind,
    "space_headway": _space_headway,
    "time_gap": _time_gap,
    "time_headway": _time_headway,
    "time_to_collision": _time_to_collision,
    "distance_to_xyz_point": _distance_to_xyz,
    "distance_to_odr_point": _distance_to_road_point,
    "distance_to_route_point": _distance_to_road_point,
}
"""Field or method of an actor (§8.7.3, §8.7.6) -> its condition."""

FINITE = frozenset({"time_gap", "time_headway", "time_to_collision"})
"""Measures that are infinite where the XML has no value: a fall of them is the rise of `less`."""
