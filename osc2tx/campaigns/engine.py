"""Runs rows in processes of this machine; a row that ends its process affects no other row.

Each worker has a pipe of its own, reports each row as soon as it is done, and has only a few rows
at once. So it is known which row a worker was at when it died: that one is tried once more, alone,
and then is `crashed`; those behind it go to others. A worker without any message, even of being
alive, counts as dead.
"""

from __future__ import annotations

import multiprocessing
import time
from collections import deque
from collections.abc import Generator, Iterator
from contextlib import suppress
from itertools import islice
from multiprocessing.connection import Connection, wait
from typing import Protocol

from osc2tx_runtime.campaigns import Plan, Row, RowResult
from osc2tx_runtime.campaigns.rows import CRASHED
from osc2tx_runtime.campaigns.worker import ALIVE, Refused, work
from osc2tx_shared.classes import replace

from .store import CampaignError

ATTEMPTS = 2
STALLED = 120.0  # s of silence; a worker at a long row is not silent
BEATS = 12  # that it tells in this time
STARTS = 3  # of workers that end before they are ready, with no row done meanwhile


class Engine(Protocol):
    """Runs rows, wherever that is."""

    def run(self, plan: Plan, rows: Iterator[Row | None]) -> Generator[list[RowResult], None, None]:
        """Yield the outcomes of rows, in any order, some at a time; take rows when there is room.

        Where `rows` has None there are no more before something else has come of earlier ones.
        """


def take(rows: Iterator[Row | None], most: int) -> list[Row]:
    """Take up to this number of rows from those available at the moment."""
    return list(islice(iter(lambda: next(rows, None), None), most))


class LocalEngine:
    """Processes of this machine.

    Args:
        workers: Their number.
        batch: Number of rows that a worker has at a time.
        timeout: Wall-clock seconds that a row may take; None for no limit.
        stalled: Seconds of silence after which a worker counts as dead.
    """

    def __init__(
        self,
        workers: int,
        batch: int = 16,
        timeout: float | None = None,
        stalled: float = STALLED,
    ) -> None:
        self._workers, self._batch, self._timeout = workers, batch, timeout
        self._stalled = stalled

    def run(self, plan: Plan, rows: Iterator[Row | None]) -> Generator[list[RowResult], None, None]:
        """Yield the outcomes of rows as they come.

        Raises:
            CampaignError: No worker can be started.
        """
        pool = _Pool(plan, self._workers, self._batch, self._timeout, rows, self._stalled)
        try:
            while pool.feed():
                found = pool.collect()
                if found:
                    yield found
        finally:
            pool.close()


class _Worker:
    """A process and the rows that it has.

    Attributes:
        rows: Those that it was given, the one that it is at first.
        since: When it began with that one.
        is_ready: Whether it has imported the module.
        silence: Seconds of waiting since its last message.
    """

    def __init__(self, plan: Plan, beat: float) -> None:
        context = multiprocessing.get_context("spawn")
        self.pipe: Connection
        self.pipe, theirs = context.Pipe()
        self.process = context.Process(target=work, args=(theirs, plan, beat), daemon=True)
        self.process.start()
        theirs.close()
        self.rows: deque[Row] = deque()
        self.since = time.monotonic()
        self.is_ready = False
        self.silence = 0.0

    def give(self, rows: list[Row]) -> None:
        """Give it rows; it has none."""
        self.rows.extend(rows)
        self.since = time.monotonic()
        self.pipe.send(rows)

    def end(self) -> None:
        """End it immediately."""
        self.process.kill()
        self.process.join()
        self.pipe.close()


