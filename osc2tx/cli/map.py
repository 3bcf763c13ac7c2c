"""`osc2tx map`: prints the content of a road map, its unread elements, and its errors."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import click

from osc2tx.cli.reporting import Exit
from osc2tx_runtime.opendrive import MapError, RoadMap, read_map, unread_elements
from osc2tx_shared.text import complain, say


@click.command()
@click.argument("file", metavar="FILE", type=click.Path(path_type=Path))
def map(file: Path) -> Exit:
    """Print the content of an OpenDRIVE map, its unread elements, and its errors."""
    try:
        road_map = read_map(file)
        left_out = unread_elements(file)
    except MapError as error:
        complain(f"osc2tx: error: {error}")
        return Exit.UNREADABLE
    for line in _lines(road_map, left_out):
        say(line)
    return Exit.OK


def _lines(road_map: RoadMap, left_out: tuple[tuple[str, int], ...]) -> Iterator[str]:
    yield f"{road_map.name}: {_origin(road_map)}"
    west, south, east, north = road_map.bounds()
    length = sum(road.length for road in road_map.roads.values())
    yield f"size: {east - west:.0f} m x {north - south:.0f} m, {length / 1000.0:.3f} km of roads"
    inside = sum(road.junction is not None for road in road_map.roads.values())
    kinds = Counter(junction.type for junction in road_map.junctions.values())
    yield f"roads: {len(road_map.roads)}, {inside} of them in junctions"
    yield f"junctions: {_counts(kinds)}"
    yield f"lanes: {_counts(_lane_types(road_map))}"
    lights = sum(signal.dynamic for signal in road_map.signals())
    yield (
        f"signals: {lights} traffic lights with {len(road_map.controllers())} controllers,"
        f" {len(road_map.signals()) - lights} others"
    )
    yield f"crosswalks: {len(road_map.crosswalks())}"
    globe, (x, y, turn) = road_map.geo_reference.text, road_map.geo_reference.offset
    moved = f", moved by ({x:g}, {y:g}) m, {turn:g} rad" if x or y or turn else ""
    yield f"globe: {globe or 'no geoReference'}{moved}"
    yield from _list("not read", [f"{tag}: {number}" for tag, number in left_out])
    yield from _list("remarks", road_map.remarks)
    yield from _list("seams above 0.01 m or 1°", [str(seam) for seam in road_map.seams()])


def _origin(road_map: RoadMap) -> str:
    header = road_map.header
    version = f"OpenDRIVE {header.get('revMajor', '?')}.{header.get('revMinor', '?')}"
    given = [header[key] for key in ("name", "vendor", "date", "version") if header.get(key)]
    return ", ".join([version, *given])


def _lane_types(road_map: RoadMap) -> Counter[str]:
    """Lanes by type, in each section anew."""
    return Counter(
        lane.type
        for road in road_map.roads.values()
        for section in road.sections
        for lane in section.lanes.values()
    )


def _counts(found: Counter[str]) -> str:
    return ", ".join(f"{number} {name}" for name, number in sorted(found.items())) or "none"


def _list(title: str, lines: tuple[str, ...] | list[str]) -> Iterator[str]:
    yield f"{title}: {'' if lines else 'none'}".rstrip()
    for line in lines:
        yield f"  {line}"
