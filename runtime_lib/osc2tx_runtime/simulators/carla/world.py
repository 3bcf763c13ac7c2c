"""The world `carla`: how it is made for a run."""

from __future__ import annotations

from pathlib import Path

from osc2tx_runtime.errors import SettingsError, SimulatorError
from osc2tx_runtime.plain_numbers import to_int
from osc2tx_runtime.world.embedded import EmbeddedWorld
from osc2tx_runtime.worlds import Option, WorldRequest, WorldType
from osc2tx_runtime.worlds.option import parse_pair, parse_seconds

from .client_process import ClientProcess
from .level import map_of
from .plant import CarlaPlant
from .sensors import SensorStacks

__all__ = ["DEFAULT_ADDRESS", "OPTIONS", "PATIENCE", "TIMEOUT", "WORLD"]

DEFAULT_ADDRESS = ("127.0.0.1", 2000)
TIMEOUT = 10.0
"""How long (s) the server may take for a call."""

PATIENCE = 60.0
"""How long (s) to wait for an actor that somebody else spawns."""


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


OPTIONS: tuple[Option, ...] = (
    Option("carla", "HOST:PORT", "where the server is", parse_address, default="localhost:2000"),
    Option.flag("carla-load", "load the scenario's map if the server has another one"),
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
        "take this actor from whom spawns it, and leave it in the end",
        parse_wait,
        dict,
    ),
    Option("sensors", "ACTOR=FILE", "sensors to attach to an actor (JSON)", parse_sensors, dict),
    Option.flag("no-tick", "another client makes the steps"),
)


def make(request: WorldRequest) -> EmbeddedWorld:
    """Make the world of a run, connected to the server.

    Raises:
        SimulatorError: There is no server, or none that this run can use.
    """
    options = request.options
    sensors = SensorStacks(options.get("sensors", {}))
    ticks = not options.get("no_tick", False)
    client = ClientProcess(options.get("carla_timeout", TIMEOUT))
    try:
        version = connect(client, request, ticks)
        road_map = map_of(client, request, options.get("carla_load", False))
        plant = CarlaPlant(
            client,
            version,
            request.control,
            options.get("wait_for", {}),
            sensors,
            ticks=ticks,
            dt=request.dt,
            seed=request.seed,
        )
    except BaseException:
        client.close()
        raise
    return EmbeddedWorld(road_map, request.dt, plant=plant)


def connect(client: ClientProcess, request: WorldRequest, ticks: bool) -> str:
    """Connect to the server; return its version.

    Raises:
        SimulatorError: It is not there, of another version, or its time is somebody else's.
        SettingsError: The steps of this run are not those of the simulator.
    """
    host, port = request.options.get("carla", DEFAULT_ADDRESS)
    timeout = request.options.get("carla_timeout", TIMEOUT)
    try:
        found = client.ask("connect", host, port, timeout)
    except SimulatorError as error:
        if "time-out" not in error.message:
            raise
        raise SimulatorError(
            f"there is no CARLA server at {host}:{port} (waited {timeout:g} s): start CarlaUE4, or"
            " say where it is with --carla HOST:PORT"
        ) from None
    server, library = found["server"], found["client"]
    if server != library:
        raise SimulatorError(
            f"the server is CARLA {server} and the client library {library}: they have to be equal"
            f" (pip install carla=={server})"
        )
    if ticks and found["synchronous"]:
        raise SimulatorError(
            "CARLA is in synchronous mode already: another client makes its steps. End that one,"
            " or leave the steps to it with --no-tick"
        )
    if not ticks and found["synchronous"] and abs(found["dt"] - request.dt) > 1e-9:
        theirs = f"{found['dt']:g}"
        raise SettingsError(f"the steps of CARLA are {theirs} s long: run with --dt {theirs}")
    return str(server)


WORLD = WorldType("carla", make, ("exact", "driven", "external", "autopilot"), OPTIONS)
