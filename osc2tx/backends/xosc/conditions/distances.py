"""Distances between actors as conditions."""

from __future__ import annotations

from math import cos, pi, sin

from osc2tx.backends.xosc.conditions.comparisons import (
    MIRRORED,
    Comparison,
    Groups,
    Measure,
    distance_to,
    of_entity,
    relative_distance,
)
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.start_lanes import faces_along, standing_heading
from osc2tx.backends.xosc.facts.maps import LanePosition, are_opposed
from osc2tx.losses.entries import NOTHING, Inexpressible, Remedy
from osc2tx.xosc import elements as xml
from osc2tx.xosc.literals import CoordinateSystem, Rule


def object_distance(ctx: Context, c: Comparison) -> Groups:
    """Compare a distance in the axes of the actor (§8.7.3)."""
    direction = c.member("direction", "euclidean")
    if direction == "euclidean":
        return ((relative_distance(ctx, c, direction, None, freespace=c.is_free),),)
    what = f"a {direction} distance in the axes of an object"
    ctx.require(what, "1.1", c.source.span, "`road_distance` is in all versions")
    if direction == "vertical":
        raise Inexpressible("there is no condition on a vertical distance", c.source.span)
    shifted = None if c.is_free else _shifted(ctx, c, direction)
    return shifted or _signed(ctx, c, direction, c.is_free, "entity", ahead_is_positive=True)


def along_road(
    *, ahead_is_positive: bool, freespace: bool | None = None, direction: str | None = None
) -> Measure:
    """Return the measure of a distance along or across the road, with a sign.

    It is positive if the reference is ahead of the actor, or left of it, or the other way round.
    Whether it counts between bounding boxes, and its direction, are by default as arguments say.
    """

    def measure(ctx: Context, c: Comparison) -> Groups:
        is_free = c.is_free if freespace is None else freespace
        along = direction or c.member("direction", "longitudinal")
        is_of_lanes = freespace is not None and along == "longitudinal"
        system: CoordinateSystem = "lane" if is_of_lanes else "road"
        return _signed(ctx, c, along, is_free, system, ahead_is_positive=ahead_is_positive)

    return measure


FAR = 10000.0
"""Metres that no pair of actors is apart."""

NO_SIGN = "conditions on distances have no sign"

WITH_ORDER = {"longitudinal": Remedy(version="1.2")}
"""What can say by direction which of two actors is ahead."""

MANY_LANES = 100
"""Lanes that no road has, for tools that find no lane at all without a range."""


def _signed(
    ctx: Context,
    c: Comparison,
    direction: str,
    freespace: bool,
    system: CoordinateSystem,
    *,
    ahead_is_positive: bool,
) -> Groups:
    """Return the conditions for a distance with a sign, which the XML measures without.

    It is `longitudinal` or `lateral` in a coordinate system of the XML.
    """
    me, other = c.actor, c.reference()
    is_ahead, rule, value = ahead_is_positive, c.rule, c.value
    if value < 0.0:
        is_ahead, rule, value = not is_ahead, MIRRORED[rule], -value
    if system != "entity":
        note_facing(ctx, c, freespace, system)
    has_order = direction == "longitudinal" and ctx.can("RelativeClearanceCondition", "1.2")
    if value == 0.0 and not freespace:  # only the order counts
        if not has_order:
            reason = f"{NO_SIGN}, so they cannot ask for that of a distance"
            raise Inexpressible(reason, c.source.span, WITH_ORDER.get(direction, NOTHING))
        return ((is_clear(ctx, me, other, ahead=is_ahead is rule.startswith("less")),),)
    amount = c._replace(rule=rule, value=value)
    distance = relative_distance(ctx, amount, direction, system, freespace=freespace)
    return in_order(ctx, c, distance, direction, is_ahead, rule)


