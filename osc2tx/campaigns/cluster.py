"""Runs rows on a cluster of Dask: `--engine dask://HOST:PORT`.

The scheduler hands rows to its workers, and gives those of a dead worker to others. It counts the
workers that died while they had a task, also of tasks that were only queued behind the deadly one.
So a batch that it gives up is run again row by row, and a row that it gives up then is `crashed`.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Generator, Iterator
from typing import Any

from osc2tx.campaigns.engine import Engine, LocalEngine, crashed, take
from osc2tx_runtime import ScenarioError
from osc2tx_runtime.campaigns import Plan, Row, RowResult
from osc2tx_runtime.campaigns.remote import parcel_of, run_rows, unchanged
from osc2tx_runtime.campaigns.worker import Refused
from osc2tx_runtime.errors import message_of

from .store import CampaignError

LOOK = 5.0  # seconds without news, after which the number of workers is checked
AHEAD = 2  # batches for each worker: one that it runs, one that waits for it


class DaskEngine:
    """A running cluster of Dask.

    Args:
        address: `HOST:PORT` of its scheduler.
        batch: Number of rows that a worker has at a time.
        patience: Seconds to wait for the scheduler, and for a first worker.
    """

    def __init__(self, address: str, batch: int = 16, patience: float = 60.0) -> None:
        self._address, self._batch, self._patience = address, batch, patience

    def run(self, plan: Plan, rows: Iterator[Row | None]) -> Generator[list[RowResult], None, None]:
        """Yield the outcomes of rows as they come.

        Raises:
            CampaignError: The cluster is not there, is gone, or cannot run rows.
        """
        dask = _distributed()
        try:
            client = dask.Client(
                f"tcp://{self._address}", timeout=self._patience, set_as_default=False
            )
        except (OSError, ValueError) as error:
            raise CampaignError(
                f"--engine dask://{self._address}: no scheduler of Dask answers: "
                f"{message_of(error)}"
            ) from error
        try:
            yield from _Flight(dask, client, plan, rows, self._batch, self._patience).results()
        except dask.CancelledError as error:
            raise CampaignError(
                "the scheduler of the cluster does not respond; repeat the command to resume"
            ) from error
        finally:
            client.close()


class _Flight:
    """The rows of one campaign that are on the cluster."""

    def __init__(
        self,
        dask: Any,
        client: Any,
        plan: Plan,
        rows: Iterator[Row | None],
        batch: int,
        patience: float,
    ) -> None:
        self._dask, self._client, self._rows = dask, client, rows
        self._batch, self._patience = batch, patience
        self._flying: dict[Any, list[Row]] = {}
        self._suspects: deque[Row] = deque()
        self._is_alone = False  # whether one suspect is in flight
        self._workers, self._last_seen = 0, time.monotonic()
        try:
            self._parcel = parcel_of(plan)
        except ScenarioError as error:
            raise CampaignError(error.message) from error
        self._shared = self._share()

    def _share(self) -> Any:
        """Have the cluster hold the parcel, for all batches."""
        return self._client.submit(unchanged, self._parcel, pure=False)

    def results(self) -> Iterator[list[RowResult]]:
        """Yield the outcomes of rows as they come."""
        while self._feed():
            found = [result for task in self._landed() for result in self._take(task)]
            if found:
                yield found

    def _feed(self) -> bool:
        """Send rows as far as there is room; return whether there is something to wait for."""
        if self._suspects:
            if not self._flying:  # it brings its parcel, so that nothing else can be blamed
                self._send([self._suspects.popleft()], self._parcel)
                self._is_alone = True
            return True
        self._is_alone = False
        self._count_workers()
        while len(self._flying) < AHEAD * max(self._workers, 1):
            rows = take(self._rows, self._batch)
            if not rows:
                break
            self._send(rows, self._shared)
        return bool(self._flying)

    def _send(self, rows: list[Row], parcel: Any) -> None:
        task = self._client.submit(run_rows, parcel, rows, pure=False)
        self._flying[task] = rows

    def _count_workers(self) -> None:
        self._workers = len(self._client.nthreads())
        if self._workers:
            self._last_seen = time.monotonic()

    def _landed(self) -> list[Any]:
        """Wait for tasks; return those that ended, none if it takes long."""
        try:
            with self._client.as_current():
                waited = self._dask.wait(
                    list(self._flying), timeout=LOOK, return_when="FIRST_COMPLETED"
                )
        except TimeoutError:
            self._count_workers()
            if time.monotonic() - self._last_seen > self._patience:
                raise CampaignError(
                    f"the cluster has had no workers for {self._patience:g} s;"
                    " repeat the command to resume"
                ) from None
            return []
        return sorted(waited.done, key=lambda task: self._flying[task][0].number)

    def _take(self, task: Any) -> list[RowResult]:
        """Return the outcomes of the rows of a task that ended."""
        rows = self._flying.pop(task)
        try:  # a result can still be lost here, with the worker that has it
            found: list[RowResult] | Refused = task.result()
        except self._dask.KilledWorker:
            if self._is_alone:
                return [crashed(rows[0], attempts=2)]
            self._suspects.extend(rows)
            self._shared = self._share()  # it may be an abandoned row
            return []
        except self._dask.CancelledError:
            raise
        except Exception as error:  # of the cluster: rows have their errors in their results
            raise CampaignError(f"a worker cannot run rows: {message_of(error)}") from error
        if isinstance(found, Refused):
            raise CampaignError(found.message)
        return found


def _distributed() -> Any:
    try:
        import distributed
    except ImportError:
        raise CampaignError(
            "--engine dask://HOST:PORT needs distributed: pip install 'osc2tx[dask]'"
        ) from None
    return distributed


def engine_by_name(
    name: str, batch: int, processes: int, workers: int | None, timeout: float | None = None
) -> Engine:
    """Return an engine.

    Args:
        name: `local`, or `dask://HOST:PORT`.
        batch: Number of rows that a worker has at a time.
        processes: Number of local workers if `workers` is not given.
        workers: The requested number.
        timeout: Wall-clock seconds that a row may take.

    Raises:
        CampaignError: There is none of this name, or it cannot do what is requested.
    """
    if name == "local":
        return LocalEngine(workers or processes, batch, timeout)
    scheme, _, address = name.partition("://")
    host, _, port = address.rpartition(":")
    if scheme != "dask" or not host or not port.isdecimal():
        raise CampaignError(f"--engine {name}: use local or dask://HOST:PORT")
    for option, value in (("--workers", workers), ("--timeout", timeout)):
        if value is not None:
            raise CampaignError(
                f"{option} is for --engine local: a cluster has its own workers, whose rows cannot"
                " be ended from here"
            )
    return DaskEngine(address, batch)
