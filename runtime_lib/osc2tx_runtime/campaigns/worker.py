"""The process that runs rows for a driver, which it hears and tells through a pipe."""

from __future__ import annotations

import multiprocessing
import os
import signal
from multiprocessing.connection import Connection, wait
from threading import Thread

from osc2tx_runtime.errors import ScenarioError, told
from osc2tx_shared.classes import dataclass

from .executor import Executor
from .rows import Plan, Row

__all__ = ["READY", "Refused", "work"]

READY = "ready"


@dataclass(frozen=True, slots=True)
class Refused:
    """A worker cannot run any row.

    Attributes:
        message: Why.
    """

    message: str


def work(pipe: Connection, plan: Plan) -> None:
    """Run the rows that come through a pipe, until it is closed.

    It tells `READY`, then of each row as soon as it is done; or that it is `Refused`.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the driver ends it
    _end_with_parent()
    try:
        try:
            executor = Executor(plan)
        except ScenarioError as error:
            pipe.send(Refused(error.message))
            return
        except Exception as error:  # whatever stands in the module
            pipe.send(Refused(told(error)))
            return
        pipe.send(READY)
        while True:
            rows: list[Row] = pipe.recv()
            for row in rows:
                pipe.send(executor.run(row))
    except (EOFError, OSError):  # the driver is gone
        return


def _end_with_parent() -> None:
    parent = multiprocessing.parent_process()
    assert parent is not None, "a worker is a child"

    def watch(sentinel: int = parent.sentinel) -> None:
        wait([sentinel])
        os._exit(1)

    Thread(target=watch, daemon=True).start()
