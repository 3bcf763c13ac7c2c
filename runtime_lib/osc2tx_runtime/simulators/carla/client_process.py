"""The parent side of the process of the client library: requests with time limits."""

from __future__ import annotations

import contextlib
import json
import subprocess
import sys
import tempfile
from pathlib import Path
from select import select
from typing import Any

from osc2tx_runtime.errors import SimulatorError
from osc2tx_shared.cache import cache_folder

from .client import MISSING

HERE = Path(__file__).parent
SERVE = """
import sys
sys.path.insert(0, sys.argv[1])
from client.serve import main
del sys.path[0]
sys.exit(main(sys.argv[2]))
"""
"""Code of the process: only this package, since importing all of the runtime takes time.

Its folder is first, and `-P` omits the working folder, which may contain another `client.py`.
"""

LAST_WORDS = 3
"""Number of lines of the library's standard error that a message quotes."""

MARGIN = 3.0
"""Additional time (s) to wait for a response, after the time limit of the library."""

CLOSING = 5.0
"""Time limit (s) of the process for restoring the simulator."""


class ClientProcess:
    """A running process.

    Args:
        timeout: Time limit (s) of a call.

    Attributes:
        patience_at_end: Additional time (s) for restoring.

    Raises:
        SimulatorError: CARLA's client library has no version for this system.
    """

    def __init__(self, timeout: float) -> None:
        if sys.platform == "win32":
            raise SimulatorError(
                "the world carla needs Linux; on Windows run osc2tx in WSL2, and name the server"
                " with --carla HOST:PORT"
            )
        self._timeout = timeout
        self.patience_at_end = 0.0
        cache = cache_folder()
        journals = "" if cache is None else str(cache / "carla")
        self._number = 0
        self._lost = False
        # Not a pipe, since the process may outlive its parent; closed in `close`.
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-c", SERVE, str(HERE), journals],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._errors,
            start_new_session=True,  # Ctrl-C is handled by the parent
        )
        self._received = b""

    def ask(self, name: str, *arguments: Any, patience: float = 0.0) -> Any:
        """Make a request and return its result.

        Args:
            name: Of a method of `client.session.Session`.
            *arguments: For it.
            patience: Time (s) for the response in addition to that of a call.

        Raises:
            SimulatorError: The server rejects it, is lost, or does not respond.
        """
        self._number += 1
        request = json.dumps([self._number, name, arguments])
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(request.encode() + b"\n")
            self._process.stdin.flush()
        except BrokenPipeError:
            raise self._gone() from None
        while True:
            number, kind, value = json.loads(self._line(patience))
            if number == self._number:  # an earlier one was interrupted
                break
        if kind == "bug":
            last = str(value).strip().rpartition("\n")[2]  # of a traceback
            raise SimulatorError(f"in the process of CARLA's client library: {last}")
        if kind == "error":
            raise SimulatorError(f"CARLA: {value}")
        return value

    def _line(self, patience: float) -> bytes:
        assert self._process.stdout is not None
        stream = self._process.stdout.fileno()
        most = 2.0 * self._timeout + MARGIN + patience
        while b"\n" not in self._received:
            ready, _, _ = select([stream], [], [], most)
            if not ready:
                self._lost = True
                raise SimulatorError(f"CARLA does not respond any more (waited {most:g} s)")
            received = self._process.stdout.read1(1 << 20)  # type: ignore[attr-defined]
            if not received:
                raise self._gone()
            self._received += received
        line, _, self._received = self._received.partition(b"\n")
        return line

    def _gone(self) -> SimulatorError:
        self._lost = True
        code = self._process.wait(CLOSING)
        if code == MISSING:
            return SimulatorError(
                "the client library of CARLA is not installed: pip install osc2tx-runtime[carla]"
                " (CPython 3.10 to 3.12 on x86-64)"
            )
        words = self._last_words()
        quoted = f"; its last words: {words}" if words else ""
        return SimulatorError(
            f"the client library of CARLA has ended its process (code {code}): the server is"
            f" lost{quoted}"
        )

    def _last_words(self) -> str:
        """Return the end of the library's standard error."""
        self._errors.seek(0)
        lines = self._errors.read().decode("utf-8", "replace").split("\n")
        return " | ".join([line.strip() for line in lines if line.strip()][-LAST_WORDS:])

    def close(self) -> None:
        """End the process; it restores the simulator first.

        Without response of the server it retries for some time.
        """
        assert self._process.stdin is not None and self._process.stdout is not None
        with contextlib.suppress(BrokenPipeError):  # it has ended
            self._process.stdin.close()
        self._process.stdout.close()
        self._errors.close()
        patience = CLOSING + self._timeout + self.patience_at_end
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._process.wait(0.1 if self._lost else patience)
