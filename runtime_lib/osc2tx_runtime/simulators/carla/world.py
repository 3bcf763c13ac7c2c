"""The world `carla`: how it is made for a run."""

from __future__ import annotations

from osc2tx_runtime.errors import SettingsError, SimulatorError
from osc2tx_runtime.world.embedded import EmbeddedWorld
from osc2tx_runtime.worlds import WorldRequest, WorldType

from .client_process import ClientProcess
from .level import map_of
from .options import DEFAULT_ADDRESS, OPTIONS, TIMEOUT
from .plant import CarlaPlant
from .sensors import SensorStacks

__all__ = ["WORLD"]


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
