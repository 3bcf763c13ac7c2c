"""Maps that scenarios name: are they there?"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from osc2tx.diagnostics.suggestions import did_you_mean
from osc2tx_shared.map_files import map_names, map_places, places_in_project

if TYPE_CHECKING:
    from osc2tx import ir
    from osc2tx.diagnostics import DiagnosticSink, Span


class NamedMap(NamedTuple):
    """A map that a scenario names, and where."""

    name: str
    span: Span


def report_missing_maps(
    module: ir.Module, folders: Sequence[Path], sink: DiagnosticSink
) -> list[Path]:
    """Report maps that no folder has.

    Args:
        module: The scenarios.
        folders: The folder of the file; folders with maps, or the map itself.
        sink: Takes OSC443.

    Returns:
        The searched paths of maps in the project, so that a change is noticed.
    """
    looked_for: list[Path] = []
    reported: set[str] = set()
    for named in (each for scenario in module.scenarios for each in named_maps(scenario)):
        if named.name in reported:
            continue
        reported.add(named.name)
        looked_for += places_in_project(named.name, folders)
        try:
            is_found = any(place.is_file() for place in map_places(named.name, folders))
        except (OSError, ValueError):  # a name that no file can have
            is_found = False
        if is_found:
            continue
        given = [f"`{folder}`" for folder in folders[1:]]
        searched = ", ".join(["the folder of the file", *given, "the maps of the runtime"])
        sink.report(
            "OSC443",
            named.span,
            f"there is no map `{named.name:.80}`",
            notes=[f"searched in {searched}"],
            help=did_you_mean(named.name, map_names([f for f in folders if f.is_dir()]))
            or "give the folder of the map with `--map-path`, or `map-path` in the settings file",
        )
    return looked_for


def named_maps(scenario: ir.Scenario) -> Iterator[NamedMap]:
    """Yield the maps that a scenario names by `map_file` or `set_map_file`."""
    from osc2tx import ir

    for declaration in scenario.declarations:
        if isinstance(declaration, ir.Actor) and "map" in declaration.lineage:
            for value in declaration.values:
                if value.path == ("map_file",):
                    yield from _text(value.value)
    for placement in scenario.placements:
        for call in placement.modifiers:
            if call.name == "set_map_file":
                yield from _text(call.arguments[0].value)


def named_control_files(scenario: ir.Scenario) -> Iterator[str]:
    """Yield the files with cycles of traffic lights that a scenario names."""
    for placement in scenario.placements:
        for call in placement.modifiers:
            if call.name == "set_traffic_lights_control_file":
                yield from (each.name for each in _text(call.arguments[0].value))


def _text(value: ir.Expression) -> Iterator[NamedMap]:
    from osc2tx import ir

    if isinstance(value, ir.Literal) and isinstance(value.value, str):
        yield NamedMap(value.value, value.span)
