"""The connections of the lines of a check, and their declaration."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import field
from typing import Any, NamedTuple

from osc2tx_runtime.opendrive import RoadMap
from osc2tx_runtime.simulators.carla.client_process import ClientProcess
from osc2tx_runtime.simulators.carla.connection import DEFAULT_ADDRESS, LOOKING, TIMEOUT
from osc2tx_runtime.worlds import CheckRequest
from osc2tx_runtime.worlds.world_type import CheckStatus
from osc2tx_shared.classes import dataclass


class Finding(NamedTuple):
    """The finding of a line; see `CheckResult`."""

    status: CheckStatus
    found: str
    meaning: str = ""


def ok(found: str) -> Finding:
    """It fulfils the requirements of runs."""
    return Finding("ok", found)


def differs(found: str, meaning: str) -> Finding:
    """It is not."""
    return Finding("differs", found, meaning)


def unknown(found: str, meaning: str = "") -> Finding:
    """It cannot be determined."""
    return Finding("unknown", found, meaning)


@dataclass
class Probe:
    """Connections and their answers.

    Attributes:
        request: The task of the check.
        client: An observer that only changes what `fixes` requests.
        contact: The result of the first contact.
        level: The level of the server.
        road_map: The map of that level.
        is_other_map: Whether it differs from the scenario's map.
        driver: A second connection, which makes steps; opened by the first line that drives.
        before: The situation before `driver`.
    """

    request: CheckRequest
    client: ClientProcess
    contact: Mapping[str, Any] = field(default_factory=dict)
    level: Mapping[str, Any] = field(default_factory=dict)
    road_map: RoadMap | None = None
    is_other_map: bool = False
    driver: ClientProcess | None = None
    before: Mapping[str, Any] = field(default_factory=dict)

    @property
    def address(self) -> tuple[str, int]:
        """Host and port."""
        found: tuple[str, int] = self.request.world.options.get("carla", DEFAULT_ADDRESS)
        return found

    @property
    def timeout(self) -> float:
        """Seconds that a call may take."""
        return float(self.request.world.options.get("carla_timeout", TIMEOUT))

    def connect(self, client: ClientProcess) -> Mapping[str, Any]:
        """Connect a process to the server, and return its findings."""
        found: Mapping[str, Any] = client.ask(
            "connect", *self.address, self.timeout, patience=LOOKING
        )
        return found

    def driving(self) -> ClientProcess:
        """Return the connection that makes steps of the run's length."""
        if self.driver is None:
            self.before = self.client.ask("situation")
            self.driver = ClientProcess(self.timeout)
            self.connect(self.driver)
            self.driver.ask("own_time", self.request.world.dt)
        return self.driver

    def close(self) -> None:
        """End the connections."""
        if self.driver is not None:
            self.driver.close()
            self.driver = None


@dataclass(frozen=True, slots=True)
class Line:
    """One line of the table.

    Attributes:
        number: Its number.
        name: The compared property.
        look: Compares it.
        of_map: Whether it concerns the map of the scenario, if there is one.
        drives: Whether it takes over the server.
        blocks: Whether runs cannot begin if it differs.
    """

    number: int
    name: str
    look: Callable[[Probe], Finding]
    of_map: bool = False
    drives: bool = False
    blocks: bool = False


LINES: dict[int, Line] = {}
"""All lines by number; the modules of this package fill it."""


def line(
    number: int,
    name: str,
    *,
    of_map: bool = False,
    drives: bool = False,
    blocks: bool = False,
) -> Callable[[Callable[[Probe], Finding]], Callable[[Probe], Finding]]:
    """Declare a line; see `Line`."""

    def declared(look: Callable[[Probe], Finding]) -> Callable[[Probe], Finding]:
        LINES[number] = Line(number, name, look, of_map, drives, blocks)
        return look

    return declared
