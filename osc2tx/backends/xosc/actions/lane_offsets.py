"""The lateral position in a lane (§8.8.3.3)."""

from __future__ import annotations

import math

from osc2tx.backends.xosc.actions.apply_modifiers import apply_modifiers
from osc2tx.backends.xosc.actions.lanes import (
    NO_ONE_SIDE,
    lanes_to_segment,
    lateral,
    note_drift,
    offset_of,
    shape_of,
)
from osc2tx.backends.xosc.actions.leaf import Change, Leaf, Performance
from osc2tx.backends.xosc.actions.registry import action
from osc2tx.backends.xosc.actions.slow_shifts import note_slow
from osc2tx.backends.xosc.entities.declared_roads import segment_of
from osc2tx.backends.xosc.facts.actors import Linear, course_of_shift, fastest
from osc2tx.backends.xosc.facts.oncoming_lanes import is_oncoming
from osc2tx.backends.xosc.report import Inexpressible, Metres
from osc2tx.backends.xosc.state import LATERAL, known
from osc2tx.backends.xosc.xml.tree import element
from osc2tx_classes import replace

INSIDE = 1.2
"""Metres from the centre that are inside of any lane: there what is cut short goes on."""


@action("follow_lane")
def _follow_lane(leaf: Leaf) -> Performance:
    arguments = leaf.arguments
    offset = arguments.number("offset") or 0.0
    profile = arguments.member("rate_profile", "none")
    peak = arguments.number("rate_peak")
    target = segment_of(leaf.ctx, arguments.get("target"))
    if target is not None and lanes_to_segment(leaf, target) != 0:
        raise Inexpressible("it is in another lane; a change of the lane has to come before")
    changes = apply_modifiers(leaf)
    if leaf.state.offset == known(offset):
        return Performance(changes, "open")
    return Performance((offset_change(leaf, offset, profile, peak), *changes), "open")


def offset_change(leaf: Leaf, offset: float, profile: str, peak: float | None) -> Change:
    """Return the change of the place in the lane.

    Raises:
        Inexpressible: It is in a lane of oncoming traffic.
    """
    roads, lane = leaf.ctx.roads, leaf.state.lane
    if roads is not None and lane is not None and is_oncoming(roads.map, lane):
        raise Inexpressible(NO_ONE_SIDE, leaf.node.span)
    way = abs(offset - offset_of(leaf.state))
    course = course_of_shift(way, profile, peak, None, leaf.limits)
    note_drift(leaf, way, (profile, peak, None), course)
    note_slow(leaf, way, course)
    shape = shape_of(leaf, course, profile)
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