class _Pool:
    """The workers of one campaign."""

    def __init__(
        self,
        plan: Plan,
        workers: int,
        batch: int,
        timeout: float | None,
        rows: Iterator[Row | None],
        stalled: float,
    ) -> None:
        self._stalled, self._beat = stalled, stalled / BEATS
        self._plan, self._most, self._batch, self._timeout = plan, workers, batch, timeout
        self._rows = rows
        self._again: deque[Row] = deque()  # of workers that died
        self._suspects: deque[Row] = deque()  # those that they were at
        self._attempts: dict[int, int] = {}
        self._workers: list[_Worker] = []
        self._failed_starts = 0

    def feed(self) -> bool:
        """Give rows to idle workers; return whether there is something to wait for."""
        while len(self._workers) < self._most:
            self._workers.append(_Worker(self._plan, self._beat))
        for worker in self._workers:
            if worker.is_ready and not worker.rows:
                rows = self._next_rows()
                if rows:
                    self._give(worker, rows)
        is_fresh = not any(worker.is_ready for worker in self._workers)
        return is_fresh or any(worker.rows for worker in self._workers)

    def _give(self, worker: _Worker, rows: list[Row]) -> None:
        with suppress(OSError):  # it is dead, which `collect` finds out
            worker.give(rows)

    def _next_rows(self) -> list[Row]:
        if self._suspects:
            return [self._suspects.popleft()]
        again = [self._again.popleft() for _ in range(min(self._batch, len(self._again)))]
        return again + take(self._rows, self._batch - len(again))

    def collect(self) -> list[RowResult]:
        """Wait for messages of workers; return the outcomes of rows."""
        pipes = {worker.pipe: worker for worker in self._workers}
        begin = time.monotonic()
        wait(list(pipes), timeout=self._patience())
        # All may have been stopped for hours: no wait counts for more than it was meant to take.
        waited = min(time.monotonic() - begin, self._beat)
        found: list[RowResult] = []
        for pipe, worker in pipes.items():
            worker.silence = 0.0 if pipe.poll() else worker.silence + waited
            try:
                while pipe.poll():
                    self._hear(worker, pipe.recv(), found)
            except (EOFError, OSError):
                found += self._bury(worker)
                continue
            if worker.silence > self._stalled:
                found += self._bury(worker)
        if self._timeout is not None:
            for worker in list(self._workers):
                if worker.rows and time.monotonic() - worker.since > self._timeout:
                    found.append(self._give_up(worker))
        return found

    def _patience(self) -> float:
        if self._timeout is None:
            return self._beat
        now = time.monotonic()
        ends = [each.since + self._timeout - now for each in self._workers if each.rows]
        return min(self._beat, max(0.0, min(ends)) + 0.01) if ends else self._beat

    def _hear(self, worker: _Worker, told: object, found: list[RowResult]) -> None:
        if isinstance(told, Refused):
            raise CampaignError(told.message)
        if told == ALIVE:
            return
        if not isinstance(told, RowResult):
            worker.is_ready = True
            return
        self._failed_starts = 0
        worker.rows.popleft()
        worker.since = time.monotonic()
        found.append(_tried(told, self._attempts.get(told.row.number, 0) + 1))

    def _bury(self, worker: _Worker) -> list[RowResult]:
        """Take a dead worker away; return the row that it died of, if that was the last try."""
        worker.end()
        self._workers.remove(worker)
        if not worker.is_ready:
            self._failed_starts += 1
            if self._failed_starts >= STARTS:
                code = worker.process.exitcode
                raise CampaignError(f"a worker cannot be started: it ended with exit code {code}")
        if not worker.rows:
            return []
        row = worker.rows.popleft()
        self._again.extendleft(reversed(worker.rows))
        tried = self._attempts[row.number] = self._attempts.get(row.number, 0) + 1
        if tried < ATTEMPTS:
            self._suspects.append(row)
            return []
        return [crashed(row, tried)]

    def _give_up(self, worker: _Worker) -> RowResult:
        worker.end()
        self._workers.remove(worker)
        row = worker.rows.popleft()
        self._again.extendleft(reversed(worker.rows))
        reason = f"took longer than {self._timeout:g} s of wall-clock time"
        return RowResult(row, {}, CRASHED, reason, attempts=self._attempts.get(row.number, 0) + 1)

    def close(self) -> None:
        """End all workers."""
        for worker in self._workers:
            worker.end()


def crashed(row: Row, attempts: int) -> RowResult:
    """Return the outcome of a row that ended its process each time, the same on all engines."""
    return RowResult(
        row, {}, CRASHED, "the process of this row ended or stalled, each time", attempts=attempts
    )


def _tried(result: RowResult, attempts: int) -> RowResult:
    return result if attempts == 1 else replace(result, attempts=attempts)
