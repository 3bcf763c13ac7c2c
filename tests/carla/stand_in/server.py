"""The server: its calls, its clock, and what it tells to tests."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .actor_calls import ActorCalls
from .batches import BatchCalls
from .faults import FAULTS
from .rpc import CallLog, RpcServer
from .server_calls import ServerCalls
from .signal_calls import SignalCalls
from .simulation import DEFAULT_STEP, Simulation
from .vehicle_calls import VehicleCalls

VERSION = "0.9.16"


@dataclass(frozen=True)
class Traits:
    """How a server may differ from others.

    Attributes:
        version: What it says it is; builds from source have a suffix (`Util/BuildTools`,
            `git describe --dirty`).
        loading: Seconds until a level is there: large maps take a minute and more. The client asks
            for the new episode for as long as one call may take (`Simulator::LoadEpisode`).
        fault: How it differs from what runs rely on; see `faults`.
        has_streams: Whether its second port is open; without it calls are answered, and no
            snapshot ever arrives (carla issues on docker and firewalls).
    """

    version: str = VERSION
    loading: float = 0.0
    has_streams: bool = True
    fault: str = ""


class TestCalls:
    """Calls that no client makes: what a test wants to know."""

    __test__ = False  # nothing for pytest

    def __init__(self, simulation: Simulation, log: CallLog) -> None:
        self._simulation, self._log = simulation, log

    def stand_in_calls(self) -> list[Any]:
        """Return names and arguments of all calls since the last time."""
        calls, self._log.calls = self._log.calls, []
        return calls

    def stand_in_unknown(self) -> dict[str, int]:
        """Return the calls that nobody answers here, and how often they came."""
        return dict(self._log.unknown)

    def stand_in_listeners(self) -> int:
        """Return how many subscribers all sensors have together."""
        streams = self._simulation.streams
        actors = self._simulation.actors.values()
        return sum(streams.subscribers(each.stream) for each in actors if each.stream)

    def stand_in_synchronous(self) -> bool:
        """Return whether time waits for a client."""
        return self._simulation.synchronous

    def stand_in_spectator(self) -> list[list[float]]:
        """Return where the camera is."""
        camera = self._simulation.spectator
        return [camera.location, camera.rotation]

    def stand_in_surroundings(self) -> list[Any]:
        """Return the weather, and of each traffic light its state and whether it is frozen."""
        lights = [[light.state, light.frozen] for _, light in self._simulation.lights()]
        return [self._simulation.weather, lights]

    def stand_in_bodies(self) -> dict[str, list[Any]]:
        """Return physics, gravity, lights and control of vehicles, by role name."""
        vehicles = [each for each in self._simulation.actors.values() if each.kind == "vehicle"]
        return {
            each.attribute("role_name"): [each.physics, each.gravity, each.lights, each.control]
            for each in vehicles
        }

    def stand_in_settings(self) -> list[Any]:
        """Return the settings, in the order in which they travel."""
        return self._simulation.settings

    def stand_in_actors(self) -> dict[str, list[str]]:
        """Return the role names of what clients spawned, by blueprint."""
        found: dict[str, list[str]] = {}
        for actor in self._simulation.actors.values():
            if actor.kind not in ("spectator", "traffic"):
                found.setdefault(actor.blueprint.id, []).append(actor.attribute("role_name"))
        return found


class StandIn:
    """A server; usable as a context.

    Args:
        folders: Where its maps are.
        town: The map it starts with.
        traits: How it differs from others.
        port: Where it answers; 0 takes a free one.
    """

    def __init__(
        self, folders: Sequence[Path], town: str, traits: Traits = Traits(), port: int = 0
    ) -> None:
        self._simulation = simulation = Simulation(folders, town, traits.loading)
        if not traits.has_streams:
            simulation.streams.close()
        log = CallLog()
        actors, vehicles = ActorCalls(simulation), VehicleCalls(simulation)
        signals = SignalCalls(simulation)
        tests = TestCalls(simulation, log)
        groups = (
            ServerCalls(simulation, traits.version),
            actors,
            vehicles,
            signals,
            BatchCalls(simulation, actors, vehicles, signals),
            tests,
        )
        calls = {name: call for each in groups for name, call in calls_of(each)}
        if traits.fault:
            FAULTS[traits.fault](simulation, calls)
        self._rpc = RpcServer(port, calls, log, {name for name, _ in calls_of(tests)})
        self.port = self._rpc.port
        self._closed = threading.Event()
        self._clock = threading.Thread(target=self._run_freely, daemon=True)
        self._clock.start()

    def _run_freely(self) -> None:
        """Change levels, and go on while no client does it."""
        while not self._closed.wait(DEFAULT_STEP):
            with self._rpc.lock:
                self._simulation.load_now()
                if not self._simulation.synchronous:
                    self._simulation.step()

    def __enter__(self) -> StandIn:
        return self

    def __exit__(self, *_: object) -> None:
        self._closed.set()
        self._clock.join()
        self._rpc.close()
        self._simulation.streams.close()


def calls_of(group: object) -> Iterator[tuple[str, Callable[..., Any]]]:
    """Yield the public methods of a group: its calls."""
    for name in dir(type(group)):
        if not name.startswith("_"):
            yield name, getattr(group, name)
