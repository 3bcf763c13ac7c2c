"""Actions of vehicles and walkers (§8.8), and the modifiers of their movement (§8.9).

One entry of `ACTIONS` for each action, one of `MODIFIERS` for each modifier; environment, lights
and the like add theirs in files of their own (`registry`).
"""

from __future__ import annotations

import math
from dataclasses import replace

from osc2tx.backends.xosc.cast import CastMember
from osc2tx.backends.xosc.facts import LanePosition, Linear, course_of_shift
from osc2tx.backends.xosc.leaf import Arguments, Change, Ending, Leaf, Performance
from osc2tx.backends.xosc.modify import modified
from osc2tx.backends.xosc.registry import action
from osc2tx.backends.xosc.report import Inexpressible
from osc2tx.backends.xosc.speed_modifiers import time_to_cover
from osc2tx.backends.xosc.speeds import change_speed, jump_to
from osc2tx.backends.xosc.state import LATERAL, ActorState, known
from osc2tx.backends.xosc.tree import Element, element
from osc2tx.backends.xosc.walking import stand, walk_on

LANE_WIDTH = 3.5
"""Metres between lanes where there is no map to ask."""


@action("drive", "move")
def _drive(leaf: Leaf) -> Performance:
    if leaf.state.pose is not None and leaf.member.walks:
        return _walk(leaf)
    changes = modified(leaf)
    ends: Ending = "goal" if _has_goal(leaf) else "open"
    return Performance(changes, ends, time_to_cover(leaf), leaf.reached)


@action("walk")
def _walk(leaf: Leaf) -> Performance:
    if leaf.state.pose is None:
        return _drive(leaf)
    names = {call.name for call in leaf.node.modifiers}
    if names and names <= {"along", "along_trajectory", "physical_movement"}:
        return Performance(modified(leaf), "goal")
    if names == {"keep_position"}:
        leaf.ctx.report.exact("modifier keep_position", leaf.node.modifiers[0].span)
        is_still = leaf.state.speed == known(0.0)
        return Performance(() if is_still else (stand(leaf),), "open")
    for call in leaf.node.modifiers:
        if call.name != "speed" or call.at == "end":
            raise Inexpressible(f"`{call.name}` of a walker off the lanes", call.span)
    return Performance((walk_on(leaf, _walking_speed(leaf)),), "open")


def _walking_speed(leaf: Leaf) -> float | None:
    for call in leaf.node.modifiers:
        arguments = Arguments(leaf.ctx, call.arguments, call)
        with leaf.ctx.report_as(f"modifier {call.name}", call.span):
            speed = arguments.number("speed")
            arguments.finish()
            return speed
    return None


@action("change_speed")
def _change_speed(leaf: Leaf) -> Performance:
    arguments = leaf.arguments
    target = arguments.number("target")
    if target is None:
        raise Inexpressible("it has no target", leaf.node.span)
    profile = arguments.member("rate_profile", "none")
    peak = arguments.number("rate_peak")
    change = change_speed(leaf, target, profile, peak, leaf.duration)
    return Performance((change, *modified(leaf)), "goal")


@action("assign_speed")
def _assign_speed(leaf: Leaf) -> Performance:
    target = leaf.arguments.number("speed")
    if target is None:
        raise Inexpressible("it has no speed", leaf.node.span)
    return Performance((jump_to(leaf, target),), "goal")


@action("keep_speed")
def _keep_speed(leaf: Leaf) -> Performance:
    return Performance(modified(leaf), "open")


@action("remain_stationary")
def _remain_stationary(leaf: Leaf) -> Performance:
    if leaf.state.speed == known(0.0):
        return Performance(modified(leaf), "open")
    if leaf.member.walks:
        return Performance((stand(leaf),), "open")
    return Performance((change_speed(leaf, 0.0, "asap", None, None), *modified(leaf)), "open")


# --- lanes --------------------------------------------------------------------------------------


