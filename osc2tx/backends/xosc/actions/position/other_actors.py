"""What is known of other actors when an action begins."""

from __future__ import annotations

from osc2tx.backends.xosc.actions.leaf import Leaf
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.facts.maps import LanePosition
from osc2tx.backends.xosc.flattening.tree_queries import shifts_beside


def lane_of(leaf: Leaf, other: CastMember) -> LanePosition | None:
    """Return the lane in which another actor is at that time; `None` if only the run shows it.

    Members beside one another are written down one after the other: what the state of an actor is
    then may be that before or after what such a member does.
    """
    ctx = leaf.ctx
    if leaf.is_start:
        return ctx.at_start[other.name].lane
    if shifts_beside(ctx.scenario.body, leaf.node, other.actor.name):
        return None
    return ctx.states[other.name].lane
