"""Gaps and headways to another actor (§8.8.3.4 to §8.8.3.11).

A gap counts between facing ends or sides, as a distance with free space does in the XML; a headway
counts between fronts, the XML between reference points. A gap that is to be kept is the one that
there is, which the XML cannot ask for: it has to be known from what stands before.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf

from osc2tx import ir
from osc2tx.backends.xosc.actions.apply_modifiers import apply_modifiers
from osc2tx.backends.xosc.actions.leaf import Arguments, Change, Leaf, Performance
from osc2tx.backends.xosc.actions.registry import action
from osc2tx.backends.xosc.actions.speed_changes import longitudinal
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.facts.actors import TOP_SPEED
from osc2tx.backends.xosc.flattening.adjacent_members import predecessor
from osc2tx.backends.xosc.report import Inexpressible, Remedy
from osc2tx.backends.xosc.state import LATERAL, LONGITUDINAL
from osc2tx.backends.xosc.xml.tree import Element, element

HOW = "how it closes the gap is up to the tool; the gap itself is exact"
"""What reports say about gaps: the standard has no law for their control."""

SIDES = {
    "ahead": "leadingReferencedEntity",
    "behind": "trailingReferencedEntity",
    "left": "leftToReferencedEntity",
    "right": "rightToReferencedEntity",
}
OPPOSITE = {"ahead": "behind", "behind": "ahead", "left": "right", "right": "left"}


@dataclass(frozen=True, slots=True)
class Gap:
    """A distance to another actor.

    Attributes:
        reference: The other one.
        side: On which side of it the actor is: `ahead`, `behind`, `left` or `right`.
        size: Metres, or seconds.
        is_time: It is in seconds.
        is_headway: It counts from front to front.
    """

    reference: CastMember
    side: str
    size: float
    is_time: bool
    is_headway: bool

    @property
    def is_lateral(self) -> bool:
        """Whether it counts across the road."""
        return self.side in ("left", "right")


@action("change_space_gap", "change_time_gap", "change_space_headway", "change_time_headway")
def _change_gap(leaf: Leaf) -> Performance:
    gap = _asked_for(leaf, leaf.node, leaf.arguments)
    change = reach(leaf, gap, keeps=False)
    leaf.ctx.report.exact(leaf.construct, leaf.node.span, HOW)
    if leaf.node.duration is not None:
        leaf.ctx.report.approximate(
            leaf.construct,
            leaf.node.duration.span,
            "an action on a distance takes as long as the tool wants",
            "the distance is reached, but not at that time",
        )
    return Performance((change, *apply_modifiers(leaf)), "goal")


@action("keep_space_gap", "keep_time_gap", "keep_space_headway", "keep_time_headway")
def _keep_gap(leaf: Leaf) -> Performance:
    reference = leaf.arguments.entity("reference")
    direction = leaf.arguments.member("direction", "longitudinal")
    if reference is None:
        raise Inexpressible("it names no actor", leaf.node.span)
    is_time, is_headway = "_time_" in leaf.node.action, leaf.node.action.endswith("headway")
    found = _reached_before(leaf, reference, direction, is_time, is_headway)
    if found is None and direction == "longitudinal" and leaf.is_start:
        found = _at_start(leaf, reference, is_time, is_headway)
    if found is None:
        raise Inexpressible(
            "the present gap is not known before the run, and the XML has no action that keeps it",
            leaf.node.span,
        )
    change = reach(leaf, found, keeps=True)
    leaf.ctx.report.exact(leaf.construct, leaf.node.span, HOW)
    return Performance((change, *apply_modifiers(leaf)), "open")


def _asked_for(leaf: Leaf, node: ir.Invoke, arguments: Arguments) -> Gap:
    """Return the gap that a `change_…` asks for; a negative one is on the other side."""
    target, reference = arguments.number("target"), arguments.entity("reference")
    side = arguments.member("direction", "")
    if side in ("inside", "outside"):
        roads, lane = leaf.ctx.roads, leaf.state.lane
        is_right_hand = roads is None or lane is None or roads.is_right_hand(lane.road)
        side = "left" if (side == "inside") is is_right_hand else "right"
    if target is None or reference is None or side not in SIDES:
        raise Inexpressible("it needs a target, a direction and a reference", node.span)
    if target < 0.0:
        target, side = -target, OPPOSITE[side]
    is_time, is_headway = "_time_" in node.action, node.action.endswith("headway")
    return Gap(reference, side, target, is_time, is_headway)


def _reached_before(
    leaf: Leaf, reference: CastMember, direction: str, is_time: bool, is_headway: bool
) -> Gap | None:
    """Return the gap that the invocation before has made."""
    before = predecessor(leaf.ctx.scenario.body, leaf.node)
    if before is None or not before.action.startswith(("change_space_", "change_time_")):
        return None
    if before.until or before.actor is None:
        return None
    if leaf.ctx.values.actor(before.actor) != leaf.member.actor.name:
        return None
    gap = _asked_for(leaf, before, Arguments(leaf.ctx, before.arguments, before))
    same = (gap.reference.name, gap.is_time, gap.is_lateral)
    if same != (reference.name, is_time, direction == "lateral"):
        return None
    if gap.is_headway is is_headway:
        return gap
    if is_time:
        return None
    leading = (reference if gap.side == "behind" else leaf.member).shape.length
    size = gap.size + leading if is_headway else gap.size - leading
    return replace(gap, size=size, is_headway=is_headway)


def _at_start(leaf: Leaf, reference: CastMember, is_time: bool, is_headway: bool) -> Gap | None:
    """Return the gap of the initial placement."""
    apart = leaf.ctx.init_gaps.get((leaf.member.name, reference.name))
    if apart is None:
        return None
    me, other = leaf.member.shape, reference.shape
    side = "behind" if apart > 0.0 else "ahead"
    behind, ahead = (me, other) if side == "behind" else (other, me)
    size = abs(apart) - behind.front + (ahead.front if is_headway else -ahead.rear)
    if is_time:
        trailing = leaf.state if side == "behind" else leaf.ctx.states[reference.name]
        if trailing.speed is None or not trailing.speed.is_known or trailing.speed.low <= 0.0:
            return None
        size /= trailing.speed.low
    return Gap(reference, side, max(size, 0.0), is_time, is_headway)


# --- elements -----------------------------------------------------------------------------------


def reach(leaf: Leaf, gap: Gap, *, keeps: bool) -> Change:
    """Return the control that reaches a gap, or keeps one."""
    if gap.is_lateral:
        return _reach_sideways(leaf, gap, keeps=keeps)
    distance, time, freespace = _measured(leaf, gap)
    return hold(leaf, gap, distance, time, freespace=freespace, keeps=keeps)


def hold(
    leaf: Leaf,
    gap: Gap,
    distance: float | None,
    time: float | None,
    *,
    freespace: bool,
    keeps: bool,
) -> Change:
    """Return the control of a distance (m) or time (s) along the road, as the XML counts it."""
    if time is not None:
        leaf.ctx.require_support("LongitudinalDistanceAction/timeGap", leaf.node.span)
    newer = leaf.ctx.version >= "1.1"
    _require_side(leaf, gap)
    limits = leaf.limits
    action = longitudinal(
        element(
            "LongitudinalDistanceAction",
            element(
                "DynamicConstraints",
                maxAcceleration=limits.acceleration,
                maxDeceleration=limits.deceleration,
                maxSpeed=None if newer else TOP_SPEED,
            ),
            entityRef=gap.reference.name,
            distance=distance,
            timeGap=time,
            freespace=freespace,
            continuous=keeps,
            displacement=SIDES[gap.side] if newer else None,
            coordinateSystem="lane" if newer else None,
        )
    )
    # Tools reach a gap at some speed; what follows has to say which one it wants.
    during = replace(leaf.state, speed=None).finished(LONGITUDINAL)
    return Change(LONGITUDINAL, (action,), inf if keeps else None, during, during)


def _measured(leaf: Leaf, gap: Gap) -> tuple[float | None, float | None, bool]:
    """Return distance, time and whether they count between the facing ends."""
    if not gap.is_headway:
        size = round(gap.size, 6)
        return (None, size, True) if gap.is_time else (size, None, True)
    behind, ahead = leaf.member.shape, gap.reference.shape
    if gap.side == "ahead":
        behind, ahead = ahead, behind
    overhang = behind.front - ahead.front  # from fronts to reference points
    if not gap.is_time:
        return round(gap.size + overhang, 6), None, False
    if abs(overhang) > 1e-6:
        leaf.ctx.report.approximate(
            leaf.construct,
            leaf.node.span,
            "a time in the XML counts between reference points, not between fronts",
            f"off by the time for {abs(overhang):.2g} m",
        )
    return None, round(gap.size, 6), False


def _require_side(leaf: Leaf, gap: Gap) -> None:
    """See to it that 1.0, which cannot say on which side a gap is, does not have to."""
    ctx = leaf.ctx
    if ctx.version >= "1.1":
        return
    known_side = _side_at_start(leaf, gap)
    if known_side == gap.side:
        return
    if known_side is not None:
        raise Inexpressible(
            "OpenSCENARIO XML 1.0 does not say on which side a distance is kept",
            leaf.node.span,
            Remedy(version="1.1"),
        )
    ctx.report.approximate(
        leaf.construct,
        leaf.node.span,
        "OpenSCENARIO XML 1.0 does not say on which side a distance is kept",
        f"differs only if it is not on the side `{gap.side}` when it begins",
        Remedy(version="1.1"),
    )


def _side_at_start(leaf: Leaf, gap: Gap) -> str | None:
    """Return the side on which an actor is, where nothing has changed it since the start."""
    before = predecessor(leaf.ctx.scenario.body, leaf.node)
    if before is not None and before.action.startswith(("change_space_", "change_time_")):
        return gap.side if leaf.node.action.startswith("keep_") else None
    if not leaf.is_start or gap.is_lateral:
        return None
    apart = leaf.ctx.init_gaps.get((leaf.member.name, gap.reference.name))
    if apart is None:
        return None
    return "behind" if apart > 0.0 else "ahead"


def _reach_sideways(leaf: Leaf, gap: Gap, *, keeps: bool) -> Change:
    if gap.is_time:
        raise Inexpressible("there is no time across the road in OpenSCENARIO XML", leaf.node.span)
    _require_side(leaf, gap)
    newer = leaf.ctx.version >= "1.1"
    limits = leaf.limits
    action = element(
        "LateralDistanceAction",
        element(
            "DynamicConstraints",
            maxAcceleration=limits.lateral,
            maxDeceleration=limits.lateral,
            maxSpeed=LATERAL_SPEED,
        ),
        entityRef=gap.reference.name,
        distance=round(gap.size, 6),
        freespace=True,
        continuous=keeps,
        displacement=SIDES[gap.side] if newer else None,
        coordinateSystem="road" if newer else None,
    )
    after = replace(leaf.state, offset=None, lane=None).finished(LATERAL)
    return Change(LATERAL, (_lateral(action),), inf if keeps else None, after, after)


LATERAL_SPEED = 3.0
"""m/s across the road; the DSL says none."""


def _lateral(action: Element) -> Element:
    return element("PrivateAction", element("LateralAction", action))
