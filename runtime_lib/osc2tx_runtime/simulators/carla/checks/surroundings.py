"""Lines 9 to 13 and 20 to 22: map, ground, left-overs, blueprints, lights, traffic, ROS 2."""

from __future__ import annotations

import math
import shutil
import subprocess
from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Any

from osc2tx_runtime.errors import InputError, SimulatorError
from osc2tx_runtime.opendrive import LanePosition, MapError, RoadMap
from osc2tx_runtime.simulators.carla.blueprints import blueprint_for
from osc2tx_runtime.simulators.carla.ground import FLOATS, heights_of
from osc2tx_runtime.simulators.carla.level import LOADING, difference_of, plain_name, read_level
from osc2tx_runtime.simulators.carla.sensors import SensorStacks

from .motion import CAR, spawned
from .probe import Finding, Probe, differs, line, ok, unknown

LARGE = ("Town11", "Town12", "Town13", "Town15")
"""Levels that are streamed around actors whose role name has `hero` in it."""

POINTS = 20
ROS_PATIENCE = 10.0  # s


@line(9, "map", blocks=True)
def level(probe: Probe) -> Finding:
    """The server has loaded the scenario's map."""
    probe.level = probe.client.ask("level", LOADING, patience=LOADING)
    probe.road_map = read_level(probe.level)
    request = probe.request.world
    name = probe.level["name"]
    if request.map_file is None:
        return ok(f"{name}, {len(probe.level['spawn_points'])} spawn points")
    try:
        wanted = request.road_map()
    except InputError as error:
        stem = request.map_file.rpartition("/")[2].removesuffix(".xodr")
        if stem == plain_name(name):
            return ok(f"{name}; the file is not on this machine, the server's is used")
        return differs(error.message, "--map-path FOLDER, or --carla-load if the server has it")
    difference = difference_of(wanted, probe.road_map)
    if difference is None:
        return ok(name)
    probe.is_other_map = True
    known = wanted.name in map(plain_name, probe.client.ask("maps"))
    how = "loads it" if known else "makes a level of its OpenDRIVE file"
    return differs(f"{name} instead of {wanted.name}: {difference}", f"--carla-load {how}")


@line(10, "ground", of_map=True)
def ground(probe: Probe) -> Finding:
    """The ground below the lanes is at the height of OpenDRIVE."""
    assert probe.road_map is not None
    places = list(_along_lanes(probe.road_map))
    try:
        poses = [probe.road_map.pose(place) for place in places]
    except MapError as error:
        return unknown(str(error))
    off = [abs(each) for each in heights_of(probe.client, poses) if each is not None]
    if not off:
        return unknown("no ground was found below the lanes")
    found = f"{max(off):.2f} m at most between mesh and lanes ({len(off)} points)"
    if max(off) > FLOATS:
        return differs(found, "exact actors float or sink; driven ones stand on the mesh")
    return ok(found)


def _along_lanes(road_map: RoadMap) -> Iterator[LanePosition]:
    """Yield positions on driving lanes, at equal distances over all roads."""
    stretches = [
        (road, lane, section.begin, section.end)
        for road in sorted(road_map.roads)
        for section in road_map.roads[road].sections
        for lane in [n for n, each in section.lanes.items() if each.type == "driving"][:1]
    ]
    step = sum(end - begin for *_, begin, end in stretches) / POINTS
    left = 0.5 * step
    for road, lane, begin, end in stretches:
        while left < end - begin:
            yield LanePosition(road, lane, begin + left)
            left += step
        left -= end - begin


@line(11, "size of the level", of_map=True)
def size(probe: Probe) -> Finding:
    """A streamed level needs an actor to stream it for."""
    name = plain_name(probe.level["name"])
    roles = [each.role or each.id for each in probe.request.actors]
    if any("hero" in role for role in roles):
        return ok(name)
    if name not in LARGE:
        return _asleep(probe) if probe.request.drives else ok(name)
    return differs(
        f"{name} is streamed around actors with `hero` in their role names, and there is none",
        'name the actor to stream for: keep(it.name == "hero"); others far from it are dormant',
    )


