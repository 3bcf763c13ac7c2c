"""The stand-in in a process of its own, as a server is.

It has to be one: some calls of the client library hold the interpreter's lock while they wait.
"""

from __future__ import annotations

import socket
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import msgpack

ROOT = Path(__file__).parents[3]
PATIENCE = 60.0  # s


class StandInProcess:
    """A running stand-in; usable as a context.

    Args:
        folders: Where its maps are.
        town: The map it starts with.
        *traits: Options that say how it differs from others; see `__main__`.

    Attributes:
        port: Where it answers.
        pid: Of its process.
    """

    def __init__(self, folders: Sequence[Path], town: str, *traits: str) -> None:
        given = [*(str(each.resolve()) for each in folders), "--town", town, *traits]
        self._process = subprocess.Popen(
            [sys.executable, "-m", "tests.carla.stand_in", *given],
            cwd=ROOT,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        assert self._process.stdout is not None
        self.port, self.pid = int(self._process.stdout.readline()), self._process.pid

    def __enter__(self) -> StandInProcess:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def ask(self, name: str) -> Any:
        """Make a call of tests."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=PATIENCE) as connection:
            connection.sendall(msgpack.packb([0, 1, name, [[False]]]))
            unpacker = msgpack.Unpacker(raw=False, strict_map_key=False)
            while received := connection.recv(1 << 16):
                unpacker.feed(received)
                for _, _, _, ((_, value),) in unpacker:
                    return value
        raise ConnectionError("the stand-in is gone")

    def calls(self) -> list[tuple[str, list[Any]]]:
        """Return names and arguments of all calls of clients since the last time."""
        return [(name, arguments) for name, arguments in self.ask("stand_in_calls")]

    def close(self) -> None:
        """End the process."""
        assert self._process.stdin is not None
        self._process.stdin.close()
        self._process.wait(timeout=PATIENCE)
