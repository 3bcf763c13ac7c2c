"""The process that runs rows for a driver; both communicate through a pipe.

Besides results it sends a heartbeat at intervals. It stops if the process is suspended or its
machine is out of memory, but not during a long row.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
from contextlib import suppress
from multiprocessing.connection import Connection, wait
from threading import Event, Lock, Thread
from typing import Any

from osc2tx_runtime.errors import ScenarioError, message_of
from osc2tx_shared.classes import dataclass

from .executor import Executor
from .rows import Plan, Row

ALIVE = "alive"
READY = "ready"


@dataclass(frozen=True, slots=True)
class Refused:
    """A worker cannot run any row.

    Attributes:
        message: Why.
    """

    message: str


class _Teller:
    """The end of a pipe that two threads write to."""

    def __init__(self, pipe: Connection) -> None:
        self._pipe, self._lock = pipe, Lock()

    def send(self, message: Any) -> None:
        """Tell the driver.

        Raises:
            OSError: The driver has ended.
        """
        with self._lock:
            self._pipe.send(message)

    def beat(self, every: float) -> None:
        """Send `ALIVE` at intervals of this length (s)."""
        never = Event()

        def beat() -> None:
            with suppress(OSError):  # the driver has ended
                while not never.wait(every):
                    self.send(ALIVE)

        Thread(target=beat, daemon=True).start()


def work(pipe: Connection, plan: Plan, beat: float) -> None:
    """Run the rows that come through a pipe, until it is closed.

    It sends `READY`, then each result as soon as the row is done, or `Refused`. Every `beat`
    seconds it sends `ALIVE`.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the driver ends it
    _end_with_parent()
    teller = _Teller(pipe)
    teller.beat(beat)
    try:
        try:
            executor = Executor(plan)
        except ScenarioError as error:
            teller.send(Refused(error.message))
            return
        except Exception as error:  # any exception of the module
            teller.send(Refused(message_of(error)))
            return
        teller.send(READY)
        while True:
            rows: list[Row] = pipe.recv()
            for row in rows:
                teller.send(executor.run(row))
    except (EOFError, OSError):  # the driver has ended
        return


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    assert parent is not None, "a worker is a child"

    def watch(sentinel: int = parent.sentinel) -> None:
        wait([sentinel])
        os._exit(1)

    Thread(target=watch, daemon=True).start()
