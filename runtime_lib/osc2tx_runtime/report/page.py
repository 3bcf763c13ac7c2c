"""The page of one run, or of two overlaid runs."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from .html import page, resource, resources
from .json_values import Json
from .nearby_lanes import nearby_crosswalks, nearby_lanes
from .trace_reader import read_run
from .tracks import DIGITS

if TYPE_CHECKING:
    from osc2tx_runtime.opendrive import RoadMap


def render_campaign(data: Json) -> str:
    """Return the page as text; equal data give equal text.

    Args:
        data: A summary, coverage, and columns of rows, as `osc2tx campaign report` collects them.
    """
    style = resources("report.css", "campaign.css")
    script = resources("base.js", "campaign.js", "parallel.js")
    purpose = "This page shows its campaign"
    return page("campaign.html", "Campaign", purpose, style, script, data)


def render_project(data: Json) -> str:
    """Return the page of a project as text; equal data give equal text.

    Args:
        data: Verdicts of scenarios, XML by reason, and campaigns, as `osc2tx test --page` and
            `osc2tx campaign report` of several stores collect them.
    """
    style, script = resource("report.css"), resources("base.js", "project.js")
    return page("project.html", "Project", "This page shows its project", style, script, data)


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


def render_report(trace_lines: Iterable[str], road_map: RoadMap | None = None) -> str:
    """The page of one run as text; equal arguments give equal text.

    Args:
        trace_lines: The lines of the trace. Broken and unknown lines are counted on the page.
        road_map: The map to draw under the paths; None: no map.
    """
    return render_runs([Trace(trace_lines)], road_map)


def render_runs(traces: Sequence[Trace], road_map: RoadMap | None = None) -> str:
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
    style = resources("vendor/uplot.css", "report.css")
    script = f"{_vendored()}\n{resources(*_SCRIPTS)}"
    purpose = "This report draws its views"
    return page("report.html", "Run report", purpose, style, script, data)


def _vendored() -> str:
    """The code of uPlot under its licence; its own first line is only an address."""
    code = resource("vendor/uplot.js").partition("\n")[2]
    return f"/* uPlot\n\n{resource('vendor/LICENSE')}*/\n{code}"
