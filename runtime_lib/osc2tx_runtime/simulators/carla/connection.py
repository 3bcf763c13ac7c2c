"""The first contact with a server: each obstacle to a run is reported with its remedy."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from osc2tx_runtime.errors import SettingsError, SimulatorError
from osc2tx_runtime.worlds import WorldRequest
from osc2tx_shared.text import complain

from .client import release_of
from .client_process import ClientProcess

DEFAULT_ADDRESS = ("127.0.0.1", 2000)
TIMEOUT = 10.0
"""Time limit (s) of a call to the server."""

REPAIRING = 120.0
"""Time limit (s) of undoing the changes of killed runs, which may include loading a level."""

LOOKING = 6.0
"""Additional time (s) for checking ports and steps of other clients."""


def connect(client: ClientProcess, request: WorldRequest, *, ticks: bool) -> str:
    """Connect to the server; return its version.

    Args:
        client: The process of the client library.
        request: Of the run.
        ticks: Whether this run makes the steps of the simulator.

    Raises:
        SimulatorError: It is missing, of another version, or another client controls its time.
        SettingsError: The step size of this run differs from the simulator's.
    """
    address = request.options.get("carla", DEFAULT_ADDRESS)
    timeout = request.options.get("carla_timeout", TIMEOUT)
    where = ":".join(map(str, address))
    try:
        found = client.ask("connect", *address, timeout, patience=LOOKING)
    except SimulatorError as error:
        if "time-out" not in error.message:
            raise
        raise SimulatorError(
            f"{where} takes connections, and no CARLA server responds within {timeout:g} s: the"
            " server is still starting (--carla-timeout allows longer), or another program"
            " listens there"
        ) from None
    if not found["listens"]:
        raise SimulatorError(
            f"there is no CARLA server at {where}: start CarlaUE4.sh (in a container: publish the"
            " ports 2000 and 2001), or name it with --carla HOST:PORT"
        )
    _check_versions(found["server"], found["client"])
    if found.get("left"):
        client.ask("repair", patience=REPAIRING)
        complain(f"CARLA: restored what an interrupted run had changed: {', '.join(found['left'])}")
        found = client.ask("connect", *address, timeout, patience=LOOKING)
    if not found["streams"]:
        raise SimulatorError(_without_streams(found, *address))
    if found["synchronous"] and ticks and not found["ticks"]:
        _take_over(client, request)
    elif found["synchronous"] != (not ticks):
        raise _wrong_time(found["synchronous"])
    elif not ticks and abs(found["dt"] - request.dt) > 1e-9:
        theirs = f"{found['dt']:g}"
        raise SettingsError(f"the steps of CARLA are {theirs} s long: run with --dt {theirs}")
    return str(found["server"])


def _check_versions(server: str, library: str) -> None:
    """Compare the releases; source builds have a suffix, with unknown effect."""
    if release_of(server) != release_of(library):
        raise SimulatorError(
            f"the server is CARLA {server} and the client library {library}: they have to be of"
            f" one release. osc2tx is tested with 0.9.16; another client library for this server:"
            f" pip install carla=={release_of(server)}"
        )
    if server != library:
        complain(f"CARLA: the server calls itself {server}, the client library {library}")


def _without_streams(found: Mapping[str, Any], host: str, port: int) -> str:
    """Return why snapshots may be missing although calls are answered."""
    reason = (
        "the level may still be loading (--carla-timeout allows longer)"
        if found["stream_port"]
        else f"nothing responds at {host}:{port + 1}, where they come from: open or publish that"
        " port as well"
    )
    return f"CARLA {found['server']} at {host}:{port} responds, but sends no snapshots: {reason}"


def _take_over(client: ClientProcess, request: WorldRequest) -> None:
    """End a synchronous mode without steps, if requested."""
    if not request.options.get("carla_reset", False):
        raise SimulatorError(
            "CARLA is in synchronous mode, and no client ticks it: one that ended left it"
            " so. --carla-reset ends that mode"
        )
    client.ask("free_time")
    complain("CARLA: ended a synchronous mode that a client had left behind")


def _wrong_time(synchronous: bool) -> SimulatorError:
    """Return why the steps cannot be made as this run requires."""
    if synchronous:
        return SimulatorError(
            "CARLA is in synchronous mode already: another client ticks it. End that one,"
            " or leave the ticks to it with --no-tick"
        )
    return SimulatorError(
        "--no-tick leaves the steps to another client, and CARLA is not in synchronous mode: its"
        " frames have no fixed length. Start that client first, or run without --no-tick"
    )
