"""Puts the data, the style and the scripts into one HTML file."""

from __future__ import annotations

import base64
import hashlib
import json
from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path
from string import Template
from typing import Protocol

from .json_values import Json
from .nearby_lanes import OutlineSource, nearby_crosswalks, nearby_lanes
from .surroundings import SignalSource
from .trace_reader import read_run

__all__ = ["render_report", "write_report"]

_SCRIPTS = (
    "core.js",
    "roads.js",
    "surroundings.js",
    "camera.js",
    "labels.js",
    "view.js",
    "charts.js",
    "timeline.js",
    "report.js",
)


class MapSource(OutlineSource, SignalSource, Protocol):
    """The part of `osc2tx_runtime.opendrive.RoadMap` that is drawn."""


def write_report(path: Path, trace_lines: Sequence[str], road_map: MapSource | None = None) -> None:
    """Write the report of one run.

    Args:
        path: The HTML file to write; its folder must exist.
        trace_lines: The lines of the trace. Broken and unknown lines are counted on the page.
        road_map: The map to draw under the paths (a `RoadMap`), None to leave it out.
    """
    page = render_report(trace_lines, road_map)
    path.write_text(page, encoding="utf-8", newline="\n")


def render_report(trace_lines: Sequence[str], road_map: MapSource | None = None) -> str:
    """The page as text; the same arguments give the same text."""
    run = read_run(trace_lines)
    data = run.as_json()
    paths = [track.points() for track in run.tracks.values()]
    data["surroundings"] = run.surroundings.as_json(road_map)
    data["lanes"] = [] if road_map is None else nearby_lanes(road_map, paths)
    data["crosswalks"] = [] if road_map is None else nearby_crosswalks(road_map, paths)
    script = "\n".join(_resource(name) for name in _SCRIPTS)
    style = _resource("report.css")
    return Template(_resource("report.html")).substitute(
        style=style,
        script=script,
        style_hash=_csp_hash(style),
        script_hash=_csp_hash(script),
        data=_embed(data),
    )


def _resource(name: str) -> str:
    return files(__package__).joinpath(name).read_text(encoding="utf-8")


def _csp_hash(content: str) -> str:
    """The browser runs only the script with this hash: nothing a trace could smuggle in."""
    digest = hashlib.sha256(content.encode("utf-8")).digest()
    return "sha256-" + base64.b64encode(digest).decode("ascii")


def _embed(data: Json) -> str:
    r"""JSON that cannot end its script block.

    ASCII output writes U+2028 and U+2029 (and lone surrogates) as \u escapes already.
    """
    encoded = json.dumps(data, separators=(",", ":"), ensure_ascii=True, allow_nan=False)
    for character in "<>&":
        encoded = encoded.replace(character, f"\\u{ord(character):04x}")
    return encoded
