"""Lane changes (§8.8.3.2), and the course of movements across the road.

In the world nobody goes sideways by more than a share of the way driven, and who stands does not at
all; a change of the XML takes its time whatever the speed.
"""

from __future__ import annotations

import math
from functools import partial

from osc2tx import ir
from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.actions.leaf import Change, Leaf, Performance
from osc2tx.backends.xosc.actions.registry import action, to_goal
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.entities.declared_roads import segment_of
from osc2tx.backends.xosc.facts.actors import Linear, Pace, course_of_shift
from osc2tx.backends.xosc.facts.map_search import MapSegment
from osc2tx.backends.xosc.facts.maps import (
    LanePosition,
    actual_lane,
    are_opposed,
    is_oncoming,
    lane_either_way,
)
from osc2tx.backends.xosc.state import LATERAL, ActorState, known
from osc2tx.losses.entries import GENERIC, Inexpressible
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
    if target is None:
        lanes = lanes_aside(leaf, arguments, "num_of_lanes")
    else:
        lanes = lanes_to_segment(leaf, target)
    change = lane_change(
        leaf,
        lanes,
        arguments.pace(leaf.duration),
        reference,
        offset=arguments.number("offset") or 0.0,
        own_lanes=None if reference is None else lanes_to(leaf, reference, lanes),
        is_absolute=target is not None,
    )
    return to_goal(leaf, change)


def lanes_to_segment(leaf: Leaf, target: MapSegment) -> int:
    """Return how many lanes to the left a lane of the map is."""
    roads, here = leaf.ctx.roads, leaf.state.lane
    if target.lane is None:
        raise Inexpressible(f"a {target.kind} is no lane")
    if roads is None or here is None:
        raise Inexpressible("which lane it is in is only known during the run")
    lanes = roads.lanes_between(here, LanePosition(target.road, target.lane, here.s))
    if lanes is None:
        raise Inexpressible(f"{target} is not beside lane {here.lane} of road {here.road}")
    return lanes


def lanes_aside(leaf: Leaf, arguments: Arguments, name: str) -> int:
    """Return the lanes that an argument counts to the `side`: positive to the left."""
    count, side = arguments.count(name), arguments.member("side", "")
    if side == "same":
        return 0
    if side in ("inside", "outside"):
        return count if leaf.is_left(side) else -count
    return count if (side or _drawn_side(leaf, arguments, count)) == "left" else -count


def _drawn_side(leaf: Leaf, arguments: Arguments, count: int) -> str:
    """Return the side that a parameter of the document gives, of those with a lane."""
    choosing = leaf.ctx.choosing
    choice = choosing.drawn(leaf.ctx.scope, arguments.source)
    if choice is None:
        reason = "the side is drawn for each run; say `left` or `right`"
        raise Inexpressible(reason, arguments.span)
    drawn = str(choosing.point[choice.key])
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
    reference: CastMember | None = None,
    *,
    offset: float = 0.0,
    own_lanes: int | None = None,
    jumps: bool = False,
    is_absolute: bool = False,
) -> Change:
    """Return the change to a lane to the left of that of the actor or a reference."""
    state, roads = leaf.state, leaf.ctx.roads
    if own_lanes is None and reference is None:
        own_lanes = lanes
    here, target = (None, None) if own_lanes is None else _from_and_to(leaf, own_lanes)
    count = 1 if own_lanes is None else own_lanes
    to_lane = LANE_WIDTH * count
    if roads is not None and here is not None and target is not None:
        centre = lane_either_way(roads.map, here, 0)
        assert centre is not None
        ways = (roads.map.pose(place)[:2] for place in (centre, target))
        to_lane = math.copysign(math.dist(*ways), count)
    way = abs(to_lane + offset - offset_of(state))
    shape, time = shift(leaf, way, pace, jumps=jumps)
    after = replace(state, lane=target, offset=known(offset)).finished(LATERAL)
    if reference is not None and "RelativeTargetLane/entityRef" in leaf.ctx.profile.unsupported:
        if own_lanes is None:
            leaf.ctx.require_support("RelativeTargetLane/entityRef")
        reference, lanes = None, count
    goal: xml.LaneChangeTargetPart
    goal = xml.RelativeTargetLane(entityRef=(reference or leaf.member).name, value=lanes)
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
    during = replace(after, lane=None, offset=None)
    return Change(LATERAL, (action,), time, during, after)


