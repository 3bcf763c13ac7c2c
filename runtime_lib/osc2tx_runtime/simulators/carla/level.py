"""The map of the server: it has to be the scenario's, or is loaded if that is asked for."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from osc2tx_runtime.errors import InputError, SimulatorError
from osc2tx_runtime.opendrive import LanePosition, MapError, RoadMap, read_map_text
from osc2tx_runtime.worlds import WorldRequest

from .client_process import ClientProcess
from .frames import pose_from

__all__ = ["map_of", "with_spawn_points"]

LOADING = 120.0
"""How long (s) a server may take to load a level."""

SAME_PLACE = 0.05  # m
SAME_LENGTH = 0.01  # m
ON_LANE = 2.0  # m between a spawn point and the lane it is on
ROUNDED = 2  # decimals of metres along the road: the wire has single precision


def map_of(client: ClientProcess, request: WorldRequest, load: bool) -> RoadMap:
    """Return the map of a run: the scenario's, which is the server's, with its spawn points.

    Args:
        client: A connected one.
        request: Of the run.
        load: Load it if the server has another one.

    Raises:
        SimulatorError: The server has another map.
    """
    level = client.ask("level")
    theirs, wanted = _read(level), _wanted(request, level)
    difference = None if wanted is None else _difference(wanted, theirs)
    if wanted is None or difference is None:
        return with_spawn_points(wanted or theirs, level)
    if not load:
        raise SimulatorError(
            f"CARLA has the map {theirs.name}, which is not the scenario's {wanted.name}:"
            f" {difference}; load it there, or run with --carla-load"
        )
    if wanted.name in client.ask("maps") and wanted.name != theirs.name:
        client.ask("load", wanted.name, patience=LOADING)
    else:
        text = request.find_map().read_text(encoding="utf-8")
        client.ask("generate", text, patience=LOADING)
    level = client.ask("level")
    difference = _difference(wanted, _read(level))
    if difference is not None:
        raise SimulatorError(f"the map {wanted.name} of CARLA is not the scenario's: {difference}")
    return with_spawn_points(wanted, level)


def _wanted(request: WorldRequest, level: Mapping[str, Any]) -> RoadMap | None:
    """The scenario's map; None where it leaves that open, or only the server has it."""
    if request.map_file is None:
        return None
    try:
        return request.road_map()
    except InputError:
        stem = request.map_file.rpartition("/")[2].removesuffix(".xodr")
        if stem == level["name"]:
            return None
        raise


def _read(level: Mapping[str, Any]) -> RoadMap:
    try:
        return read_map_text(level["text"], level["name"])
    except MapError as error:
        raise SimulatorError(f"the map of CARLA cannot be read: {error}") from error


def _difference(ours: RoadMap, theirs: RoadMap) -> str | None:
    """What tells two maps apart; None if nothing does that matters."""
    for road in (*ours.roads, *theirs.roads):
        if (road in ours.roads) != (road in theirs.roads):
            where = "the scenario's" if road in ours.roads else "the server's"
            return f"only {where} has a road {road}"
    for road, mine in ours.roads.items():
        if abs(mine.length - theirs.roads[road].length) > SAME_LENGTH:
            return f"road {road} has another length"
        for place in _samples(ours, road):
            try:
                one, other = ours.pose(place), theirs.pose(place)
            except MapError:
                return f"lane {place.lane} of road {road} is missing"
            if math.hypot(one.x - other.x, one.y - other.y) > SAME_PLACE:
                return f"lane {place.lane} of road {road} is elsewhere"
    return None


def _samples(road_map: RoadMap, road: str) -> Iterator[LanePosition]:
    """The middle of each lane of a road."""
    for section in road_map.roads[road].sections:
        for lane in section.lanes:
            if lane:
                yield LanePosition(road, lane, 0.5 * (section.begin + section.end))


def with_spawn_points(road_map: RoadMap, level: Mapping[str, Any]) -> RoadMap:
    """Return the map with the spawn points of the level that are on driving lanes, in its order."""
    found: dict[LanePosition, None] = {}
    for transform in level["spawn_points"]:
        pose = pose_from(transform)
        on = road_map.locate(pose.x, pose.y, pose.z, pose.h, max_distance=ON_LANE)
        if on is not None:
            found[LanePosition(on.road, on.lane, round(on.s, ROUNDED))] = None
    return road_map.with_spawn_points(tuple(found)) if found else road_map