def _asleep(probe: Probe) -> Finding:
    """Whether actors far from the camera become dormant, whatever the name of the level."""
    driver = probe.driving()
    places = probe.level["spawn_points"]
    with spawned(driver, CAR, max(places, key=lambda place: math.dist(place[:2], places[0][:2]))):
        dormant = driver.ask("step", [])["dormant"]
    if dormant:
        return differs(
            "actors far from the camera are dormant",
            'name the actor to stream for: keep(it.name == "hero"), or --carla-view ACTOR',
        )
    return ok(plain_name(probe.level["name"]))


@line(12, "actors of other clients")
def left_overs(probe: Probe) -> Finding:
    """No other actor has the role names of the scenario."""
    there = probe.client.ask("situation")["actors"]
    roles = {each.role or each.id for each in probe.request.actors}
    taken = [(number, kind, role) for number, kind, role in there if role in roles]
    if not taken:
        return ok(f"{_counted(there)}, none with a role name of the scenario")
    named = ", ".join(f"{role} ({kind} {number})" for number, kind, role in taken)
    if probe.request.fixes:
        probe.client.ask("remove", [number for number, *_ in taken])
        return ok(f"removed {named}")
    double = sorted(role for role, count in Counter(r for *_, r in taken).items() if count > 1)
    takes = f"none, since {double[0]} is there twice" if double else "them"
    return differs(
        f"left by another client: {named}", f"--fix removes them; --wait-for takes {takes}"
    )


def _counted(actors: Sequence[Sequence[Any]]) -> str:
    """Return the number of actors, by the first part of their blueprints."""
    kinds = Counter(kind.partition(".")[0] for _, kind, _ in actors)
    listed = ", ".join(f"{count} {kind}" for kind, count in sorted(kinds.items()))
    return f"{len(actors)} actors{f' ({listed})' if listed else ''}"


@line(13, "blueprints", blocks=True)
def blueprints(probe: Probe) -> Finding:
    """The server has the models of the scenario."""
    library = probe.client.ask("blueprints")
    found, missing = [], []
    for spec in probe.request.actors:
        try:
            found.append(f"{spec.id}: {blueprint_for(spec, library)}")
        except SimulatorError as error:
            missing.append(error.message)
    if missing:
        return differs("; ".join(missing), "name a model that this server has")
    return ok(", ".join(found) or f"{len(library)} blueprints")


@line(20, "traffic lights", of_map=True)
def lights(probe: Probe) -> Finding:
    """The server has all lights of the map, and none is frozen."""
    assert probe.road_map is not None
    there = set(probe.client.ask("traffic_lights"))
    wanted = {signal.id for signal in probe.road_map.signals() if signal.dynamic}
    frozen = probe.client.ask("situation")["frozen"]
    if wanted - there:
        names = ", ".join(sorted(wanted - there)[:5])
        return differs(
            f"{len(wanted - there)} signals without a light: {names}",
            "states of these lights are known to the scenario alone",
        )
    if frozen:
        return differs(f"{len(frozen)} lights are frozen", "they keep their states during a run")
    return ok(f"{len(there)} lights")


@line(21, "Traffic Manager")
def manager(probe: Probe) -> Finding:
    """Its port is free: neither used by another Traffic Manager nor by another program."""
    port = probe.request.world.options.get("carla_tm_port")
    if port is None:
        return ok("takes the first free port from 8000 on")
    if probe.client.ask("is_manager_port_taken", port):
        return differs(f"port {port} is used", "--carla-tm-port takes another one for autopilot")
    return ok(f"port {port} is free")


@line(22, "ROS 2")
def ros(probe: Probe) -> Finding:
    """The topics of the sensors exist, as far as visible on this machine."""
    stacks = SensorStacks(probe.request.world.options.get("sensors", {}))
    roles = {each.id: each.role or each.id for each in probe.request.actors}
    expected = [text.split()[0] for text in stacks.table(roles) if text.startswith("/carla/")]
    program = shutil.which("ros2")
    if not expected or program is None:
        why = "no sensors are attached" if not expected else "ros2 is not installed here"
        return unknown(why, "" if not expected else "look at `ros2 topic list` during a run")
    try:
        listed = subprocess.run(
            [program, "topic", "list"], capture_output=True, text=True, timeout=ROS_PATIENCE
        ).stdout.split()
    except (OSError, subprocess.TimeoutExpired) as error:
        return unknown(f"ros2 topic list: {error}")
    missing = [topic for topic in expected if topic not in listed]
    if missing:
        return differs(f"missing: {', '.join(missing)}", "start the server with --ros2")
    return ok(f"{len(expected)} topics")
