"""Lines 1 to 6: library, ports, version, time."""

from __future__ import annotations

from osc2tx_runtime.errors import SimulatorError
from osc2tx_runtime.simulators.carla.client import release_of
from osc2tx_runtime.simulators.carla.connection import REPAIRING

from .probe import Finding, Probe, differs, line, ok


@line(1, "client library", blocks=True)
def library(probe: Probe) -> Finding:
    """The process of the library has started."""
    found = probe.client.ask("library")
    return ok(f"{found['version']}, {found['file']}")


@line(2, "port of the calls", blocks=True)
def calls(probe: Probe) -> Finding:
    """A process listens; the next line checks its responses."""
    where = ":".join(map(str, probe.address))
    try:
        probe.contact = probe.connect(probe.client)
    except SimulatorError as error:
        probe.contact = {"listens": True, "error": error.message}
    if not probe.contact["listens"]:
        return differs(f"nothing listens at {where}", "start CarlaUE4.sh, or --carla HOST:PORT")
    return ok(where)


@line(3, "server", blocks=True)
def server(probe: Probe) -> Finding:
    """It responds as CARLA does."""
    if "server" not in probe.contact:
        return differs(
            probe.contact["error"],
            "the server is still starting (--carla-timeout), or another program listens there",
        )
    return ok(f"CARLA {probe.contact['server']}")


@line(4, "versions", blocks=True)
def versions(probe: Probe) -> Finding:
    """Server and library are of one release."""
    theirs, ours = probe.contact["server"], probe.contact["client"]
    found = f"server {theirs}, library {ours}"
    if release_of(theirs) != release_of(ours):
        return differs(found, f"pip install carla=={release_of(theirs)}, or another server")
    return ok(found)


@line(5, "port of the snapshots", blocks=True)
def streams(probe: Probe) -> Finding:
    """Snapshots arrive."""
    if probe.contact["streams"]:
        return ok("snapshots arrive")
    port = probe.address[1] + 1
    if probe.contact["stream_port"]:
        return differs("no snapshots arrive", "the level may still be loading (--carla-timeout)")
    return differs(f"nothing responds at port {port}", f"open or publish port {port} as well")


@line(6, "time", blocks=True)
def time(probe: Probe) -> Finding:
    """No other client makes the steps."""
    left = ", ".join(probe.contact["left"])
    if left and probe.request.fixes:
        probe.client.ask("repair", patience=REPAIRING)
        return ok(f"restored what an interrupted run had changed: {left}")
    if left:
        return ok(f"the next run, or --fix, restores what an interrupted run has changed: {left}")
    if not probe.contact["synchronous"]:
        return ok("free")
    if probe.contact["ticks"]:
        return differs("another client ticks the world", "end it, or run with --no-tick")
    if probe.request.fixes:
        probe.client.ask("free_time")
        return ok("free; a synchronous mode that a client had left behind was ended")
    return differs("synchronous, without steps", "--fix or --carla-reset ends that")
