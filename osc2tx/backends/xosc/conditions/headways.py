"""Times between actors as conditions: gap, headway, time to collision."""

from __future__ import annotations

from osc2tx.backends.xosc.conditions.comparisons import (
    MIRRORED,
    Comparison,
    Groups,
    of_entity,
    relative_speed,
)
from osc2tx.backends.xosc.conditions.distances import in_order, note_facing, overhang
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.report import Inexpressible
from osc2tx.xosc import elements as xml
from osc2tx.xosc.literals import Rule


def time_headway(ctx: Context, c: Comparison) -> Groups:
    """Compare the time until the front of one is where that of the other is now.

    It is positive if the reference leads.
    """
    difference = overhang(ctx, c.actor, c.reference())
    if difference:
        ctx.report.approximate(
            "time_headway",
            c.source.span,
            "a time in the XML counts between reference points, not between fronts",
            f"off by the time for {abs(difference):.2g} m",
        )
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

    Args:
        ctx: The context.
        c: The comparison.
        is_ahead: The reference leads where the time is positive.
        freespace: Between bounding boxes.
    """
    note_facing(ctx, c, freespace, "road")
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
        coordinateSystem="road" if newer else None,
        relativeDistanceType="longitudinal" if newer else None,
    )
    headway = of_entity(behind, condition)
    groups = in_order(ctx, c, headway, "longitudinal", is_ahead, rule, f"{value:g} s")
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
    ctx.report.approximate(
        c.name,
        c.source.span,
        "a time in the XML counts along one axis; motion across it does not count",
        "none where both keep to the axis of the actor; else by the time to come to its width",
    )
    if c.rule.startswith("less"):
        beside = _across(ctx, c, "lessThan")
        return ((time, beside), (beside, time)) if c.is_edge else ((time, beside),)
    away = relative_speed(ctx, c.actor, c.reference(), "lessThan", TOUCHING)
    return ((time,), (_across(ctx, c, "greaterThan"),), *away)


def _across(ctx: Context, c: Comparison, rule: Rule) -> xml.ByEntityCondition:
    """Return the condition on the space between the sides of two actors."""
    return of_entity(
        c.actor,
        xml.RelativeDistanceCondition(
            entityRef=c.reference(),
            relativeDistanceType="lateral",
            coordinateSystem="entity" if ctx.version >= "1.1" else None,
            value=TOUCHING,
            freespace=True,
            rule=rule,
        ),
    )
