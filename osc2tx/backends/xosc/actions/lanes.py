"""Changes of the lane and of the lateral position in it (§8.8.3.2, §8.8.3.3)."""

from __future__ import annotations

import math

from osc2tx import ir
from osc2tx.backends.xosc.actions.apply_modifiers import apply_modifiers
from osc2tx.backends.xosc.actions.leaf import Change, Leaf, Performance
from osc2tx.backends.xosc.actions.other_actors import lane_of
from osc2tx.backends.xosc.actions.registry import action
from osc2tx.backends.xosc.actions.slow_shifts import note_slow
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.entities.declared_roads import segment_of
from osc2tx.backends.xosc.facts.actors import Linear, Profile, apart, course_of_shift, fastest
from osc2tx.backends.xosc.facts.map_search import MapSegment
from osc2tx.backends.xosc.facts.maps import LanePosition
from osc2tx.backends.xosc.report import Inexpressible, Metres
from osc2tx.backends.xosc.state import LATERAL, ActorState, known
from osc2tx.backends.xosc.xml.tree import Element, element
from osc2tx_classes import replace

LANE_WIDTH = 3.5
"""Metres between lanes where there is no map to ask."""

INSIDE = 1.2
"""Metres from the centre that are inside of any lane: there what is cut short goes on."""


@action("change_lane")
def _change_lane(leaf: Leaf) -> Performance:
    arguments = leaf.arguments
    reference = arguments.entity("reference")
    target = segment_of(leaf.ctx, arguments.get("target"))
    lanes = _lanes(leaf) if target is None else _lanes_to(leaf, target)
    offset = arguments.number("offset") or 0.0
    profile = arguments.member("rate_profile", "none")
    peak = arguments.number("rate_peak")
    change = lane_change(
        leaf,
        lanes,
        offset,
        profile,
        peak,
        None if reference is None else reference.name,
        duration=leaf.duration,
        own_lanes=None if reference is None else lanes_to(leaf, reference, lanes),
        is_absolute=target is not None,
    )
    return Performance((change, *apply_modifiers(leaf)), "goal")


def _lanes_to(leaf: Leaf, target: MapSegment) -> int:
    """Return how many lanes to the left a lane of the map is."""
    roads, here = leaf.ctx.roads, leaf.state.lane
    if target.lane is None:
        raise Inexpressible(f"a {target.kind} is no lane", leaf.node.span)
    if roads is None or here is None:
        raise Inexpressible("which lane it is in is only known during the run", leaf.node.span)
    lanes = roads.lanes_between(here, LanePosition(target.road, target.lane, here.s))
    if lanes is None:
        raise Inexpressible(f"{target} is not beside lane {here.lane} of road {here.road}")
    return lanes


def _lanes(leaf: Leaf) -> int:
    """Return how many lanes to the left of the reference the target is."""
    number = leaf.arguments.number("num_of_lanes")
    count = 1 if number is None else round(number)
    side = leaf.arguments.member("side", "")
    match side:
        case "left":
            return count
        case "right":
            return -count
        case "same":
            return 0
        case "inside" | "outside":
            roads, lane = leaf.ctx.roads, leaf.state.lane
            is_right_hand = roads is None or lane is None or roads.is_right_hand(lane.road)
            return count if (side == "inside") is is_right_hand else -count
    return count if drawn_side(leaf, leaf.node, count) == "left" else -count


def drawn_side(leaf: Leaf, node: ir.Invoke | ir.ModifierCall, count: int) -> str:
    """Return the side that a parameter of the document gives, of those with a lane."""
    drawn = leaf.ctx.choosing.side(leaf.ctx.scope, node)
    if not isinstance(drawn, str):
        raise Inexpressible("the side is drawn for each run; say `left` or `right`", node.span)
    roads, lane = leaf.ctx.roads, leaf.state.lane
    if roads is None or lane is None:
        return drawn
    sides = {"left": count, "right": -count}
    there = [side for side, lanes in sides.items() if roads.beside(lane, lanes) is not None]
    return drawn if drawn in there or not there else there[0]