def in_order(
    ctx: Context,
    c: Comparison,
    measure: xml.ConditionPart,
    direction: str,
    is_ahead: bool,
    rule: Rule,
) -> Groups:
    """Return the conditions for a measure without a sign, and for the side that it is on.

    The reference is ahead of the actor, or not, where what is measured is positive. The rule is
    that of the measure.
    """
    me, other = c.actor, c.reference()
    if direction == "longitudinal" and ctx.can("RelativeClearanceCondition", "1.2"):
        if rule.startswith("less") and not c.is_edge:
            return ((measure,), (is_clear(ctx, me, other, ahead=is_ahead),))
        return ((measure, is_clear(ctx, me, other, ahead=not is_ahead)),)
    remedy = WITH_ORDER.get(direction, NOTHING)
    ctx.report.doubt(f"sign of {c.name}", c.source.span, NO_SIGN, remedy)
    return ((measure,),)


def _shifted(ctx: Context, c: Comparison, direction: str) -> Groups | None:
    """Return the condition on the distance to a place far beyond the reference.

    That distance is the one asked for, with its sign, and so much more. The place lies in the
    direction of an axis of the actor, so its heading has to be known: it stands.
    """
    can_shift = ctx.can("RelativeWorldPosition", "1.1")
    heading = standing_heading(ctx, c.actor) if can_shift else None
    if heading is None:
        return None
    angle = heading if direction == "longitudinal" else heading + 0.5 * pi
    place = xml.RelativeWorldPosition(
        entityRef=c.reference(),
        dx=round(FAR * cos(angle), 6),
        dy=round(FAR * sin(angle), 6),
        dz=0.0,
    )
    condition = distance_to(ctx, place, FAR + c.value, c.rule, "entity", direction)
    return ((of_entity(c.actor, condition),),)


def is_clear(ctx: Context, me: str, other: str, *, ahead: bool) -> xml.ByEntityCondition:
    """Return the condition that another actor is not ahead of one, or not behind, on any lane.

    Ahead is where the one looks, whatever the other one does.
    """
    every_lane = ctx.profile.needs_lane_range
    return of_entity(
        me,
        xml.RelativeClearanceCondition(
            xml.RelativeLaneRange(from_=-MANY_LANES, to=MANY_LANES) if every_lane else None,
            xml.EntityRef(entityRef=other),
            distanceForward=FAR if ahead else 0.0,
            distanceBackward=0.0 if ahead else FAR,
            freeSpace=False,
            oppositeLanes=True,
        ),
    )


def note_facing(ctx: Context, c: Comparison, freespace: bool, system: CoordinateSystem) -> None:
    """Report what a distance along the road depends on: how the other one looks, and its lane."""
    bends, tool = ctx.roads is not None and ctx.roads.sharpest_bend > 0.0, ctx.profile
    if bends and system == "lane" and tool.counts_along_roads:
        ctx.report.doubt(c.name, c.source.span, f"{tool.name} counts along the road, not the lane")
    mine, theirs = (_lane_at_start(ctx, name) for name in (c.actor, c.reference()))
    if ctx.roads is not None and mine and theirs and are_opposed(ctx.roads.map, mine, theirs):
        ctx.report.doubt(
            c.name,
            c.source.span,
            f"no lane leads from {c.actor} to {c.reference()} or back as they start: distances are"
            " along lanes in the world, and along the road in the XML",
        )
    if not freespace:
        return
    shape = next(m.shape for m in ctx.entities if m.name == c.reference())
    is_even = abs(shape.front - shape.rear) < 1e-6
    if not is_even and not faces_along(ctx, c.actor, c.reference()):
        ctx.report.doubt(
            c.name,
            c.source.span,
            f"{c.reference()} may look another way than {c.actor}, so that another end of it faces"
            " it",
        )


def _lane_at_start(ctx: Context, name: str) -> LanePosition | None:
    state = ctx.at_start.get(name)
    if state is None or state.pose is None or ctx.roads is None:
        return None if state is None else state.lane
    return ctx.roads.locate(state.pose.x, state.pose.y, state.pose.z)


def space_headway(ctx: Context, c: Comparison) -> Groups:
    """From front to front; the XML counts between reference points."""
    shifted = c._replace(value=c.value + overhang(ctx, c.actor, c.reference()))
    return _signed(ctx, shifted, "longitudinal", False, "lane", ahead_is_positive=True)


def overhang(ctx: Context, behind: str, ahead: str) -> float:
    """Return by how much (m) reference points are farther apart than fronts."""
    shapes = {member.name: member.shape for member in ctx.cast.values()}
    return round(shapes[behind].front - shapes[ahead].front, 9)
