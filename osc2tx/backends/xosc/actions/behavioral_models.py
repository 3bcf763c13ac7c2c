"""Behavioral models (§8.6), which the XML cannot express."""

from __future__ import annotations

from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.cast import CastMember
from osc2tx.backends.xosc.report import Inexpressible, Remedy
from osc2tx.diagnostics import Span

# Holds the speed and keeps the lane, as the default controller of the XML does.
DEFAULT = "steady_driver"


def check_model(ctx: Context, member: CastMember) -> None:
    """Refuse an entity that starts with another model than the default one."""
    name = ctx.values.field(member.actor.name, ("initial_bm", "bm_engine", "name"))
    if name not in (None, DEFAULT):
        raise no_model(f"what a `{name}` does", member.actor.span)


def no_model(what: str, span: Span) -> Inexpressible:
    """Return why a behavioral model cannot be written."""
    reason = f"{what} is up to the controllers of a tool; the XML cannot say it"
    asks = ("SpeedActionDynamics", "LaneChangeActionDynamics")
    saying = Remedy(instead="actions that say speed and lane are exact", asks=asks)
    return Inexpressible(reason, span, saying)
