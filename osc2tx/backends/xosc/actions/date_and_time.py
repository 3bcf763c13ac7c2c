"""Date and time of the environment (§8.10.2)."""

from __future__ import annotations

from datetime import datetime, timedelta

from osc2tx import ir
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.report import Inexpressible
from osc2tx.backends.xosc.values.constants import Constant, MethodResult
from osc2tx.xosc import elements as xml

DAY, CLOCK = ("year", "month", "day"), ("hour", "minute", "second")
"""Parts of a local date and time."""


def environments(ctx: Context) -> list[ir.Actor]:
    """Return the environments; there is one at the most."""
    return [
        declaration
        for declaration in ctx.scenario.declarations
        if isinstance(declaration, ir.Actor) and "environment" in declaration.lineage
    ]


def time_of_day(ctx: Context) -> xml.TimeOfDay | None:
    """Return date and time at the start, if the scenario says them (§8.10.2).

    They are those of the zone of Greenwich; neither a fraction of a second nor a zone stands in the
    text, for there are tools that cannot read them.
    """
    for actor in environments(ctx):
        date = _date(ctx.values.field(actor.name, ("datetime",)))
        if date is not None:
            return xml.TimeOfDay(animation=True, dateTime=date.isoformat())
    return None


def _date(given: Constant | None) -> datetime | None:
    """Return the date of a Unix time, or of local numbers (§8.10.2.1)."""
    try:
        if isinstance(given, MethodResult):
            year, month, day = (round(_number(given.get(part))) for part in DAY)
            hours, minutes, seconds = (_number(given.get(part)) for part in CLOCK)
            hours -= _number(given.get("time_zone"))
            since = timedelta(hours=hours, minutes=minutes, seconds=seconds)
            return datetime(year, month, day) + since
        if isinstance(given, (int, float)):
            return datetime(1970, 1, 1) + timedelta(seconds=round(given))
    except (OverflowError, ValueError) as error:
        raise Inexpressible(f"the date cannot be written: {error}") from None
    return None


def _number(value: Constant | None) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise Inexpressible("the date is only known during the run")
    return float(value)
