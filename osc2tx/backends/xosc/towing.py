"""Trailers: who tows which from the start, and where they are coupled."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.backends.xosc.cast import CastMember
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.facts import DRAWBAR
from osc2tx.backends.xosc.report import Inexpressible
from osc2tx.backends.xosc.tree import Element, element
from osc2tx.backends.xosc.values import Named


def towing(ctx: Context) -> dict[str, str]:
    """Return the entity that tows each trailer at the start, by trailer.

    Raises:
        Inexpressible: A trailer is no entity of the XML.
    """
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


def hitch_of(vehicle: CastMember) -> float:
    """Return where the hitch of a vehicle is (m before its reference point): at its rear end."""
    return -vehicle.shape.rear


def coupler_of(trailer: CastMember) -> float:
    """Return where the coupler of a trailer is (m before its reference point)."""
    return trailer.shape.front + DRAWBAR


def couplings(ctx: Context, member: CastMember) -> tuple[Element, ...]:
    """Return what a vehicle has for being coupled, and the trailer that it tows at the start."""
    if ctx.version < "1.3" or not any("trailer" in m.actor.lineage for m in ctx.cast.values()):
        return ()
    if "trailer" in member.actor.lineage:
        return (element("TrailerCoupler", dx=round(coupler_of(member), 6)),)
    parts = [element("TrailerHitch", dx=round(hitch_of(member), 6))] if _tows(ctx, member) else []
    for trailer, tow in towing(ctx).items():
        if tow == member.name:
            parts.append(element("Trailer", element("TrailerRef", entityRef=trailer)))
    return tuple(parts)


def _tows(ctx: Context, member: CastMember) -> bool:
    """Whether a vehicle tows a trailer at some time."""
    if member.name in towing(ctx).values():
        return True
    return any(
        isinstance(node, ir.Invoke)
        and node.action == "connect_trailer"
        and isinstance(node.actor, ir.FieldRef)
        and node.actor.name == member.actor.name
        for node in ir.walk_behaviors(ctx.scenario.body)
    )