def lane_change(
    leaf: Leaf,
    lanes: int,
    offset: float,
    profile: str,
    peak: float | None,
    reference: str | None,
    *,
    duration: float | None = None,
    own_lanes: int | None = None,
    jumps: bool = False,
    is_absolute: bool = False,
) -> Change:
    """Return the change to a lane so many to the left of that of the actor or a reference."""
    state = leaf.state
    if own_lanes is None and reference is None:
        own_lanes = lanes
    here, target = (None, None) if own_lanes is None else _from_and_to(leaf, own_lanes)
    count = 1 if own_lanes is None else own_lanes
    to_lane = math.copysign(_distance(leaf, here, target, count), count)
    way = abs(to_lane + offset - _offset(state))
    course = course_of_shift(way, profile, peak, duration, leaf.limits)
    if not jumps:
        _note_drift(leaf, way, (profile, peak, duration), course)
        note_slow(leaf, way, course)
    time = 0.0 if jumps else course.duration
    if own_lanes is None and duration is None and not jumps:
        leaf.ctx.report.approximate(
            leaf.construct,
            leaf.node.span,
            f"how far the lane of {reference} is away is only known during the run",
            f"it takes {time:.3g} s, as to a lane beside it",
        )
    shape = "step" if jumps else _shape(leaf, course, profile)
    after = replace(state, lane=target, offset=known(offset)).finished(LATERAL)
    if reference is not None and "RelativeTargetLane/entityRef" in leaf.ctx.profile.unsupported:
        if own_lanes is None:
            leaf.ctx.require_support("RelativeTargetLane/entityRef", leaf.node.span)
        reference, lanes = None, count
    goal = element("RelativeTargetLane", entityRef=reference or leaf.member.name, value=lanes)
    if is_absolute and target is not None and leaf.ctx.can("AbsoluteTargetLane", "1.0"):
        goal = element("AbsoluteTargetLane", value=target.lane)
    action = lateral(
        element(
            "LaneChangeAction",
            _dynamics(leaf, shape, time),
            element("LaneChangeTarget", goal),
            targetLaneOffset=offset or None,
        )
    )
    drift = 0.0 if jumps else fastest(course)
    during = replace(after, lane=None, offset=None, drift=drift)
    return Change(LATERAL, (action,), time, during, after)


def _note_drift(
    leaf: Leaf, way: float, said: tuple[str, float | None, float | None], course: Profile
) -> None:
    """Report that a change takes over a speed across the road: the XML begins without any."""
    drift = leaf.state.drift
    if drift == 0.0 or said[0] == "constant":
        return
    off = max(apart(course_of_shift(way, *said, leaf.limits, v), course) for v in (-drift, drift))
    leaf.ctx.report.approximate(
        leaf.construct,
        leaf.node.span,
        "it takes over the lateral speed of the change before; one of the XML begins without any",
        Metres(off, "beside, while it changes"),
    )


def _shape(leaf: Leaf, course: Profile, profile: str) -> str:
    """Return the literal for a course; where the scenario leaves it open, any is right."""
    is_free = profile == "none" and not leaf.ctx.profile.has_shapes
    return "linear" if isinstance(course, Linear) or is_free else "sinusoidal"


def _dynamics(leaf: Leaf, shape: str, time: float) -> Element:
    """Return the dynamics of a change of the lane, over a distance for tools that ask for it."""
    dimension, value = "time", time
    speed = leaf.state.speed
    asks = f"LaneChangeActionDynamics/{dimension}" in leaf.ctx.profile.unsupported
    if asks and speed is not None and speed.is_known and speed.low > 0.0 and time > 0.0:
        dimension, value = "distance", time * speed.low
    return element(
        "LaneChangeActionDynamics",
        dynamicsShape=shape,
        dynamicsDimension=dimension,
        value=round(value, 6),
    )


