"""The page of one run, or of two overlaid runs."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Protocol

from .html import fill, resource
from .json_values import Json
from .nearby_lanes import OutlineSource, nearby_crosswalks, nearby_lanes
from .surroundings import SignalSource
from .trace_reader import read_run
from .tracks import DIGITS


def render_campaign(data: Json) -> str:
    """Return the page as text; equal data give equal text.

    Args:
        data: A summary, coverage, and columns of rows, as `osc2tx campaign report` collects them.
    """
    script = "\n".join(resource(name) for name in ("base.js", "campaign.js", "parallel.js"))
    style = "\n".join(resource(name) for name in ("report.css", "campaign.css"))
    return fill(resource("campaign.html"), style, script, data)


def render_project(data: Json) -> str:
    """Return the page of a project as text; equal data give equal text.

    Args:
        data: Verdicts of scenarios, XML by reason, and campaigns, as `osc2tx test --page` and
            `osc2tx campaign report` of several stores collect them.
    """
    script = "\n".join(resource(name) for name in ("base.js", "project.js"))
    return fill(resource("project.html"), resource("report.css"), script, data)


_VENDOR_SCRIPT, _VENDOR_STYLE, _VENDOR_LICENCE = (
    f"vendor/{name}" for name in ("uplot.js", "uplot.css", "LICENSE")
)
_SCRIPTS = (
    "base.js",
    "core.js",
    "later.js",
    "export.js",
    "roads.js",
    "surroundings.js",
    "camera.js",
    "labels.js",
    "view.js",
    "distances.js",
    "charts.js",
    "timeline.js",
    "actors.js",
    "tree.js",
    "log.js",
    "header.js",
    "transport.js",
    "report.js",
)
_LETTERS = "AB"


class MapSource(OutlineSource, SignalSource, Protocol):
    """The part of `osc2tx_runtime.opendrive.RoadMap` that is drawn."""


class Trace:
    """The content of a trace for a page.

    Args:
        lines: Its lines; broken and unknown ones are counted on the page.
        name: Its name on the page.

    Attributes:
        run: Its content; takes further lines.
        name: As above.
    """

    def __init__(self, lines: Iterable[str] = (), name: str = "") -> None:
        self.run = read_run(lines)
        self.name = name


def write_report(path: Path, trace_lines: Iterable[str], road_map: MapSource | None = None) -> None:
    """Write the report of one run.

    Args:
        path: The HTML file to write; its folder must exist.
        trace_lines: The lines of the trace. Broken and unknown lines are counted on the page.
        road_map: The map to draw under the paths (a `RoadMap`), None: no map.
    """
    page = render_report(trace_lines, road_map)
    path.write_text(page, encoding="utf-8", newline="\n")


def render_report(trace_lines: Iterable[str], road_map: MapSource | None = None) -> str:
    """The page of one run as text; equal arguments give equal text."""
    return render_runs([Trace(trace_lines)], road_map)


def render_runs(traces: Sequence[Trace], road_map: MapSource | None = None) -> str:
    """The page of one run, or of two overlaid runs, as text.

    Args:
        traces: One or two.
        road_map: The map under the paths of both; None: no map.
    """
    runs = [trace.run for trace in traces]
    paths = [track.points() for run in runs for track in run.tracks.values()]
    named = zip(_LETTERS, traces, runs, strict=False)
    data: Json = {
        "runs": [
            {
                "letter": letter,
                "name": trace.name,
                **run.as_json(),
                "surroundings": run.surroundings.as_json(road_map),
            }
            for letter, trace, run in named
        ],
        "digits": DIGITS,
        "lanes": [] if road_map is None else nearby_lanes(road_map, paths),
        "crosswalks": [] if road_map is None else nearby_crosswalks(road_map, paths),
    }
    script = "\n".join((_vendored(), *(resource(name) for name in _SCRIPTS)))
    style = resource(_VENDOR_STYLE) + "\n" + resource("report.css")
    return fill(resource("report.html"), style, script, data)


def _vendored() -> str:
    """The code of uPlot under its licence; its own first line is only an address."""
    code = resource(_VENDOR_SCRIPT).partition("\n")[2]
    return f"/* uPlot\n\n{resource(_VENDOR_LICENCE)}*/\n{code}"
