"""Coupling and uncoupling of trailers (§8.8.3.12, §8.8.3.13), from 1.3 on."""

from __future__ import annotations

from osc2tx.backends.xosc.actions.leaf import Change, Leaf, Performance
from osc2tx.backends.xosc.actions.registry import action
from osc2tx.backends.xosc.actions.speed.speed_changes import within_limits
from osc2tx.backends.xosc.entities.towing import only_trailer
from osc2tx.backends.xosc.facts.actors import held_by, road_condition
from osc2tx.backends.xosc.report import Inexpressible
from osc2tx.xosc import elements as xml


@action("connect_trailer")
def _connect(leaf: Leaf) -> Performance:
    trailer = leaf.arguments.entity("trailer")
    if trailer is None:
        raise Inexpressible("it names no trailer", leaf.node.span)
    return _act(leaf, xml.ConnectTrailerAction(trailerRef=trailer.name))


@action("disconnect_trailer")
def _disconnect(leaf: Leaf) -> Performance:
    trailer = only_trailer(leaf.ctx, leaf.member)
    if trailer is None:
        note = "what the trailer does then is up to the tool: the embedded world lets it stand"
        leaf.ctx.report.exact(leaf.construct, leaf.node.span, note)
    else:
        limits = held_by(trailer.limits, road_condition(leaf.ctx.weather))
        leaf.others.append((trailer, within_limits(0.0, limits, "asap", None), "stands"))
    return _act(leaf, xml.DisconnectTrailerAction())


def _act(leaf: Leaf, what: xml.TrailerActionPart) -> Performance:
    leaf.ctx.require("a trailer that is coupled", "1.3", leaf.node.span)
    leaf.ctx.require_support("TrailerAction", leaf.node.span)
    action = xml.PrivateAction(xml.TrailerAction(what))
    return Performance((Change("trailer", (action,), 0.0, leaf.state, leaf.state),), "goal")
