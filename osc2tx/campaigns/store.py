"""Keeps the outcomes of the rows of a campaign in one SQLite file.

Only the driver writes. A row that arrives twice is stored once, and stored rows survive a killed
process: SQLite's write-ahead log guarantees that. The file may be foreign or damaged: all data are
checked when read, and every failure names the file and the kept rows.
"""

from __future__ import annotations

import hashlib
import json
import os
import sqlite3
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import TracebackType
from typing import Any

from osc2tx.campaigns.records import (
    IDENTITY_TYPES,
    OF_THE_MACHINE,
    PLAN_TYPES,
    RUN,
    SCHEMA,
    decoded,
    record,
    require_types,
)
from osc2tx_runtime.campaigns import RowResult
from osc2tx_runtime.errors import NO_RESULT, message_of
from osc2tx_shared.links import target_outside


class CampaignError(Exception):
    """A campaign cannot be run, or its store cannot be used; the message states the remedy."""


FORMAT = 2


class _Database:
    """An SQLite file whose failures name its content.

    Args:
        path: The file.
        is_fixed: Nothing changes it: it can be read where no file can be made beside it.

    Raises:
        sqlite3.Error: It cannot be opened.
    """

    def __init__(self, path: Path, *, is_fixed: bool = False) -> None:
        self._path = path
        name = f"{path.absolute().as_uri()}?immutable=1" if is_fixed else path
        self._base = sqlite3.connect(name, timeout=30.0, isolation_level=None, uri=is_fixed)
        self._file = _file_of(path)

    def close(self) -> None:
        """Close the file."""
        self._base.close()

    def execute(self, statement: str, values: Sequence[Any] = ()) -> None:
        """Carry out a statement."""
        with self._failures():
            self._base.execute(statement, values)

    def rows(self, query: str, values: Sequence[Any] = ()) -> Iterator[tuple[Any, ...]]:
        """Yield the rows of a query."""
        with self._failures():
            yield from self._base.execute(query, values)

    @contextmanager
    def writing(self) -> Iterator[sqlite3.Connection]:
        """Make all changes, or none of them."""
        with self._failures():
            self._base.execute("begin immediate")
            try:
                yield self._base
                self._base.execute("commit")
            except BaseException:
                if self._base.in_transaction:  # a full disk has ended it already
                    self._base.execute("rollback")
                raise
        if _file_of(self._path) != self._file:
            raise CampaignError(
                f"{self._path}: the store was removed or replaced during its use; rows stored"
                " since then are lost"
            )

    @contextmanager
    def _failures(self) -> Iterator[None]:
        try:
            yield
        except (sqlite3.Error, UnicodeDecodeError) as error:
            raise CampaignError(
                f"{self._path}: {error}; rows that were stored before are kept, as far as the"
                " file can be read"
            ) from error


def _file_of(path: Path) -> tuple[int, int] | None:
    try:
        found = path.stat()
    except OSError:
        return None
    return found.st_dev, found.st_ino


def _is_fixed(path: Path) -> bool:
    """Whether nothing can change a file, and all that was stored is in it."""
    log = path.with_name(f"{path.name}-wal")
    return not os.access(path.parent, os.W_OK) and not (log.exists() and log.stat().st_size)


