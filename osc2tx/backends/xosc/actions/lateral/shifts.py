"""Movements across the road: their course, and how far the XML differs from it.

In the world nobody goes sideways by more than a share of the way driven, and who stands does not at
all; a change of the XML takes its time whatever the speed.
"""

from __future__ import annotations

from functools import partial

from osc2tx.backends.xosc.actions.leaf import Leaf
from osc2tx.backends.xosc.facts.actors import Linear, Pace, course_of_shift
from osc2tx.backends.xosc.facts.maps import LanePosition
from osc2tx.backends.xosc.state import ActorState
from osc2tx.xosc import elements as xml
from osc2tx.xosc.literals import DynamicsShape


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
