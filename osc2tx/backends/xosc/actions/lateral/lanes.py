"""Lane changes, and changes of the lateral position in the lane (§8.8.3.2, §8.8.3.3)."""

from __future__ import annotations

import math

from osc2tx import ir
from osc2tx.backends.xosc.actions.leaf import Change, Leaf, Performance
from osc2tx.backends.xosc.actions.registry import action, to_goal
from osc2tx.backends.xosc.actions.speed.speed_notes import note_slow
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.entities.declared_roads import segment_of
from osc2tx.backends.xosc.facts.actors import Linear, Pace, Profile, apart, course_of_shift, fastest
from osc2tx.backends.xosc.facts.map_search import MapSegment
from osc2tx.backends.xosc.facts.maps import (
    LanePosition,
    are_opposed,
    is_oncoming,
    lane_either_way,
    number_of_oncoming,
)
from osc2tx.backends.xosc.flattening.tree_queries import shifts_beside
from osc2tx.backends.xosc.report import GENERIC, Inexpressible, Metres
from osc2tx.backends.xosc.state import LATERAL, ActorState, known
from osc2tx.xosc import elements as xml
from osc2tx.xosc.literals import DynamicsDimension, DynamicsShape
from osc2tx_shared.classes import replace

LANE_WIDTH = 3.5
"""Metres between lanes where there is no map to ask."""

NO_ONE_SIDE = "an offset in a lane of oncoming traffic has no one side"


@action("change_lane")
def _change_lane(leaf: Leaf) -> Performance:
    arguments = leaf.arguments
    reference = arguments.entity("reference")
    target = segment_of(leaf.ctx, arguments.get("target"))
    lanes = _lanes(leaf) if target is None else lanes_to_segment(leaf, target)
    offset = arguments.number("offset") or 0.0
    change = lane_change(
        leaf,
        lanes,
        arguments.pace(leaf.duration),
        None if reference is None else reference.name,
        offset=offset,
        own_lanes=None if reference is None else lanes_to(leaf, reference, lanes),
        is_absolute=target is not None,
    )
    return to_goal(leaf, change)


def lanes_to_segment(leaf: Leaf, target: MapSegment) -> int:
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
    count = leaf.arguments.count("num_of_lanes")
    side = leaf.arguments.member("side", "")
    match side:
        case "left":
            return count
        case "right":
            return -count
        case "same":
            return 0
        case "inside" | "outside":
            return count if leaf.is_left(side) else -count
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
    pace: Pace,
    reference: str | None = None,
    *,
    offset: float = 0.0,
    own_lanes: int | None = None,
    jumps: bool = False,
    is_absolute: bool = False,
) -> Change:
    """Return the change to a lane to the left of that of the actor or a reference."""
    state = leaf.state
    if own_lanes is None and reference is None:
        own_lanes = lanes
    here, target = (None, None) if own_lanes is None else _from_and_to(leaf, own_lanes)
    count = 1 if own_lanes is None else own_lanes
    to_lane = math.copysign(_distance(leaf, here, target, count), count)
    way = abs(to_lane + offset - offset_of(state))
    course = course_of_shift(way, pace, leaf.limits)
    limited = leaf.within_limit(pace, course.duration)
    if limited is not pace:
        pace, course = limited, course_of_shift(way, limited, leaf.limits)
    if not jumps:
        note_drift(leaf, way, pace, course)
        note_slow(leaf, way, course)
    time = 0.0 if jumps else course.duration
    if own_lanes is None and pace.duration is None and not jumps:
        leaf.approximate(
            f"how far the lane of {reference} is away is only known during the run",
            f"it takes {time:.3g} s, as to a lane beside it",
        )
    shape = "step" if jumps else shape_of(leaf, course, pace)
    after = replace(state, lane=target, offset=known(offset)).finished(LATERAL)
    if reference is not None and "RelativeTargetLane/entityRef" in leaf.ctx.profile.unsupported:
        if own_lanes is None:
            leaf.ctx.require_support("RelativeTargetLane/entityRef", leaf.node.span)
        reference, lanes = None, count
    goal: xml.LaneChangeTargetPart
    goal = xml.RelativeTargetLane(entityRef=reference or leaf.member.name, value=lanes)
    number = _number_among_oncoming(leaf, here, target, offset)
    if number is not None:
        goal = xml.AbsoluteTargetLane(value=number)
    elif is_absolute and target is not None and leaf.ctx.can("AbsoluteTargetLane", "1.0"):
        goal = xml.AbsoluteTargetLane(value=target.lane)
    action = lateral(
        xml.LaneChangeAction(
            _dynamics(leaf, shape, time),
            xml.LaneChangeTarget(goal),
            targetLaneOffset=along_t(leaf, offset, target) or None,
        )
    )
    drift = 0.0 if jumps else fastest(course)
    during = replace(after, lane=None, offset=None, drift=drift)
    return Change(LATERAL, (action,), time, during, after)