def lanes_to(leaf: Leaf, reference: CastMember, lanes: int) -> int | None:
    """Return how many lanes to its left an actor has the lane beside a reference, if known."""
    roads, mine, theirs = leaf.ctx.roads, leaf.state.lane, lane_of(leaf, reference)
    if roads is None or mine is None or theirs is None:
        return None
    between = roads.lanes_between(mine, theirs)
    return None if between is None else between + lanes


def _from_and_to(leaf: Leaf, lanes: int) -> tuple[LanePosition | None, LanePosition | None]:
    """Return the lane of the actor and the one beside it, as far as they are known.

    After some time it may be on a road that follows: there it changes the lane.

    Raises:
        Inexpressible: There is no such lane: tools would not notice.
    """
    roads, lane = leaf.ctx.roads, leaf.state.lane
    if roads is None or lane is None:
        return lane, None
    here: LanePosition | None = lane
    target = roads.beside(lane, lanes)
    if target is None and not leaf.is_start:
        here = roads.may_be_beside(lane, lanes)
        target = None if here is None else roads.beside(here, lanes)
    if target is None:
        side = "left" if lanes > 0 else "right"
        raise Inexpressible(
            f"there is no driving lane {abs(lanes)} to the {side} of lane {lane.lane} of road"
            f" {lane.road}",
            leaf.node.span,
        )
    return here, target


def _distance(
    leaf: Leaf, lane: LanePosition | None, target: LanePosition | None, lanes: int
) -> float:
    """Return how far (m) a lane is from another one."""
    roads = leaf.ctx.roads
    if roads is None or lane is None or target is None:
        return LANE_WIDTH * abs(lanes)
    here, there = roads.pose(LanePosition(lane.road, lane.lane, lane.s)), roads.pose(target)
    return math.hypot(here.x - there.x, here.y - there.y)


def _offset(state: ActorState) -> float:
    return state.offset.low if state.offset is not None and state.offset.is_known else 0.0


@action("follow_lane")
def _follow_lane(leaf: Leaf) -> Performance:
    arguments = leaf.arguments
    offset = arguments.number("offset") or 0.0
    profile = arguments.member("rate_profile", "none")
    peak = arguments.number("rate_peak")
    target = segment_of(leaf.ctx, arguments.get("target"))
    if target is not None and _lanes_to(leaf, target) != 0:
        raise Inexpressible("it is in another lane; a change of the lane has to come before")
    changes = apply_modifiers(leaf)
    if leaf.state.offset == known(offset):
        return Performance(changes, "open")
    return Performance((offset_change(leaf, offset, profile, peak), *changes), "open")


def offset_change(leaf: Leaf, offset: float, profile: str, peak: float | None) -> Change:
    """Return the change of the place in the lane."""
    way = abs(offset - _offset(leaf.state))
    course = course_of_shift(way, profile, peak, None, leaf.limits)
    _note_drift(leaf, way, (profile, peak, None), course)
    note_slow(leaf, way, course)
    shape = _shape(leaf, course, profile)
    if isinstance(course, Linear):
        leaf.ctx.report.approximate(
            leaf.construct,
            leaf.node.span,
            "the XML says no length for a change of the offset, and a steady one has no peak that"
            " gives it",
            Metres(way, "beside, until it is there"),
        )
    # The XML gives no time, only the peak of the lateral acceleration: that of the shape.
    half_turn = math.pi / course.duration
    peak_rate = 0.5 * way * half_turn * half_turn
    action = lateral(
        element(
            "LaneOffsetAction",
            element(
                "LaneOffsetActionDynamics",
                dynamicsShape=shape,
                maxLateralAcc=round(peak_rate, 6),
            ),
            element("LaneOffsetTarget", element("AbsoluteTargetLaneOffset", value=offset)),
            continuous=False,
        )
    )
    after = replace(leaf.state, offset=known(offset)).finished(LATERAL)
    goes_on = abs(offset) < INSIDE
    during = replace(after, offset=None, drift=fastest(course), aside=way if goes_on else 0.0)
    return Change(LATERAL, (action,), course.duration, during, after, goes_on=goes_on)


def lateral(action: Element) -> Element:
    """Return the private action around a lateral one."""
    return element("PrivateAction", element("LateralAction", action))
