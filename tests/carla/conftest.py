"""One stand-in for all tests that need no server of their own, and clients of the real library."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

import osc2tx_runtime

for needed in ("carla", "msgpack", "vehiclemodels"):
    pytest.importorskip(needed, reason="make test-carla installs what the stand-in needs")

if TYPE_CHECKING:
    from .stand_in.process import StandInProcess

OWN_MAPS = Path(osc2tx_runtime.__file__).parent / "maps"


@pytest.fixture(scope="session")
def running() -> Iterator[StandInProcess]:
    """The stand-in of the session; `stand_in` is what tests take."""
    from .stand_in.process import StandInProcess

    with StandInProcess([OWN_MAPS], "highway") as process:
        yield process


@pytest.fixture
def stand_in(running: StandInProcess) -> Iterator[StandInProcess]:
    """The stand-in with a fresh log; at the end nobody asked for what it does not know."""
    running.calls()
    yield running
    assert running.ask("stand_in_unknown") == {}


@pytest.fixture(scope="session")
def towns() -> Iterator[StandInProcess]:
    """A stand-in that has the towns, too."""
    from .runs import towns
    from .stand_in.process import StandInProcess

    with StandInProcess([OWN_MAPS, *towns()], "highway") as process:
        yield process


@pytest.fixture(scope="session")
def connected(running: StandInProcess) -> Any:
    """The client of the session: the library can crash when one goes while messages arrive."""
    import carla

    made = carla.Client("127.0.0.1", running.port)
    made.set_timeout(20.0)
    return made


@pytest.fixture
def client(stand_in: StandInProcess, connected: Any) -> Any:
    """A client of the stand-in."""
    return connected


@pytest.fixture
def world(client: Any, stand_in: StandInProcess) -> Iterator[Any]:
    """A fresh level with traffic lights, in synchronous mode with steps of 0.05 s."""
    before = client.get_world().get_settings()
    settings = client.get_world().get_settings()
    settings.synchronous_mode, settings.fixed_delta_seconds = True, 0.05
    client.get_world().apply_settings(settings)
    found = client.load_world("urban_crossing", reset_settings=False)
    stand_in.calls()
    yield found
    client.get_world().apply_settings(before)


@pytest.fixture
def wait() -> Callable[[Callable[[], bool]], None]:
    """Wait for what another thread brings; a test that never gets it hangs for a minute."""

    def until(there: Callable[[], bool]) -> None:
        for _ in range(6000):
            if there():
                return
            time.sleep(0.01)
        pytest.fail("it never came")

    return until
