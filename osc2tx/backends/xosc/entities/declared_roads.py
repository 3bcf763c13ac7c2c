"""Roads and lanes that a scenario declares, searched on the map (§8.12)."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.backends.xosc.actions.registry import WITHOUT_FORM, without_form
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.facts.map_search import PARTS, MapQuery, MapSegment, search_map
from osc2tx.backends.xosc.values.constants import Constant, Named
from osc2tx.losses.entries import Inexpressible

without_form(
    "modifier",
    "set_traffic_lights_control_file",
    "cycles of a file that only the embedded world reads",
)


def segment_of(ctx: Context, value: Constant | None) -> MapSegment | None:
    """Return where on the map a declared road or lane is; `None` for everything else.

    Raises:
        Inexpressible: The map has nothing like it, or is not at hand.
    """
    if not isinstance(value, Named) or ctx.values.type_of(value.name) not in PARTS:
        return None
    return _segments(ctx).get(value.name)


def check_declared(ctx: Context) -> None:
    """See to it that the map has the roads that are declared, whether they are used or not."""
    if ctx.roads is not None:
        try:
            _segments(ctx)
        except Inexpressible as error:
            ctx.report.cannot("roads of the map", ctx.scenario.span, error.reason)


def check_map(ctx: Context, placement: ir.Placement) -> None:
    """See to it that the map is as its modifiers want it.

    Raises:
        Inexpressible: It is not, or cannot be asked.
    """
    for call in placement.modifiers:
        with ctx.report_as(f"modifier {call.name}", call.span):
            if call.name in WITHOUT_FORM["modifier"]:
                raise Inexpressible(WITHOUT_FORM["modifier"][call.name])
            if call.name != "set_map_file":
                _segments(ctx)


def is_map(ctx: Context, name: str) -> bool:
    """Whether a declaration is the map."""
    return any(actor.name == name for actor in ctx.actors_like("map"))


def _segments(ctx: Context) -> dict[str, MapSegment]:
    if ctx.segments is None:
        parts = {
            each.name: MapQuery(each.type, _said(ctx, each))
            for each in ctx.scenario.declarations
            if isinstance(each, ir.Struct) and each.type in PARTS and each.value is None
        }
        relations = [
            MapQuery(call.name, {a.parameter: ctx.values.of(a.value) for a in call.arguments})
            for placement in ctx.scenario.placements
            if is_map(ctx, placement.actor)
            for call in placement.modifiers
            if call.name != "set_map_file" and call.name not in WITHOUT_FORM["modifier"]
        ]
        ctx.segments = search_map(ctx.required_roads(), parts, relations)
    return ctx.segments


def _said(ctx: Context, part: ir.Struct) -> dict[str, Constant | MapQuery]:
    """Return what constraints fix about a part."""
    properties: dict[str, Constant | MapQuery] = {}
    crossing: dict[str, Constant | MapQuery] = {}
    for value in part.values:
        match value.path:
            case (name,):
                properties[name] = ctx.values.of(value.value)
            case ("crossing_type", name):
                crossing[name] = ctx.values.of(value.value)
            case _:
                text = ".".join(value.path)
                raise Inexpressible(f"`{text}` of `{part.name}` cannot be determined from the map")
    if crossing:
        properties["crossing_type"] = MapQuery("crossing_type", crossing)
    return properties