def _number_among_oncoming(
    leaf: Leaf, here: LanePosition | None, target: LanePosition | None, offset: float
) -> int | None:
    """Return the number of the target lane if it or the present one is of oncoming traffic."""
    roads = leaf.ctx.roads
    if roads is None or here is None or target is None:
        return None
    oncoming = next((place for place in (target, here) if is_oncoming(roads.map, place)), None)
    if oncoming is None:
        return None
    leaf.ctx.require_support("AbsoluteTargetLane")
    if offset:
        raise Inexpressible(NO_ONE_SIDE)
    return actual_lane(roads.map, oncoming).lane if oncoming is target else target.lane


def _dynamics(leaf: Leaf, shape: DynamicsShape, time: float) -> xml.LaneChangeActionDynamics:
    """Return the dynamics of a lane change, over a distance for tools that ask for it."""
    dimension: DynamicsDimension = "time"
    value, tool = time, leaf.ctx.profile
    if "LaneChangeActionDynamics/time" in tool.unsupported and value > 0.0:
        speed = leaf.state.known_speed
        speed = speed if speed is not None and speed > 0.0 else leaf.state.aim
        if speed:
            dimension, value = "distance", value * speed
        if speed and speed != leaf.state.known_speed:
            leaf.arguments.approximate(
                f"{tool.name} asks for its distance, and the speed may still be changing",
                f"it goes over {value:.3g} m, {time:.3g} s at {speed:.3g} m/s; slower, it is"
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
    own = (node for node in nodes if node.actor_name == reference.actor.name)
    if any(
        node.action == "change_lane"
        or any(m.at == "end" and m.name in ("lane", "change_lane") for m in node.modifiers)
        for node in own
    ):
        raise Inexpressible(
            f"{reference.name} may be in another lane before it ends; the XML takes the lane at the"
            " start"
        )
    roads, mine, theirs = leaf.ctx.roads, leaf.state.lane, leaf.state_of(reference).lane
    if roads is None or mine is None or theirs is None:
        return None
    between = roads.lanes_between(mine, theirs)
    if between is None:
        return None
    return between - lanes if are_opposed(roads.map, mine, theirs) else between + lanes


def _from_and_to(leaf: Leaf, lanes: int) -> tuple[LanePosition | None, LanePosition | None]:
    """Return the lane of the actor and the one beside it, as far as they are known.

    After some time it may be on a road that follows: there it changes the lane.
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
            f" {lane.road}"
        )
    return here, target


def shift(
    leaf: Leaf, way: float, pace: Pace, *, jumps: bool = False
) -> tuple[DynamicsShape, float]:
    """Return shape and length (s) of a movement across the road by so many metres.

    Reported is why the one of the XML may differ from that of the world.
    """
    planned = partial(course_of_shift, way, limits=leaf.limits)
    pace, course = leaf.within_limit(pace, planned)
    if jumps:
        return "step", 0.0
    if leaf.state.offset is None and pace.profile != "constant":
        leaf.arguments.doubt(
            "it takes over the lateral speed of the change before; one of the XML begins without"
            " any"
        )
    # Where the scenario leaves the shape open, any is right.
    is_free = pace.profile == "none" and not leaf.ctx.profile.has_shapes
    is_even = isinstance(course, Linear) or is_free
    return "linear" if is_even else "sinusoidal", course.duration


def along_t(leaf: Leaf, offset: float, lane: LanePosition | None = None) -> float:
    """Return an offset (m) to the left of travel as the XML counts it: along t of the road.

    Without a lane it is in that of the actor, as far as it is known.
    """
    roads = leaf.ctx.roads
    sign = None if roads is None else roads.leftwards(lane or leaf.state.lane)
    return offset if offset == 0.0 or sign != -1 else -offset


def offset_of(state: ActorState) -> float:
    """Return how far (m) left of the centre of its lane an actor is, as far as it is known."""
    return state.offset.low if state.offset is not None and state.offset.is_known else 0.0


def lateral(action: xml.LateralActionPart) -> xml.PrivateAction:
    """Return the private action around a lateral one."""
    return xml.PrivateAction(xml.LateralAction(action))
