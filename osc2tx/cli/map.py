"""`osc2tx map`: prints the content of a road map, its unread elements, and its errors."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import click

from osc2tx.cli.reporting import Exit
from osc2tx.config import ConfigFiles
from osc2tx_runtime.domain.map.search import find_map
from osc2tx_runtime.errors import InputError
from osc2tx_runtime.opendrive import MapError, RoadMap, read_map, unread_elements
from osc2tx_runtime.opendrive.model import LaneSection
from osc2tx_shared.map_files import map_names
from osc2tx_shared.text import complain, say


@click.command()
@click.argument("file", metavar="[FILE]", required=False, type=click.Path(path_type=Path))
@click.option(
    "--map-path", type=Path, multiple=True, metavar="PATH", help="Folder with maps, or the map."
)
def map(file: Path | None, map_path: tuple[Path, ...]) -> Exit:
    """Print the content of an OpenDRIVE map, its unread elements, and its errors.

    FILE is a file, or a name as in scenarios (`highway.xodr`), which is searched in the folders
    with maps and among the maps of osc2tx. Without it, these maps are listed.
    """
    folders = (*map_path, *_folders_of_project())
    if file is None:
        for name in map_names([folder for folder in folders if folder.is_dir()]):
            say(name)
        return Exit.OK
    try:
        found = file if file.exists() else find_map(str(file), folders)
        road_map = read_map(found)
        left_out = unread_elements(found)
    except (InputError, MapError) as error:
        complain(f"osc2tx: error: {error}")
        return Exit.UNREADABLE
    for line in _lines(road_map, left_out):
        say(line)
    return Exit.OK


def _folders_of_project() -> tuple[Path, ...]:
    config = ConfigFiles().for_folder(Path.cwd())
    return tuple(Path(folder) for folder in config.map_paths)


def _lines(road_map: RoadMap, left_out: tuple[tuple[str, int], ...]) -> Iterator[str]:
    yield f"{road_map.name}: {_origin(road_map)}"
    west, south, east, north = road_map.bounds()
    length = sum(road.length for road in road_map.roads.values())
    yield f"size: {east - west:.0f} m x {north - south:.0f} m, {length / 1000.0:.3f} km of roads"
    inside = sum(road.junction is not None for road in road_map.roads.values())
    kinds = Counter(junction.type for junction in road_map.junctions.values())
    yield f"roads: {len(road_map.roads)}, {inside} of them in junctions"
    yield from _roads(road_map)
    yield f"junctions: {_counts(kinds)}"
    yield f"lanes: {_counts(_lane_types(road_map))}"
    lights = sum(signal.dynamic for signal in road_map.signals())
    yield (
        f"signals: {lights} traffic lights with {len(road_map.controllers())} controllers,"
        f" {len(road_map.signals()) - lights} others"
    )
    yield from _lights(road_map)
    yield f"crosswalks: {len(road_map.crosswalks())}"
    globe, (x, y, turn) = road_map.geo_reference.text, road_map.geo_reference.offset
    moved = f", moved by ({x:g}, {y:g}) m, {turn:g} rad" if x or y or turn else ""
    yield f"globe: {globe or 'no geoReference'}{moved}"
    yield from _list("not read", [f"{tag}: {number}" for tag, number in left_out])
    yield from _list("remarks", road_map.remarks)
    yield from _list("seams above 0.01 m or 1°", [str(seam) for seam in road_map.seams()])


def _roads(road_map: RoadMap) -> Iterator[str]:
    """Describe the roads outside of junctions, with their lanes as `lane(1)`, … count them."""
    for road in road_map.roads.values():
        if road.junction is not None:
            continue
        name = f" {road.name}" if road.name else ""
        yield f"  road {road.id}{name}: {road.length:.1f} m"
        said: tuple[str, ...] = ()
        for section in road.sections:
            lanes = tuple(
                f"{way} s: {', '.join(_from_right(road_map, road.id, section, direction))}"
                for way, direction in (("along", 1), ("against", -1))
            )
            if lanes != said:
                start = f"from s = {section.begin:.1f} m " if section.begin else ""
                yield from (f"    {start}{each}" for each in lanes if not each.endswith(": "))
            said = lanes


def _from_right(
    road_map: RoadMap, road: str, section: LaneSection, direction: int
) -> Iterator[str]:
    """Yield the lanes of one direction from the right, each with the number of `lane`."""
    like = next((lane.id for lane in section.lanes.values() if lane.direction == direction), None)
    if like is None:
        return
    s = 0.5 * (section.begin + section.end)
    for number, lane in enumerate(road_map.lanes(road, s, like=like), start=1):
        yield f"lane({number}) is {lane}"


def _lights(road_map: RoadMap) -> Iterator[str]:
    groups = {signal: each.id for each in road_map.controllers() for signal in each.signals}
    for signal in road_map.signals():
        if signal.dynamic:
            group = f", controller {groups[signal.id]}" if signal.id in groups else ""
            yield f"  traffic light {signal.id}: road {signal.road}, s = {signal.s:.1f} m{group}"


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