def along_t(leaf: Leaf, offset: float, lane: LanePosition | None = None) -> float:
    """Return an offset (m) to the left of travel as the XML counts it: along t of the road.

    Without a lane it is in that of the actor, as far as it is known.
    """
    roads = leaf.ctx.roads
    sign = None if roads is None else roads.leftwards(lane or leaf.state.lane)
    if offset == 0.0 or sign == 1:
        return offset
    if sign is None:
        leaf.approximate(
            "the XML counts an offset along t of the road, and whether its lane leads along the"
            " road or against it is only known during the run",
            Metres(2.0 * abs(offset), "to the other side where its lane leads against s"),
        )
        return offset
    return -offset


def _number_among_oncoming(
    leaf: Leaf, here: LanePosition | None, target: LanePosition | None, offset: float
) -> int | None:
    """Return the number of the target lane if it or the present one is of oncoming traffic.

    Raises:
        Inexpressible: It is, and the number may change on the way, or there is an offset: its side
            is not the same for all tools.
    """
    roads = leaf.ctx.roads
    if roads is None or here is None or target is None:
        return None
    oncoming = next((place for place in (target, here) if is_oncoming(roads.map, place)), None)
    if oncoming is None:
        return None
    leaf.ctx.require_support("AbsoluteTargetLane", leaf.node.span)
    number = number_of_oncoming(roads.map, oncoming)
    if number is None:
        raise Inexpressible(
            "the lane of oncoming traffic does not stay beside its own all the way, so its number"
            " is only known during the run",
            leaf.node.span,
        )
    if offset:
        raise Inexpressible(NO_ONE_SIDE, leaf.node.span)
    return number if oncoming is target else target.lane


def note_drift(leaf: Leaf, way: float, pace: Pace, course: Profile) -> None:
    """Report that a change takes over a speed across the road: the XML begins without any."""
    drift = leaf.state.drift
    if drift == 0.0 or pace.profile == "constant":
        return
    off = max(apart(course_of_shift(way, pace, leaf.limits, v), course) for v in (-drift, drift))
    leaf.approximate(
        "it takes over the lateral speed of the change before; one of the XML begins without any",
        Metres(off, "beside, while it changes"),
    )


def shape_of(leaf: Leaf, course: Profile, pace: Pace) -> DynamicsShape:
    """Return the literal for a course; where the scenario leaves it open, any is right."""
    is_free = pace.profile == "none" and not leaf.ctx.profile.has_shapes
    return "linear" if isinstance(course, Linear) or is_free else "sinusoidal"


