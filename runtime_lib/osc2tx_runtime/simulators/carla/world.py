"""The world `carla`: its creation for a run."""

from __future__ import annotations

import math
from pathlib import Path

from osc2tx_runtime.errors import SettingsError
from osc2tx_runtime.plain_numbers import to_float, to_int
from osc2tx_runtime.world.embedded import EmbeddedWorld
from osc2tx_runtime.worlds import Option, WorldRequest, WorldType
from osc2tx_runtime.worlds.world_type import parse_pair, parse_seconds

from .attendance import Attendance
from .checks import check
from .client_process import ClientProcess
from .connection import DEFAULT_ADDRESS, TIMEOUT, connect
from .gains import Gains
from .level import map_of
from .plant import CarlaPlant
from .sensors import SensorStacks

PATIENCE = 60.0
"""Time (s) to wait for an actor of another client."""


def parse_address(text: str) -> tuple[str, int]:
    """Read `localhost:2000`, `localhost` or `:2000`."""
    host, _, port = text.strip().partition(":")
    try:
        number = to_int(port) if port else DEFAULT_ADDRESS[1]
        if not 0 < number < 65536:
            raise ValueError("no port")
        return host or DEFAULT_ADDRESS[0], number
    except ValueError:
        raise SettingsError(
            f"--carla {text}: write HOST:PORT, as in --carla localhost:2000"
        ) from None


def parse_port(text: str) -> int:
    """Read the number of a port."""
    try:
        number = to_int(text)
    except ValueError:
        number = 0
    if not 0 < number < 65536:
        raise SettingsError(f"--carla-tm-port {text}: write a port from 1 to 65535")
    return number


def parse_factor(text: str) -> float:
    """Read the factor of real time of a run."""
    try:
        factor = to_float(text)
    except ValueError:
        factor = 0.0
    if not 0.0 < factor < math.inf:
        raise SettingsError(f"--realtime {text}: write a number above 0, as in --realtime 1")
    return factor


def parse_wait(text: str) -> tuple[str, float]:
    """Read `hero` or `hero=60s`."""
    actor, equals, patience = text.strip().partition("=")
    if not equals:
        return actor, PATIENCE
    return actor, parse_seconds(patience, "--wait-for hero=60s")


def parse_sensors(text: str) -> tuple[str, Path]:
    """Read `hero=stack.json`."""
    actor, file = parse_pair(text, "--sensors", "ACTOR=FILE", "hero=stack.json")
    return actor, Path(file)


def parse_gain(text: str) -> tuple[str, float]:
    """Read `throttle=0.25`."""
    name, value = parse_pair(text, "--carla-gains", "NAME=NUMBER", "throttle=0.25")
    if name not in Gains._fields:
        raise SettingsError(f"--carla-gains {text}: write one of {', '.join(Gains._fields)}")
    try:
        gain = to_float(value)
    except ValueError:
        gain = 0.0
    if not 0.0 < gain < math.inf:
        raise SettingsError(f"--carla-gains {text}: write a number above 0")
    return name, gain


OPTIONS: tuple[Option, ...] = (
    Option("carla", "HOST:PORT", "where the server is", parse_address, default="localhost:2000"),
    Option.flag("carla-load", "load the scenario's map if the server has another one"),
    Option.flag("carla-keep", "leave the map there that --carla-load has loaded"),
    Option.flag("carla-reload", "reload the level, even if it is already the right one"),
    Option(
        "carla-timeout",
        "SECONDS",
        "how long the server may take to answer",
        lambda text: parse_seconds(text, "--carla-timeout 10"),
        default=TIMEOUT,
    ),
    Option(
        "wait-for",
        "ACTOR[=SECONDS]",
        "take over this actor from another client, and keep it at the end",
        parse_wait,
        dict,
    ),
    Option("sensors", "ACTOR=FILE", "sensors to attach to an actor (JSON)", parse_sensors, dict),
    Option.flag("no-tick", "another client ticks the world"),
    Option.flag("carla-reset", "end a synchronous mode that a client has left behind"),
    Option("carla-view", "ACTOR", "have the camera of the server's window follow an actor", str),
    Option(
        "wait-control",
        "SECONDS",
        "hold the scenario until its external actors are controlled, for at most this time",
        lambda text: parse_seconds(text, "--wait-control 30s"),
    ),
    Option(
        "realtime",
        "FACTOR",
        "make no step before its time: 1 is real time, 2 twice as fast",
        parse_factor,
    ),
    Option(
        "carla-gains",
        "NAME=NUMBER",
        "a gain of the controllers of all driven vehicles, as `osc2tx world check` proposes it",
        parse_gain,
        dict,
    ),
    Option(
        "carla-tm-port",
        "PORT",
        "port of the Traffic Manager (the first free one from 8000 on)",
        parse_port,
    ),
)


def make(request: WorldRequest) -> EmbeddedWorld:
    """Create the world of a run, connected to the server.

    Raises:
        SimulatorError: There is no usable server.
    """
    options = request.options
    sensors = SensorStacks(options.get("sensors", {}))
    ticks = not options.get("no_tick", False)
    client = ClientProcess(options.get("carla_timeout", TIMEOUT))
    try:
        version = connect(client, request, ticks=ticks)
        road_map = map_of(client, request)
        plant = CarlaPlant(
            client,
            version,
            request.control,
            options.get("wait_for", {}),
            sensors,
            ticks=ticks,
            dt=request.dt,
            seed=request.seed,
            manager_port=options.get("carla_tm_port"),
            gains=options.get("carla_gains", {}),
            attendance=Attendance(
                options.get("wait_control"), options.get("realtime"), options.get("carla_view")
            ),
        )
    except BaseException:
        client.close()
        raise
    return EmbeddedWorld(road_map, request.dt, plant=plant)


WORLD = WorldType(
    "carla", make, ("exact", "exact-physics", "driven", "external", "autopilot"), OPTIONS, check
)