class Store:
    """The file of a campaign; a context manager that closes it.

    Args:
        path: The file.
        is_new: Whether it may be made.

    Raises:
        CampaignError: It is not there, or is no store of a campaign.
    """

    def __init__(self, path: Path, *, is_new: bool = False) -> None:
        self.path = path
        if not path.exists() and not is_new:
            raise CampaignError(f"{path}: the store does not exist")
        try:
            if is_new:
                if (target := target_outside(path)) is not None:
                    raise CampaignError(
                        f"{path}: a link leads to {target}, out of the current folder; name that"
                        " file"
                    )
                path.parent.mkdir(parents=True, exist_ok=True)
                if not os.access(path.parent, os.W_OK):
                    raise CampaignError(
                        f"{path}: its folder is read-only, so no rows can be added; name"
                        " another store with --store"
                    )
            self._base = _Database(path, is_fixed=_is_fixed(path))
        except OSError as error:
            raise CampaignError(f"{path}: cannot be created: {error}") from error
        except (ValueError, sqlite3.Error) as error:
            raise CampaignError(f"{path}: not a store of a campaign: {error}") from error
        try:
            if is_new:
                self._make()
            self._check()
        except CampaignError as error:
            self._base.close()
            if isinstance(error.__cause__, sqlite3.DatabaseError) and not isinstance(
                error.__cause__, sqlite3.OperationalError
            ):
                raise CampaignError(
                    f"{path}: not a store of a campaign: {error.__cause__}"
                ) from error
            raise

    def _make(self) -> None:
        """Make the tables of an empty file, unless another process has done so meanwhile."""
        if self._tables():
            return
        self._base.execute("pragma journal_mode = wal")
        with self._base.writing() as base:
            if not self._tables():
                for statement in filter(str.strip, SCHEMA.split(";")):
                    base.execute(statement)
                base.execute(f"pragma user_version = {FORMAT}")

    def _check(self) -> None:
        ((found,),) = self._base.rows("pragma user_version")
        if found != FORMAT or not {"campaign", "run", "left_out"} <= self._tables():
            raise CampaignError(f"{self.path}: not a store of a campaign, or of another version")
        self._base.execute("pragma synchronous = normal")

    def _tables(self) -> set[str]:
        return {name for (name,) in self._base.rows("select name from sqlite_master")}

    def __enter__(self) -> Store:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._base.close()

    # --- the campaign ---

    @property
    def identity(self) -> dict[str, Any] | None:
        """The identity of the campaign; None for a store that is still empty."""
        return self._told("identity", IDENTITY_TYPES)

    @property
    def plan(self) -> dict[str, Any]:
        """The common data of its rows.

        Raises:
            CampaignError: The store is empty.
        """
        found = self._told("plan", PLAN_TYPES)
        if found is None:
            raise CampaignError(f"{self.path}: no rows yet")
        return found

    def _told(self, name: str, types: Mapping[str, Any]) -> dict[str, Any] | None:
        query = "select value from campaign where name = ?"
        for (text,) in list(self._base.rows(query, (name,))):
            with self.as_written(f"the {name} of the campaign"):
                value: dict[str, Any] = json.loads(text)
                require_types(value, types)
                return value
        return None

    @contextmanager
    def as_written(self, what: str) -> Iterator[None]:
        """Read something of the store that has to be as osc2tx writes it.

        Raises:
            CampaignError: It is not; the message names it.
        """
        try:
            yield
        except (*NO_RESULT, AttributeError, TypeError) as error:
            raise CampaignError(
                f"{self.path}: {what} is damaged ({message_of(error)}); nothing was changed"
            ) from error

    @property
    def wanted(self) -> int | None:
        """The number of rows that the last call requested, if it stated one."""
        found = self._told("samples", {"rows": int})
        return None if found is None else int(found["rows"])

    @wanted.setter
    def wanted(self, rows: int) -> None:
        text = json.dumps({"rows": rows})
        with self._base.writing() as base:
            base.execute("insert or replace into campaign values ('samples', ?)", (text,))

    def claim(self, identity: Mapping[str, Any], plan: Mapping[str, Any]) -> None:
        """Make the store that of a campaign, or check that it is.

        Raises:
            CampaignError: It is that of another one; the message states the differences.
        """
        known = self.identity
        if known is not None:
            differences = list(_differences(known, json.loads(json.dumps(identity))))
            if differences:
                raise CampaignError(
                    f"{self.path}: the store is of another campaign: {'; '.join(differences)}."
                    " Use another --store, or the original settings"
                )
            return
        values = [("identity", json.dumps(identity)), ("plan", json.dumps(plan))]
        with self._base.writing() as base:
            base.executemany("insert or ignore into campaign values (?, ?)", values)

    # --- rows ---

    def add(self, results: Iterable[RowResult], left_out: Iterable[int] = ()) -> None:
        """Store the outcomes of rows, in one transaction."""
        results = list(results)
        marks = ", ".join("?" * len(RUN))
        collisions = [
            (each.row.number, nth, *contact)
            for each in results
            for nth, contact in enumerate(each.collisions)
        ]
        samples = [
            (each.row.number, nth, *sample)
            for each in results
            for nth, sample in enumerate(each.samples)
        ]
        with self._base.writing() as base:
            base.executemany(f"insert or ignore into run values ({marks})", map(record, results))
            base.executemany("insert or ignore into collision values (?,?,?,?,?,?)", collisions)
            base.executemany("insert or ignore into sample values (?,?,?,?)", samples)
            base.executemany(
                "insert or ignore into left_out values (?)", ((number,) for number in left_out)
            )

    def done(self) -> set[int]:
        """Return the numbers of the rows that were run."""
        return {number for (number,) in self._base.rows("select number from run")}

    def left_out(self) -> set[int]:
        """Return the numbers of the rows that break a constraint."""
        return {number for (number,) in self._base.rows("select number from left_out")}

    def measures(self) -> dict[int, dict[str, float | None]]:
        """Return the measures of all rows by number."""
        query = "select number, measures from run order by number"
        rows = list(self._base.rows(query))
        with self.as_written("the measures of a row"):
            return {number: dict(json.loads(text)) for number, text in rows}

    def counts(self) -> dict[str, int]:
        """Return how many rows ended how."""
        query = "select status, count(*) from run group by status order by status"
        return {status: number for status, number in self._base.rows(query)}

    def runs(self) -> Iterator[dict[str, Any]]:
        """Yield all rows by number: columns of the table, JSON decoded."""
        for values in self._base.rows(f"select {', '.join(RUN)} from run order by number"):
            yield self._decoded(values)

    def _decoded(self, values: Sequence[Any]) -> dict[str, Any]:
        with self.as_written(f"row {values[0]}"):
            return decoded(values)

    def run(self, number: int) -> dict[str, Any]:
        """Return a row.

        Raises:
            CampaignError: It was not run.
        """
        query = f"select {', '.join(RUN)} from run where number = ?"
        found = list(self._base.rows(query, (number,)))
        if not found:
            why = "violates a constraint and was omitted" if number in self.left_out() else ""
            raise CampaignError(f"{self.path}: row {number} {why or 'was not run'}")
        return self._decoded(found[0])

    def samples(self) -> Iterator[tuple[int, str, dict[str, Any]]]:
        """Yield the samples of coverage items: row, `cover` or `record`, line of the trace."""
        for number, kind, text in self._base.rows(
            "select number, kind, line from sample order by number, nth"
        ):
            with self.as_written(f"a sample of row {number}"):
                line = json.loads(text)
                require_types(line, {"name": str})
            yield number, kind, line

    def digest(self) -> str:
        """Return the SHA-256 of all results that do not depend on the machine."""
        kept = [name for name in RUN if name not in OF_THE_MACHINE]
        digest = hashlib.sha256()
        for query in (
            f"select {', '.join(kept)} from run order by number",
            "select * from collision order by number, nth",
            "select * from sample order by number, nth",
            "select number from left_out order by number",
        ):
            for values in self._base.rows(query):
                digest.update(repr(values).encode())
        return digest.hexdigest()


def _differences(known: Mapping[str, Any], given: Mapping[str, Any]) -> Iterator[str]:
    for name in dict.fromkeys((*known, *given)):
        was, is_now = known.get(name), given.get(name)
        if was != is_now:
            yield f"{name} was {_short(was)}, is {_short(is_now)}"


def _short(value: Any) -> str:
    if isinstance(value, str) and len(value) == hashlib.sha256().digest_size * 2:
        return value[:12]
    return "not stated" if value is None else json.dumps(value)