@action("change_lane")
def _change_lane(leaf: Leaf) -> Performance:
    arguments = leaf.arguments
    reference = arguments.entity("reference")
    lanes = _lanes(leaf, reference is None)
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
    )
    return Performance((change, *modified(leaf)), "goal")


def _lanes(leaf: Leaf, is_own: bool) -> int:
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
    raise Inexpressible("the side is drawn for each run; say `left` or `right`", leaf.node.span)


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
) -> Change:
    """Return the change to a lane so many to the left of that of the actor or a reference."""
    state = leaf.state
    if own_lanes is None and reference is None:
        own_lanes = lanes
    target = None if own_lanes is None else target_lane(leaf, own_lanes)
    count = 1 if own_lanes is None else own_lanes
    to_lane = math.copysign(distance_between(leaf, state.lane, target, count), count)
    way = abs(to_lane + offset - _offset(state))
    course = course_of_shift(way, profile, peak, duration, leaf.limits)
    shape = "linear" if isinstance(course, Linear) else "sinusoidal"
    time = course.duration
    if jumps:
        shape, time = "step", 0.0
    after = replace(state, lane=target, offset=known(offset)).finished(LATERAL)
    action = lateral(
        element(
            "LaneChangeAction",
            element(
                "LaneChangeActionDynamics",
                dynamicsShape=shape,
                dynamicsDimension="time",
                value=round(time, 6),
            ),
            element(
                "LaneChangeTarget",
                element(
                    "RelativeTargetLane",
                    entityRef=reference or leaf.member.name,
                    value=lanes,
                ),
            ),
            targetLaneOffset=offset or None,
        )
    )
    during = replace(after, lane=None, offset=None)
    return Change(LATERAL, (action,), time, during, after)


def lanes_to(leaf: Leaf, reference: CastMember, lanes: int) -> int | None:
    """Return how many lanes to its left an actor has the lane beside a reference, if known."""
    roads, mine = leaf.ctx.roads, leaf.state.lane
    theirs = leaf.ctx.states[reference.name].lane
    if roads is None or mine is None or theirs is None:
        return None
    between = roads.lanes_between(mine, theirs)
    return None if between is None else between + lanes


def target_lane(leaf: Leaf, lanes: int) -> LanePosition | None:
    """Return the lane beside that of the actor; `None` if its lane is not known.

    Raises:
        Inexpressible: There is no such lane: tools would not notice.
    """
    roads, lane = leaf.ctx.roads, leaf.state.lane
    if roads is None or lane is None:
        return None
    target = roads.beside(lane, lanes)
    if target is None:
        side = "left" if lanes > 0 else "right"
        raise Inexpressible(
            f"there is no driving lane {abs(lanes)} to the {side} of lane {lane.lane} of road"
            f" {lane.road}",
            leaf.node.span,
        )
    return target


def distance_between(
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
    changes = modified(leaf)
    if leaf.state.offset == known(offset):
        return Performance(changes, "open")
    return Performance((offset_change(leaf, offset, profile, peak), *changes), "open")


def offset_change(leaf: Leaf, offset: float, profile: str, peak: float | None) -> Change:
    """Return the change of the place in the lane."""
    way = abs(offset - _offset(leaf.state))
    course = course_of_shift(way, profile, peak, None, leaf.limits)
    shape = "linear" if isinstance(course, Linear) else "sinusoidal"
    # The XML gives no time, only the peak of the lateral acceleration: that of the shape.
    half_turn = 3.141592653589793 / course.duration
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
    return Change(LATERAL, (action,), course.duration, replace(after, offset=None), after)


def lateral(action: Element) -> Element:
    """Return the private action around a lateral one."""
    return element("PrivateAction", element("LateralAction", action))


def _has_goal(leaf: Leaf) -> bool:
    if leaf.duration is not None:
        return False
    modifiers = leaf.node.modifiers
    return any(call.at == "end" or call.name.startswith("along") for call in modifiers)
