"""The map of the server: it has to be that of the scenario, or is loaded on request."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from osc2tx_runtime.errors import InputError, SimulatorError
from osc2tx_runtime.opendrive import LanePosition, MapError, RoadMap, read_map_text
from osc2tx_runtime.worlds import WorldRequest
from osc2tx_shared.text import complain

from .client_process import ClientProcess
from .frames import pose_from

LOADING = 120.0
"""Time limit (s) of loading a level; that of a call, if longer."""

OPT = "_Opt"
"""Ending of the names of levels whose layers can be switched."""

SAME_PLACE = 0.05  # m
SAME_LENGTH = 0.01  # m
ON_LANE = 2.0  # m between a spawn point and the lane it is on
ROUNDED = 2  # decimals of metres along the road: the wire has single precision


def map_of(client: ClientProcess, request: WorldRequest) -> RoadMap:
    """Return the map of a run: that of scenario and server, with its spawn points.

    Args:
        client: A connected session.
        request: Request of the run, with `carla_load` if the server has to load it.

    Raises:
        SimulatorError: The server has another map.
    """
    load = request.options.get("carla_load", False)
    level = _level(client, _patience(request))
    theirs, wanted = read_level(level), _wanted(client, request, level, load)
    if (
        wanted is None
        and request.map_file is not None
        and _stem(request) != plain_name(level["name"])
    ):
        level = _loaded(client, request, _stem(request), load=True)
        return with_spawn_points(read_level(level), level)
    difference = None if wanted is None else difference_of(wanted, theirs)
    if wanted is None or difference is None:
        if request.options.get("carla_reload", False):
            _reload(client, theirs.name, _patience(request))
        return with_spawn_points(wanted or theirs, level)
    if not load:
        raise SimulatorError(
            f"CARLA has the map {theirs.name}, which is not the scenario's {wanted.name}:"
            f" {difference}; load it there, or run with --carla-load"
        )
    level = _loaded(client, request, wanted.name, load=wanted.name != plain_name(theirs.name))
    difference = difference_of(wanted, read_level(level))
    if difference is not None:
        raise SimulatorError(f"the map {wanted.name} of CARLA is not the scenario's: {difference}")
    return with_spawn_points(wanted, level)


def _loaded(
    client: ClientProcess, request: WorldRequest, name: str, *, load: bool
) -> Mapping[str, Any]:
    """Make the server load the map, or create a level of the file; return the level."""
    patience = _patience(request)
    known = {plain_name(each): each for each in client.ask("maps")} if load else {}
    keep = request.options.get("carla_keep", False)
    complain(f"CARLA: loading {name}")
    if not keep:
        client.patience_at_end = patience
    with _in_time(f"loaded {name}", patience):
        if name in known:
            client.ask("load", known[name], patience, keep, patience=2.0 * patience)
        else:
            text = request.find_map().read_text(encoding="utf-8")
            client.ask("generate", text, patience, keep, patience=2.0 * patience)
    return _level(client, patience)


def _reload(client: ClientProcess, name: str, patience: float) -> None:
    """Make the server reload its level, with initial lights, weather and actors."""
    complain(f"CARLA: reloading {name}")
    with _in_time(f"loaded {name}", patience):
        client.ask("reload", patience, patience=2.0 * patience)


def _patience(request: WorldRequest) -> float:
    return max(LOADING, float(request.options.get("carla_timeout", 0.0)))


def _level(client: ClientProcess, patience: float) -> Mapping[str, Any]:
    """Return the level of the server, whose map may be large."""
    with _in_time("sent its map", patience):
        level: Mapping[str, Any] = client.ask("level", patience, patience=2.0 * patience)
    return level


@contextmanager
def _in_time(done: str, patience: float) -> Iterator[None]:
    """Report the remedy if a time limit (s) is exceeded."""
    try:
        yield
    except SimulatorError as error:
        if "time-out" not in error.message and "failed to connect" not in error.message:
            raise
        raise SimulatorError(
            f"CARLA has not {done} within {patience:g} s: --carla-timeout allows longer"
        ) from None


def _wanted(
    client: ClientProcess, request: WorldRequest, level: Mapping[str, Any], load: bool
) -> RoadMap | None:
    """Return the scenario's map; None if it leaves the map open, or if only the server has it.

    Raises:
        InputError: There is no such map, neither here nor on the server.
    """
    if request.map_file is None:
        return None
    try:
        return request.road_map()
    except InputError:
        stem = _stem(request)
        if stem == plain_name(level["name"]) or (
            load and stem in map(plain_name, client.ask("maps"))
        ):
            return None
        raise


def _stem(request: WorldRequest) -> str:
    assert request.map_file is not None
    return request.map_file.rpartition("/")[2].removesuffix(".xodr")


def plain_name(name: str) -> str:
    """Return the name of a level without the marks of variants."""
    return name.removesuffix(OPT)


def read_level(level: Mapping[str, Any]) -> RoadMap:
    """Return the map of a level.

    Raises:
        SimulatorError: It cannot be read.
    """
    try:
        return read_map_text(level["text"], level["name"])
    except MapError as error:
        raise SimulatorError(f"the map of CARLA cannot be read: {error}") from error


def difference_of(ours: RoadMap, theirs: RoadMap) -> str | None:
    """Return the relevant difference of two maps; None without one."""
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
