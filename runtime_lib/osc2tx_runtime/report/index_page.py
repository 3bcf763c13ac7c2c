"""The index of many runs: one row for each, with a link to its page."""

from __future__ import annotations

from collections.abc import Sequence

from .html import page, resource, resources
from .json_values import Json, number, plain, text
from .page import Trace


def render_index(rows: Sequence[Json]) -> str:
    """The index of rows (`index_row`) as text; equal arguments give equal text."""
    style, script = resource("report.css"), resources("base.js", "index.js")
    purpose = "This page lists its runs"
    return page("index.html", "Runs", purpose, style, script, {"runs": list(rows)})


def index_row(place: str, trace: Trace) -> Json:
    """A run in the index.

    Args:
        place: Its page, relative to the index, with `/`.
        trace: Its trace.
    """
    run = trace.run
    result = run.result or {}
    warnings = result.get("warnings")
    parameters, units = run.header.get("parameters"), run.header.get("units")
    return {
        "page": place,
        "name": trace.name,
        "scenario": text(run.header.get("scenario")),
        "world": text(run.header.get("world")) or "embedded",
        "seed": text(run.header.get("seed")),
        "parameters": plain(parameters) if isinstance(parameters, dict) else {},
        "units": plain(units) if isinstance(units, dict) else {},
        "status": text(result.get("status")),
        "reason": text(result.get("reason")),
        "duration": number(run.end),
        "collisions": sum(mark["kind"] == "collision" for mark in run.marks),
        "warnings": len(warnings) if isinstance(warnings, list) else 0,
    }
