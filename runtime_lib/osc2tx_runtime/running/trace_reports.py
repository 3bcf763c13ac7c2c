"""Pages of existing traces: one run, two overlaid runs, or all of a folder."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from osc2tx_runtime.domain.map.search import find_map
from osc2tx_runtime.errors import InputError
from osc2tx_runtime.opendrive import MapError, RoadMap, read_map
from osc2tx_runtime.report.index_page import index_row, render_index
from osc2tx_runtime.report.page import Trace, render_runs
from osc2tx_runtime.running.output_files import problem_of, write_output


class _Maps:
    """The maps of traces, each read once; a missing map is a warning.

    Args:
        folders: Folders to search, before the maps of this package.

    Attributes:
        warnings: Reasons for missing parts.
    """

    def __init__(self, folders: Sequence[Path]) -> None:
        self._folders = folders
        self._known: dict[str, RoadMap | None] = {}
        self.warnings: list[str] = []

    def of(self, trace: Trace) -> RoadMap | None:
        """Return the map of a trace."""
        name = _map_name(trace)
        if name and name not in self._known:
            self._known[name] = self._read(name)
        return self._known.get(name)

    def _read(self, name: str) -> RoadMap | None:
        try:
            return read_map(find_map(name, self._folders))
        except (InputError, MapError) as error:
            self.warnings.append(f"the page has no road map: {error}")
            return None


def trace_report(
    traces: Sequence[Path], page: Path | None, map_path: Sequence[Path]
) -> tuple[Path, list[str]]:
    """Write the page of one trace, or of two runs over each other.

    Args:
        traces: One or two files.
        page: Path of the page; default: beside the first trace.
        map_path: Folders with maps, or the map itself.

    Returns:
        The page, and its missing parts.

    Raises:
        InputError: A trace cannot be read, or the page cannot be written.
    """
    maps = _Maps(map_path)
    read = [_read_trace(path, path.stem) for path in traces]
    name = "-and-".join(path.stem for path in traces)
    target = page or traces[0].with_name(f"{name}.html")
    _write(target, render_runs(read, maps.of(read[0])))
    return target, maps.warnings


def folder_report(
    folder: Path, out: Path | None, map_path: Sequence[Path]
) -> tuple[Path, list[str]]:
    """Write a page for each trace below a folder, and an index of them.

    Args:
        folder: The folder of traces, `*.jsonl`, at any depth.
        out: Folder for the pages; default: beside the traces.
        map_path: Folders with maps, or the map itself.

    Returns:
        The index, and the missing parts of the pages.

    Raises:
        InputError: There is no trace, one cannot be read, or a page cannot be written.
    """
    maps, rows = _Maps(map_path), []
    target = out or folder
    paths = sorted(folder.rglob("*.jsonl"))
    if not paths:
        raise InputError(f"{folder} has no traces (*.jsonl)")
    for path in paths:
        place = path.relative_to(folder)
        trace = _read_trace(path, str(place.with_suffix("")))
        page = place.with_suffix(".html")
        _write(target / page, render_runs([trace], maps.of(trace)))
        rows.append(index_row(page.as_posix(), trace))
    index = target / "index.html"
    _write(index, render_index(rows))
    return index, maps.warnings


def _read_trace(path: Path, name: str) -> Trace:
    try:
        with path.open(encoding="utf-8") as lines:
            trace = Trace(lines, name)
    except (OSError, ValueError) as error:
        raise InputError(f"trace {path} cannot be read: {error}") from error
    if not trace.run.header:
        raise InputError(f"trace {path} cannot be read: no header, as `run --trace` writes it")
    return trace


def _write(page: Path, text: str) -> None:
    problem = problem_of("report", page)
    if problem is not None:
        raise InputError(problem)
    write_output("report", page, text)


def _map_name(trace: Trace) -> str:
    """The map named in the header; empty without one."""
    name = trace.run.header.get("map")
    return name if isinstance(name, str) else ""