def _dynamics(leaf: Leaf, shape: DynamicsShape, time: float) -> xml.LaneChangeActionDynamics:
    """Return the dynamics of a lane change, over a distance for tools that ask for it."""
    dimension: DynamicsDimension = "time"
    value = time
    speed = leaf.state.known_speed
    asks = f"LaneChangeActionDynamics/{dimension}" in leaf.ctx.profile.unsupported
    if asks and speed is not None and speed > 0.0 and time > 0.0:
        dimension, value = "distance", time * speed
    elif asks and leaf.state.aim and time > 0.0:
        dimension, value = "distance", time * leaf.state.aim
        leaf.approximate(
            f"{leaf.ctx.profile.name} asks for its distance, and the speed may still be changing",
            f"it goes over {value:.3g} m, {time:.3g} s at {leaf.state.aim:.3g} m/s; slower, it is"
            " longer",
            GENERIC,
        )
    return xml.LaneChangeActionDynamics(
        dynamicsShape=shape, dynamicsDimension=dimension, value=round(value, 6)
    )


def lanes_to(leaf: Leaf, reference: CastMember, lanes: int) -> int | None:
    """Return how many lanes to its left an actor has the lane beside a reference, if known.

    Raises:
        Inexpressible: The reference may change lanes meanwhile.
    """
    beside = ir.runs_beside(leaf.ctx.scenario.body, leaf.node)
    nodes = (node for each in beside for node in ir.invocations(each))
    if any(_leaves_lane(node, reference.actor.name) for node in nodes):
        raise Inexpressible(
            f"{reference.name} may be in another lane before it ends; the XML takes the lane at the"
            " start",
            leaf.node.span,
        )
    roads, mine, theirs = leaf.ctx.roads, leaf.state.lane, lane_of(leaf, reference)
    if roads is None or mine is None or theirs is None:
        return None
    between = roads.lanes_between(mine, theirs)
    if between is None:
        return None
    return between - lanes if are_opposed(roads.map, mine, theirs) else between + lanes


def lane_of(leaf: Leaf, other: CastMember) -> LanePosition | None:
    """Return the lane in which another actor is at that time; `None` if only the run shows it.

    Members beside one another are written down one after the other: what the state of an actor is
    then may be that before or after what such a member does.
    """
    if leaf.is_start:
        return leaf.ctx.at_start[other.name].lane
    if shifts_beside(leaf.ctx.scenario.body, leaf.node, other.actor.name):
        return None
    return leaf.ctx.states[other.name].lane


def _leaves_lane(node: ir.Invoke, actor: str) -> bool:
    """Whether an actor goes to another lane in an invocation."""
    if node.actor_name != actor:
        return False
    ends = {call.name for call in node.modifiers if call.at == "end"}
    return node.action == "change_lane" or not ends.isdisjoint(("lane", "change_lane"))


def _from_and_to(leaf: Leaf, lanes: int) -> tuple[LanePosition | None, LanePosition | None]:
    """Return the lane of the actor and the one beside it, as far as they are known.

    After some time it may be on a road that follows: there it changes the lane.

    Raises:
        Inexpressible: There is no such lane: tools would not notice.
    """
    roads, lane = leaf.ctx.roads, leaf.state.lane
    if roads is None or lane is None:
        return lane, None
    here, target = lane, lane_either_way(roads.map, lane, lanes)
    if not leaf.is_start and (target is None or is_oncoming(roads.map, target)):
        # Lanes of its own direction that begin on the way come first.
        later = roads.may_be_beside(lane, lanes)
        if later is not None:
            here, target = later, roads.beside(later, lanes)
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
    centre = lane_either_way(roads.map, lane, 0)
    assert centre is not None
    here, there = roads.map.pose(centre), roads.map.pose(target)
    return math.hypot(here.x - there.x, here.y - there.y)


def offset_of(state: ActorState) -> float:
    """Return how far (m) left of the centre of its lane an actor is, as far as it is known."""
    return state.offset.low if state.offset is not None and state.offset.is_known else 0.0


def lateral(action: xml.LateralActionPart) -> xml.PrivateAction:
    """Return the private action around a lateral one."""
    return xml.PrivateAction(xml.LateralAction(action))
