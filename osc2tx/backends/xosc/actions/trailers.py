"""Trailers: couplings at the start, coupling and uncoupling (§8.8.3.12, §8.8.3.13), from 1.3 on."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeVar

from osc2tx import ir
from osc2tx.backends.xosc.actions.arguments import Arguments
from osc2tx.backends.xosc.actions.leaf import Change, Leaf, Performance
from osc2tx.backends.xosc.actions.registry import action, at_start
from osc2tx.backends.xosc.actions.speed.speed_changes import within_limits
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.facts.actors import DRAWBAR, FASTEST, held_by, road_condition
from osc2tx.backends.xosc.values.constants import Named
from osc2tx.losses.entries import Inexpressible
from osc2tx.xosc import elements as xml


@action("connect_trailer")
def _connect(leaf: Leaf) -> Performance:
    trailer = leaf.arguments.required_entity("trailer")
    return _act(leaf, xml.ConnectTrailerAction(trailerRef=trailer.name))


@action("disconnect_trailer")
def _disconnect(leaf: Leaf) -> Performance:
    trailer = only_trailer(leaf.ctx, leaf.member)
    if trailer is None:
        note = "what the trailer does then is up to the tool: the embedded world lets it stand"
        leaf.ctx.report.exact(leaf.arguments.construct, leaf.node.span, note)
    else:
        limits = held_by(trailer.limits, road_condition(leaf.ctx.weather))
        leaf.others.append((trailer, within_limits(0.0, limits, FASTEST), "stands"))
    return _act(leaf, xml.DisconnectTrailerAction())


def _act(leaf: Leaf, what: xml.TrailerActionPart) -> Performance:
    leaf.ctx.require("a trailer that is coupled", "1.3")
    leaf.ctx.require_support("TrailerAction")
    action = xml.PrivateAction(xml.TrailerAction(what))
    return Performance((Change("trailer", (action,), 0.0, leaf.state, leaf.state),), "goal")


at_start("tow_trailer")


def towing(ctx: Context) -> dict[str, str]:
    """Return the entity that tows each trailer at the start, by trailer."""
    found = {}
    for placement in ctx.scenario.placements:
        for call in placement.modifiers:
            if call.name != "tow_trailer":
                continue
            for argument in call.arguments:
                trailer = ctx.values.of(argument.value)
                if not isinstance(trailer, Named) or trailer.name not in ctx.cast:
                    raise Inexpressible("the trailer is no entity of the XML", call.span)
                found[ctx.cast[trailer.name].name] = ctx.cast[placement.actor].name
    return found


Half = TypeVar("Half", xml.TrailerCoupler, xml.TrailerHitch)


def _half(ctx: Context, kind: type[Half], member: CastMember, field: str, usual: float) -> Half:
    x, z = (ctx.values.number_in(member.actor.name, field, f"position_{axis}") for axis in "xz")
    return kind(dx=round(usual if x is None else x, 6), dz=z)


def couplings(ctx: Context, member: CastMember) -> tuple[xml.VehiclePart, ...]:
    """Return what a vehicle has for being coupled, and the trailer that it tows at the start.

    If the scenario says nothing else, it tows at its rear end, and is towed before its box.
    """
    if ctx.version < "1.3" or not any("trailer" in m.actor.lineage for m in ctx.cast.values()):
        return ()
    if "trailer" in member.actor.lineage:
        return (_half(ctx, xml.TrailerCoupler, member, "coupler", member.shape.front + DRAWBAR),)
    parts: list[xml.VehiclePart] = []
    if member.name in towing(ctx).values() or any(_couplings_made_by(ctx, member)):
        rear = -member.shape.rear
        parts.append(_half(ctx, xml.TrailerHitch, member, "trailer_receiver", rear))
    for trailer, tow in towing(ctx).items():
        if tow == member.name:
            parts.append(xml.Trailer(xml.TrailerRef(entityRef=trailer)))
    return tuple(parts)


def _couplings_made_by(ctx: Context, vehicle: CastMember) -> Iterator[ir.Invoke]:
    for node in ir.invocations(ctx.scenario.body):
        if node.action == "connect_trailer" and node.actor_name == vehicle.actor.name:
            yield node


def only_trailer(ctx: Context, vehicle: CastMember) -> CastMember | None:
    """Return the trailer that a vehicle tows whenever it tows one; `None` if there are several."""
    found = {trailer for trailer, tow in towing(ctx).items() if tow == vehicle.name}
    for node in _couplings_made_by(ctx, vehicle):
        trailer = Arguments(ctx, node).entity("trailer")
        if trailer is not None:
            found.add(trailer.name)
    members = [member for member in ctx.cast.values() if member.name in found]
    return members[0] if len(members) == 1 else None
