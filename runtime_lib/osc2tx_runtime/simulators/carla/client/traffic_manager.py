"""A separate Traffic Manager, since mode and seed of that of another client cannot be read.

A server has a list of the Traffic Managers that its clients run, by port. `get_trafficmanager`
joins the one that is listed (`TrafficManager::CreateTrafficManagerClient`); the settings of a run
there could not be restored. The library does not expose the calls for that list, so they are
implemented here: MessagePack-RPC, `[0, number, name, [[asynchronous], port]]`.
"""

from __future__ import annotations

import socket
from collections.abc import Sequence
from typing import Any

from .journal import undoes
from .session import Session, listens

FIRST, LAST = 8000, 8099
"""Range of ports, the first free one of which is used by default."""

KIND = "Traffic Manager"


class TrafficManagers:
    """Starts the Traffic Manager of a session; its methods are requests.

    Args:
        session: A connected session.
    """

    def __init__(self, session: Session) -> None:
        self._session = session

    def begin_autopilot(self, port: int | None, seed: int) -> int:
        """Start the Traffic Manager, synchronized with the world; return its port.

        Raises:
            RuntimeError: The port is used by another client, or by another program.
        """
        if port is None:
            free = (each for each in range(FIRST, LAST + 1) if not self.is_manager_port_taken(each))
            port = next(free, FIRST)
        if self.is_manager_port_taken(port):
            raise RuntimeError(
                f"port {port} is used, be it by the Traffic Manager of another client, whose mode"
                " and seed could not be put back: --carla-tm-port takes another one"
            )
        self._session.journal.note(KIND, port)
        manager = self._session.client.get_trafficmanager(port)
        self._session.handles.append(manager.shut_down)
        manager.set_synchronous_mode(True)
        manager.set_random_device_seed(seed)
        return int(manager.get_port())

    def is_manager_port_taken(self, port: int) -> bool:
        """Return whether a port is used by another Traffic Manager, or by another program."""
        listed = _call(self._session, "is_traffic_manager_running", port)
        return listed or listens("127.0.0.1", port)


@undoes(KIND)
def _strike(session: Session, ports: Sequence[Any]) -> None:
    """Remove Traffic Managers from the server's list: their processes have ended."""
    for port in ports:
        _call(session, "destroy_traffic_manager", port)


def _call(session: Session, name: str, port: int) -> bool:
    """Make a call with a port; the last byte of the response is its Boolean result.

    Raises:
        RuntimeError: There is no response in time.
    """
    text = name.encode()
    request = b"\x94\x00\x00" + bytes([0xA0 + len(text)]) + text
    request += b"\x92\x91\xc2\xcd" + port.to_bytes(2, "big")
    try:
        with socket.create_connection(session.address, timeout=session.timeout) as connection:
            connection.sendall(request)
            return connection.recv(64).endswith(b"\xc3")
    except OSError as error:
        raise RuntimeError(f"time-out of {name}: {error}") from None
